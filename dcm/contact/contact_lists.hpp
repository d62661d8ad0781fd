#pragma once
/// Neighbour lists of deformable cells, kept from step to step.
///
/// A list holds until its two bodies have moved relative to each other by more than the skin; then
/// it alone is rebuilt. A cell that divides or moves fast costs only its neighbours new lists. The
/// contacts found do not depend on the age of a list.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "geometry/network.hpp"

namespace acinus::dcm {

/// Vessel segments that each site of a body may touch.
struct SegmentCandidates {
  std::vector<int> site;
  std::vector<std::uint32_t> start;
  std::vector<int> segment;
};

/// Motion of the nodes of a body.
struct NodeMotion {
  Vec3 mean = Vec3::Zero();  ///< um
  double spread = 0;         ///< um, bound of the deviation of a node's motion from the mean

  NodeMotion operator+(const NodeMotion& then) const {
    return {mean + then.mean, spread + then.spread};
  }
};

/// Nodes of a body at one time.
struct ListedNodes {
  std::vector<std::array<std::int16_t, 3>> node;  ///< from the origin, in units of `unit`
  Vec3 origin = Vec3::Zero();                     ///< um
  double unit = 0;                                ///< um
};

/// Time at which lists with a body were made.
struct ListTime {
  NodeMotion motion;  ///< from then to the latest such time of the body
  int lists = 0;      ///< number of lists made then; 0: free slot
};

/// Body as the lists keep it. Cells are identified by lineage when their numbers change.
struct ListedBody {
  std::int64_t lineage = -1;
  const geometry::Topology* topology = nullptr;
  bool constrained = false, ghost = false;
  Box box;                     ///< at the last search for pairs
  ListedNodes latest;          ///< at the latest of the times
  NodeMotion motion;           ///< since then; allows for the rounding of the nodes
  std::vector<ListTime> time;  ///< at which its lists were made
};

/// Age of a list: the times of its bodies at which it was made (-1: body without one), and the
/// range.
struct ListAge {
  int a = -1, b = -1;
  double range = 0;  ///< um
  bool made() const { return a >= 0; }
};

/// Scratch of refresh_lists.
struct ListScratch {
  std::vector<std::uint8_t> is_expired;  ///< [pair]
  std::vector<std::size_t> expired, segments_expired;
  std::vector<int> now;  ///< [body] the present time among its times, -1: none
  std::vector<contact::Candidates*> to_fill;
};

struct ContactLists {
  contact::SearchOptions options;  ///< of the lists; the range is the latest one
  std::size_t n_fixed = 0;
  std::vector<ListedBody> body;
  std::vector<contact::Candidates> pair;   ///< ascending
  std::vector<ListAge> age;                ///< [pair]
  std::vector<SegmentCandidates> segment;  ///< [body]
  std::vector<ListAge> segment_age;        ///< [body]
  /// Moving network at the time from which its motion is measured; all lists of segments are
  /// younger.
  geometry::Network network;
  std::int64_t checked = 0, made = 0;  ///< lists checked and made, over all calls
  ListScratch scratch;
};

/// Bodies at the present time. The spans outlive the call.
struct ListInput {
  std::span<const contact::SurfaceBody> body, fixed;
  std::span<const std::int64_t> lineage;      ///< [body]
  std::span<const std::uint8_t> constrained;  ///< [body] 1: does not move; empty: all move
  std::span<const std::uint8_t> ghost;        ///< [body] 1: of another process; empty: none
  const geometry::Network& network;
  contact::SearchOptions options;
  bool network_moves = false;
};

/// Search for the pairs of near bodies again if those listed no longer hold; reads only boxes.
/// Pairs of two constrained bodies and of two ghost bodies are left out.
void refresh_pairs(const ListInput& in, ContactLists& lists);

/// Rebuild the lists that no longer hold. @pre refresh_pairs
void refresh_lists(const ListInput& in, ContactLists& lists);

/// Relative motion of the bodies of a pair since its list was made, um.
double relative_motion(const ContactLists& lists, std::size_t pair);

}  // namespace acinus::dcm
