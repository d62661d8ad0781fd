#pragma once
/// The processes that share one run. Passed by value; nothing else in the program knows MPI, and a
/// plain start (no mpirun) never touches it.

#include <span>

namespace acinus {

/// A group of processes. Every collective call must be made by all of them, in the same order.
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

  /// In place sum over ranks, elementwise, added in rank order on the root and sent back: the same
  /// bits on every rank and in every run with this number of ranks. O(size * n) on the root.
  /// @param values  same length on every rank (asserted)
  void sum(std::span<double> values) const;
  double sum(double value) const;

  /// Largest value; NaN on any rank gives NaN everywhere, so a lost rank cannot pass unnoticed.
  double max(double value) const;

  /// True on all ranks if it is on one.
  bool any(bool value) const;

  void barrier() const;

  /// The exit code all ranks return. From mild to grave: 0 done, 75 stopped, 2 input, 3 cannot
  /// continue, 4 file error, 1 internal, anything else.
  int agree_worst(int exit_code) const;

 private:
  Ranks(int rank, int size, int communicator)
      : rank_(rank), size_(size), communicator_(communicator) {}
  int rank_, size_;
  int communicator_;  ///< Fortran handle: an int with every MPI, so this header needs none
};

/// Exchange of unknowns between owners and their copies (ghosts) on neighbouring ranks. The solver
/// calls it around every product; with one rank there are no copies and both calls do nothing.
/// Distribution over more ranks is not built: there both throw Error(kInternal) rather than return
/// wrong sums.
struct Halo {
  Ranks ranks = Ranks::serial();
  /// Owner -> copies: x of every ghost entry becomes its owner's value.
  /// @param x  [n_unknown], ghosts last
  void update(std::span<double> x) const;
  /// Copies -> owner: adds what was gathered in ghost entries to the owner's entry and clears the
  /// ghosts.
  /// @param y  [n_unknown], ghosts last
  void add_back(std::span<double> y) const;
};

}  // namespace acinus
