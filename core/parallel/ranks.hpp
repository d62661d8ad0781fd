#pragma once
/// Processes (MPI ranks) that share one run. Passed by value. Only this folder uses MPI, and a
/// plain start (no mpirun) never initialises it.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <source_location>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/numbers/exact_sum.hpp"

namespace acinus {

/// True for types that can be sent as their bytes. Eigen matrices of fixed size are plain numbers
/// although the language does not call them trivial; types with such members declare it themselves.
template <class T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T>;
template <class S, int Rows, int Columns, int Options>
inline constexpr bool kIsPlain<Eigen::Matrix<S, Rows, Columns, Options, Rows, Columns>> =
    Rows > 0 && Columns > 0;

/// Exchange with peers: the runs of a send buffer by destination and of a receive buffer by source.
/// Both ends know the length of every run.
struct ExchangePlan {
  struct Peer {
    int rank = 0;
    std::size_t send_begin = 0, send_end = 0, receive_begin = 0, receive_end = 0;
  };
  std::vector<Peer> peer;
  bool empty() const { return peer.empty(); }
};

/// Communication of this process since the start. Bytes are those that it hands over; for a
/// reduction or a gathering, whose routes the MPI library chooses, its own share.
struct Traffic {
  std::int64_t messages = 0, message_bytes = 0;  ///< of exchanges, sent
  std::int64_t reductions = 0, reduction_bytes = 0;
  std::int64_t gatherings = 0, gathered_bytes = 0;
  double wait_s = 0;  ///< wall time within all these, s
};

/// Collective calls of one line of the program, since the start of this process.
struct TrafficPlace {
  std::string place;  ///< file:line
  std::int64_t calls = 0;
  std::int64_t bytes = 0;     ///< that this process hands over
  std::int64_t received = 0;  ///< of gatherings: the values of all processes
};

/// Group of processes. Collective calls must be made by all of them, in the same order, and by the
/// thread that made the group.
class Ranks {
 public:
  /// Line of the caller, which traffic_by_place counts.
  using Place = std::source_location;

  /// Group of this process alone; every collective is the identity. Used by subworlds, tests and
  /// plain starts.
  static Ranks serial() { return Ranks(0, 1, 0); }

  /// Group of all processes of this start. Initialises MPI on the first call if, and only if, the
  /// environment shows a launcher with more than one process (OMPI_COMM_WORLD_SIZE, PMI_SIZE,
  /// PMIX_RANK); MPI is finalised when the process ends normally. Throws Error(kCannotContinue) if
  /// MPI refuses calls from a threaded process.
  static Ranks world();

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  bool is_alone() const { return size_ == 1; }
  int communicator() const {
    return communicator_;
  }  ///< Fortran handle, for libraries that use MPI

  /// Sums over ranks in place, elementwise and exact: the same bits on every rank, and for any
  /// number of ranks. Also makes requests to stop known to all ranks at the same time
  /// (core/parallel/stop.hpp).
  void sum(std::span<ExactSum> sums, Place place = Place::current()) const;

  /// Largest value over ranks; NaN on any rank gives NaN everywhere, so that a failed rank is
  /// noticed.
  double max(double value, Place place = Place::current()) const;
  /// Elementwise maximum over ranks, in place. @param values  without NaN
  void max(std::span<double> values, Place place = Place::current()) const;
  std::int64_t min(std::int64_t value, Place place = Place::current()) const;

  /// True on all ranks if the value is true on one.
  bool any(bool value, Place place = Place::current()) const;

  /// Gathers the values of all ranks, in rank order, on every rank.
  /// @param start  [size + 1] first value of each rank; null: not wanted
  template <class T>
  void gather(std::span<const T> own, std::vector<T>& all,
              std::vector<std::size_t>* start = nullptr, Place place = Place::current()) const {
    static_assert(kIsPlain<T>);
    if (size_ == 1) {
      all.assign(own.begin(), own.end());
      if (start != nullptr) *start = {0, own.size()};
      return;
    }
    gather_from<T>(own, all, start, false, place);
  }

  /// Gathers the values of all ranks, in rank order, on the root; others get none.
  /// @param start  as of gather
  template <class T>
  void gather_at_root(std::span<const T> own, std::vector<T>& all, std::vector<std::size_t>* start,
                      Place place = Place::current()) const {
    if (size_ == 1) return gather<T>(own, all, start, place);
    gather_from<T>(own, all, start, true, place);
  }

  /// Sends to and receives from the peers of a plan; returns when the received values are complete.
  template <class T>
  void exchange(const ExchangePlan& plan, std::span<const T> out, std::span<T> in) const {
    static_assert(kIsPlain<T>);
    if (!plan.empty()) exchange_bytes(plan, sizeof(T), out.data(), in.data());
  }

  /// Broadcasts the values of the root to every rank.
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

  /// Worst exit code over ranks, for all of them to return. From mild to grave: 0 done, 75 stopped,
  /// 2 input, 3 cannot continue, 4 file error, 1 internal, anything else.
  int agree_worst(int exit_code) const;

  /// Aborts all processes: this one failed where the others cannot know of it.
  [[noreturn]] void abort(int exit_code) const;

  /// Communication of this process since its start.
  static Traffic traffic();

  /// Collective calls by place, those with most bytes first.
  static std::vector<TrafficPlace> traffic_by_place();

 private:
  Ranks(int rank, int size, int communicator)
      : rank_(rank), size_(size), communicator_(communicator) {}
  template <class T>
  [[gnu::noinline]] void gather_from(  // g++ 12 warns of inlined vectors
      std::span<const T> own, std::vector<T>& all, std::vector<std::size_t>* start, bool at_root,
      const Place& place) const {
    const std::vector<std::size_t> bytes = gather_sizes(own.size_bytes());
    all.clear();
    if (!at_root || is_root()) all.resize(bytes.back() / sizeof(T));
    gather_bytes(own.data(), bytes, at_root, all.data());
    count_gathering(own.size_bytes(), all.size() * sizeof(T), place);
    if (start == nullptr) return;
    start->clear();
    for (const std::size_t b : bytes) start->push_back(b / sizeof(T));
  }
  std::vector<std::size_t> gather_sizes(std::size_t own_bytes) const;
  void gather_bytes(const void* own, const std::vector<std::size_t>& start, bool at_root,
                    void* all) const;
  static void count_gathering(std::size_t own_bytes, std::size_t all_bytes, const Place& place);
  void exchange_bytes(const ExchangePlan& plan, std::size_t size, const void* out, void* in) const;
  void broadcast_bytes(void* bytes, std::size_t n) const;

  int rank_, size_;
  int communicator_;  ///< Fortran handle: an int with every MPI, so this header needs none
};

}  // namespace acinus
