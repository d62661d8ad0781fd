#pragma once
/// Which parts of deformable cells may meet which others, kept from step to step.
///
/// A list holds until its two bodies have moved relative to each other by more than the skin; then
/// it alone is made again. A cell that divides or moves fast costs its neighbours new lists, and
/// no other. What contacts are found does not depend on when a list was made.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidates.hpp"
#include "geometry/network.hpp"

namespace acinus::dcm {

/// Vessel segments that each site of a body may meet.
struct SegmentCandidates {
  std::vector<int> site;
  std::vector<std::uint32_t> start;
  std::vector<int> segment;
};

/// The nodes of a body when lists with it were made, and how they moved since.
struct ListSnapshot {
  std::vector<Eigen::Vector3f> node;  ///< um from the origin; lists allow for the rounding
  Vec3 origin = Vec3::Zero();         ///< um
  Vec3 mean = Vec3::Zero();           ///< um, movement since then
  double spread = 0;                  ///< um, largest deviation of a node's movement from the mean
  int lists = 0;                      ///< how many were made then; 0: its place is free
};

/// A body as the lists know it. Cells are recognised by their lineage when their numbers change.
struct ListedBody {
  std::int64_t lineage = -1;
  const geometry::Topology* topology = nullptr;
  bool constrained = false, ghost = false;
  Box box;  ///< when pairs were looked for
  std::vector<ListSnapshot> snapshot;
};

/// When a list was made: the snapshots of its bodies (-1: of what has none), and the range then.
struct ListAge {
  int a = -1, b = -1;
  double range = 0;  ///< um
  bool made() const { return a >= 0; }
};

/// Scratch of refresh_lists.
struct ListScratch {
  std::vector<std::uint8_t> is_expired;  ///< [pair]
  std::vector<std::size_t> expired, segments_expired;
  std::vector<int> latest;  ///< [body] the snapshot of this moment, -1: none
  std::vector<contact::Candidates*> to_fill;
};

struct ContactLists {
  contact::SearchOptions options;  ///< they were made with; the range is the latest
  std::size_t n_fixed = 0;
  std::vector<ListedBody> body;
  std::vector<contact::Candidates> pair;   ///< ascending
  std::vector<ListAge> age;                ///< [pair]
  std::vector<SegmentCandidates> segment;  ///< [body]
  std::vector<ListAge> segment_age;        ///< [body]
  /// A network that moves as it was at a moment from which it did not go far since; all lists of
  /// segments are younger.
  geometry::Network network;
  std::int64_t checked = 0, made = 0;  ///< how often a list was looked at, and made
  ListScratch scratch;
};

/// The bodies of this moment. The spans outlive the call.
struct ListInput {
  std::span<const contact::SurfaceBody> body, fixed;
  std::span<const std::int64_t> lineage;      ///< [body]
  std::span<const std::uint8_t> constrained;  ///< [body] 1: does not move; empty: all move
  std::span<const std::uint8_t> ghost;        ///< [body] 1: of another process; empty: none
  const geometry::Network& network;
  contact::SearchOptions options;
  bool network_moves = false;
};

/// Looks for the pairs of near bodies again if those listed no longer hold; reads only boxes.
/// Nothing is listed between bodies that are constrained, nor between ghost ones.
void refresh_pairs(const ListInput& in, ContactLists& lists);

/// Makes those lists again that no longer hold. @pre refresh_pairs
void refresh_lists(const ListInput& in, ContactLists& lists);

/// How far the bodies of a pair moved relative to each other since its list was made, um.
double relative_motion(const ContactLists& lists, std::size_t pair);

}  // namespace acinus::dcm
