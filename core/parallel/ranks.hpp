#pragma once
/// The processes that share one run. Passed by value; nothing else in the program knows MPI, and a
/// plain start (no mpirun) never touches it.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/numbers/exact_sum.hpp"

namespace acinus {

/// Whether the bytes of a T are all there is to it. Matrices of Eigen of a fixed size are plain
/// numbers, though the language does not call them trivial; types with such members say so
/// themselves.
template <class T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T>;
template <class S, int Rows, int Columns, int Options>
inline constexpr bool kIsPlain<Eigen::Matrix<S, Rows, Columns, Options, Rows, Columns>> =
    Rows > 0 && Columns > 0;

/// What one process sends to which others, and what it gets from them: runs of two buffers. Both
/// ends know the length of every run.
struct ExchangePlan {
  struct Peer {
    int rank = 0;
    std::size_t send_begin = 0, send_end = 0, receive_begin = 0, receive_end = 0;
  };
  std::vector<Peer> peer;
  bool empty() const { return peer.empty(); }
};

/// What went between this process and others since the start. Bytes are those that it hands over;
/// of a reduction or a gathering, which pass through the network in ways that the MPI library
/// chooses, its own share.
struct Traffic {
  std::int64_t messages = 0, message_bytes = 0;  ///< of exchanges, sent
  std::int64_t reductions = 0, reduction_bytes = 0;
  std::int64_t gatherings = 0, gathered_bytes = 0;
  double wait_s = 0;  ///< wall time within all these
};

/// A group of processes. Every collective call must be made by all of them, in the same order, and
/// by the thread that made the group.
class Ranks {
 public:
  /// This process alone; every collective is the identity. Used by subworlds, tests and plain
  /// starts.
  static Ranks serial() { return Ranks(0, 1, 0); }

  /// All processes of this start. Initialises MPI on the first call if, and only if, the
  /// environment shows a launcher with more than one process (OMPI_COMM_WORLD_SIZE, PMI_SIZE,
  /// PMIX_RANK); MPI is finalised when the process ends normally. Throws Error(kCannotContinue) if
  /// MPI refuses calls from a threaded process.
  static Ranks world();

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  bool is_alone() const { return size_ == 1; }
  int communicator() const { return communicator_; }  ///< for libraries that know MPI

  /// In place sum over ranks, elementwise and exact: the same bits on every rank, and for any
  /// number of ranks. Requests to stop become known to all at the same time
  /// (core/parallel/stop.hpp).
  void sum(std::span<ExactSum> sums) const;

  /// Largest value; NaN on any rank gives NaN everywhere, so a lost rank cannot pass unnoticed.
  double max(double value) const;
  /// Elementwise. @param values  without NaN
  void max(std::span<double> values) const;
  std::int64_t min(std::int64_t value) const;

  /// True on all ranks if it is on one.
  bool any(bool value) const;

  /// What all ranks have, in their order, on every rank.
  /// @param start  [size + 1] where that of each rank begins; null: not wanted
  template <class T>
  void gather(std::span<const T> own, std::vector<T>& all,
              std::vector<std::size_t>* start = nullptr) const {
    static_assert(kIsPlain<T>);
    if (size_ == 1) {
      all.assign(own.begin(), own.end());
      if (start != nullptr) *start = {0, own.size()};
      return;
    }
    const std::vector<std::size_t> bytes = gather_sizes(own.size_bytes());
    all.resize(bytes.back() / sizeof(T));
    gather_bytes(own.data(), own.size_bytes(), bytes, all.data());
    if (start == nullptr) return;
    start->clear();
    for (const std::size_t b : bytes) start->push_back(b / sizeof(T));
  }

  /// Sends and receives with the peers of a plan; what it receives is there when it returns.
  template <class T>
  void exchange(const ExchangePlan& plan, std::span<const T> out, std::span<T> in) const {
    static_assert(kIsPlain<T>);
    if (!plan.empty()) exchange_bytes(plan, sizeof(T), out.data(), in.data());
  }

  /// What the root has, on every rank.
  template <class T>
  void broadcast(std::vector<T>& values) const {
    static_assert(kIsPlain<T>);
    if (size_ == 1) return;
    std::size_t n = values.size();
    broadcast_bytes(&n, sizeof n);
    values.resize(n);
    broadcast_bytes(values.data(), n * sizeof(T));
  }

  void barrier() const;

  /// The exit code all ranks return. From mild to grave: 0 done, 75 stopped, 2 input, 3 cannot
  /// continue, 4 file error, 1 internal, anything else.
  int agree_worst(int exit_code) const;

  /// Ends all processes at once: this one failed where the others cannot know of it.
  [[noreturn]] void abort(int exit_code) const;

  /// Of this process since its start.
  static Traffic traffic();

 private:
  Ranks(int rank, int size, int communicator)
      : rank_(rank), size_(size), communicator_(communicator) {}
  std::vector<std::size_t> gather_sizes(std::size_t own_bytes) const;
  void gather_bytes(const void* own, std::size_t own_bytes, const std::vector<std::size_t>& start,
                    void* all) const;
  void exchange_bytes(const ExchangePlan& plan, std::size_t size, const void* out, void* in) const;
  void broadcast_bytes(void* bytes, std::size_t n) const;

  int rank_, size_;
  int communicator_;  ///< Fortran handle: an int with every MPI, so this header needs none
};

}  // namespace acinus
