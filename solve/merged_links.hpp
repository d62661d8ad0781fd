#pragma once
/// Contacts of surfaces merged into blocks between points, for products in float of long solves.
///
/// A contact with the matrix M between w0 x0 + w1 x1 + w2 x2 and v0 y0 + v1 y1 + v2 y2 is the same
/// as springs between all its points: w_i v_j M between two of different sides, -w_i w_k M between
/// two of the same side. Many contacts share their points, so there are fewer pairs than contacts,
/// each cheaper to multiply by; and the pairs within a side are springs of the mesh already, to
/// they add. Rounding leaves a pair blind to translation but not to rotation: good enough for a
/// correction that is checked with the contacts themselves, in double.

#include <array>
#include <cstdint>
#include <vector>

#include "solve/link_kernels.hpp"
#include "solve/point_pair_table.hpp"
#include "solve/system.hpp"

namespace acinus::solve {

/// True if a contact is worth merging: side a is inside a face of a mesh, side b on another or a
/// single point. Contacts of nodes and edges share too few points: a product takes longer with them
/// merged.
bool is_merged(const System& system, const Link& link);

/// Merged contacts of a system.
struct MergedLinks {
  PointPairs pairs;       ///< across the cells
  RowVector<float> edge;  ///< [n_spring][6][lane] nN/um, springs with the pairs within a side
};

/// Merges the contacts of one pair of cells at a time; the result does not depend on the number of
/// threads.
class LinkMerger {
 public:
  /// @return false, without result, if no contact of any process is merged. Collective.
  bool merge(const System& system, MergedLinks& out);
  std::size_t memory() const;  ///< of the scratch, bytes

 private:
  /// Consecutive contacts that join the same two cells.
  struct LinkRun {
    std::uint64_t cells;  ///< the two cells, the lower one first
    std::uint32_t first, last;
    bool swapped;  ///< true if side a is on the second cell
  };
  /// One side of the contacts of a run.
  struct RunEnd {
    std::uint32_t block, run;
    bool is_b;
  };
  void update_runs(const System& system);
  void add_across(const System& system, PointPairs& pairs);
  void add_within(const System& system, RowVector<float>& edge);

  std::vector<std::vector<LinkRun>> found_;  ///< [thread]
  std::vector<LinkRun> run_;                 ///< sorted by pair of cells
  std::vector<std::size_t> group_;     ///< first run of each pair of cells; then the number of runs
  std::vector<RunEnd> end_;            ///< sorted by block
  std::vector<PointPairs> part_;       ///< [other threads than the first]
  std::vector<PointPairTable> table_;  ///< [thread]
};

}  // namespace acinus::solve
