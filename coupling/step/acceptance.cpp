#include "coupling/step/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel/threads.hpp"
#include "coupling/step/active_set.hpp"
#include "coupling/step/cell_sums.hpp"
#include "coupling/step/clearance.hpp"
#include "coupling/step/error_estimate.hpp"
#include "coupling/step/turned_faces.hpp"

namespace acinus::coupling {
namespace {

/// Share of the search depth beyond which a contact that still closes is too deep.
constexpr double kDeepShare = 2.0 / 3;
constexpr double kDeepClosing = 0.1;  ///< um, largest approach of a deep contact in one step

/// Lineage of the cell in a lane; empty for the vessel tree.
std::vector<std::int64_t> lineage_of(const State& s, std::size_t lane) {
  if (lane < s.dcm.n_lane()) return {s.dcm.lineage[lane]};
  const std::size_t cell = lane - s.dcm.n_lane();
  if (cell < s.cbm.n_cell()) return {s.cbm.lineage[cell]};
  return {};
}

/// Length scale of the displacement of a body, um: mean edge of its mesh at rest, of a mesh of
/// equal quality for a sphere, radius of the thinnest vessel.
double edge_of(const World& world, const Workspace& w, std::size_t lane) {
  const State& s = world.state;
  if (lane < s.dcm.n_lane())
    return s.dcm.group[lane / kLanes].topology->mean_rest_length * w.lanes.radius[lane];
  const std::size_t cell = lane - s.dcm.n_lane();
  if (cell < s.cbm.n_cell()) return kSphereEdge * w.cbm_radius[cell];
  return std::ranges::min(world.params.tree.tube, {}, &Tube::radius).radius;
}

/// Extremes of the displacements of cells.
struct Moves {
  static constexpr auto kNone = static_cast<std::size_t>(-1);
  double largest = 0, excess = 0;  ///< um; displacement over its limit
  std::size_t infinite = kNone, too_far = kNone, turned = kNone;  ///< lanes; too_far if excess > 1
  double distance = 0;       ///< um, displacement of the lane too_far
  std::int64_t n_whole = 0;  ///< cells beyond their limit that may move as a whole

  /// Merges two parts; the result does not depend on their order.
  void add(const Moves& o) {
    largest = std::max(largest, o.largest);
    infinite = std::min(infinite, o.infinite);
    turned = std::min(turned, o.turned);
    n_whole += o.n_whole;
    if (o.excess > excess || (o.excess == excess && o.too_far < too_far)) {
      excess = o.excess;
      too_far = o.too_far;
      distance = o.distance;
    }
  }
};

/// Deformable cell beyond its limit of displacement. A cell in liquid may be displaced any distance
/// in a step: what counts is its deformation.
struct WholeCell {
  MovedCell moved;
  Address first = 0;  ///< point
  int n_point = 0;
  double limit = 0;  ///< um
};

/// Moves of the cells of a block.
struct BlockMoves {
  Moves moves;
  std::vector<WholeCell> whole;
};

/// Largest displacement of a node relative to its cell, um.
double largest_deformation(const Workspace& w, const WholeCell& cell) {
  const auto move = [&](int i) {
    return load_point(w.move.data(), cell.first + static_cast<Address>(i * kPointStride));
  };
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < cell.n_point; ++i) mean += move(i) / cell.n_point;
  double deformation = 0;
  for (int i = 0; i < cell.n_point; ++i)
    deformation = std::max(deformation, (move(i) - mean).norm());
  return deformation;
}

Moves gather_moves(const Workspace& w, const Moves& own) {
  if (w.system.ownership.is_whole()) return own;
  std::vector<Moves> moves;
  w.system.ownership.ranks.gather<Moves>(std::span(&own, 1), moves);
  Moves all;
  for (const Moves& m : moves) all.add(m);
  return all;
}

/// Adds the displacements of cells that may move as a whole. Collective.
void add_whole_cells(const World& world, const Workspace& w, std::span<const WholeCell> cells,
                     Moves& own) {
  std::vector<MovedCell> moved;
  for (const WholeCell& c : cells) moved.push_back(c.moved);
  const std::vector<std::uint8_t> clear = find_clear(world, w, moved);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    Moves m;
    m.too_far = moved[k].lane;
    m.distance = clear[k] != 0 ? largest_deformation(w, cells[k]) : moved[k].distance;
    m.excess = m.distance / cells[k].limit;
    own.add(m);
  }
}

Moves reduce_moves(const World& world, const Workspace& w) {
  const State& s = world.state;
  Moves own_cells;
  std::vector<WholeCell> whole;
  for_each_own_cell<BlockMoves>(
      w, true,
      [&](std::size_t lane, Address first, int n_point, BlockMoves& part) {
        double largest2 = 0;
        bool finite = true;
        for (int i = 0; i < n_point; ++i) {
          const Vec3 m = load_point(w.move.data(), first + static_cast<Address>(i * kPointStride));
          finite = finite && m.allFinite();
          largest2 = std::max(largest2, m.squaredNorm());
        }
        const bool deformable = lane < s.dcm.n_lane();
        const double edge = edge_of(world, w, lane);
        const int n_all = w.system.block[lane / kLanes].pattern->n_point;
        for (int i = n_point; i < n_all; ++i) {  // rotations, as what they move at that distance
          const Vec3 m =
              edge * load_point(w.move.data(), first + static_cast<Address>(i * kPointStride));
          finite = finite && m.allFinite();
          largest2 = std::max(largest2, m.squaredNorm());
        }
        const double largest = std::sqrt(largest2);
        Moves own;
        own.largest = largest;
        if (!finite) own.infinite = lane;
        const double limit = move_limit(world.params.numerics.max_move, edge);
        if (finite && deformable && largest > limit) {
          part.whole.push_back({{lane, largest}, first, n_point, limit});
          own.n_whole = 1;
        } else {
          own.too_far = lane;
          own.distance = largest;
          own.excess = own.distance / limit;
        }
        if (finite && deformable && turns_over(s.dcm, lane, w.move)) own.turned = lane;
        part.moves.add(own);
      },
      [&](const BlockMoves& part) {
        own_cells.add(part.moves);
        whole.insert(whole.end(), part.whole.begin(), part.whole.end());
      });
  const Moves all = gather_moves(w, own_cells);
  if (all.n_whole == 0) return all;
  add_whole_cells(world, w, whole, own_cells);
  return gather_moves(w, own_cells);
}

/// Depth of a contact at the end of a step, um; 0 if acceptable. With repulsion in the matrix the
/// depth follows from the load and only the search range bounds it. Otherwise the depth beyond the
/// onset of repulsion counts.
double depth_after(const World& world, const Workspace& w, std::size_t l) {
  const double max_depth = world.params.dcm_contact.max_depth, range = -kDeepShare * max_depth;
  const double unfelt = world.params.numerics.adaptive ? -kControlledDepth : range;
  const solve::Link& link = w.system.links.link[l];
  const solve::ClosedLaw law = w.system.links.law[l].closed();
  const double gap = static_cast<double>(link.gap);
  if (gap > 0.5 * max_depth) return 0;
  const double end = gap_after(w, link);
  if (end - gap > -kDeepClosing) return 0;
  const bool felt = w.system.links.is_closed(l) || law.clearance <= 0;
  const bool deep = end < range || (!felt && clearance_at(end, link, law) < unfelt);
  return deep ? -end : 0;
}

/// Lanes of the two sides of a contact; equal: with boundary or its own nucleus.
std::array<std::size_t, 2> lanes_of(const Workspace& w, const solve::Link& link) {
  const std::size_t a = w.system.lane_of(link.a.point[0]);
  return {a, link.b.exists() ? w.system.lane_of(link.b.point[0]) : a};
}

/// Contact that ends too deep.
struct DeepContact {
  /// Key in the list of contacts: kind, and the lanes or numbers of the two sides.
  std::array<std::size_t, 3> place{};
  std::size_t a = 0, b = 0;  ///< lanes; equal: with boundary or its own nucleus
  bool inner = false, pair = false;
  double depth = 0;  ///< um
};

DeepContact describe_contact(const World& world, const Workspace& w, std::size_t l) {
  const solve::Link& link = w.system.links.link[l];
  const std::size_t number = w.system.links.law[l].contact;
  const contact::Contact& k = w.contacts.all[number];
  const contact::ContactKind kind = w.contacts.kind_of(number);
  DeepContact deep;
  deep.inner = kind == contact::ContactKind::kNucleus;
  deep.pair = link.b.exists();
  const auto [lane_a, lane_b] = lanes_of(w, link);
  deep.a = lane_a;
  deep.b = lane_b;
  deep.depth = depth_after(world, w, l);
  const bool of_cells =
      kind == contact::ContactKind::kSurface || kind == contact::ContactKind::kInterface;
  const auto lane = [&](int body) { return w.dcm.lane_of_body[static_cast<std::size_t>(body)]; };
  const auto a = static_cast<std::size_t>(k.a), b = static_cast<std::size_t>(k.b);
  deep.place = {static_cast<std::size_t>(kind),
                kind == contact::ContactKind::kSphereObstacle ? a : lane(k.a),
                !of_cells                                 ? 0
                : k.partner == contact::Partner::kSurface ? lane(k.b)
                                                          : b};
  return deep;
}

/// First contact of all processes that ends too deep.
std::optional<DeepContact> find_deep_contact(const World& world, const Workspace& w) {
  const std::size_t n = w.system.links.size();
  std::atomic<std::size_t> first = n;
  for_each_index(n, worth_threads(w.system.n_row), [&](std::size_t l) {
    if (!(depth_after(world, w, l) > 0)) return;
    const auto [a, b] = lanes_of(w, w.system.links.link[l]);
    if (w.is_late(a) || w.is_late(b)) return;
    for (std::size_t found = first; l < found && !first.compare_exchange_weak(found, l);) {
    }
  });
  std::vector<DeepContact> own, all;
  if (first < n) own.push_back(describe_contact(world, w, first));
  if (w.system.ownership.is_whole()) return own.empty() ? std::nullopt : std::optional(own.front());
  w.system.ownership.ranks.gather<DeepContact>(own, all);
  if (all.empty()) return {};
  return *std::ranges::min_element(all, {}, &DeepContact::place);
}

/// Part of a displacement after which contacts and faces are checked again.
constexpr double kHalf = 0.5;

Assessment reject(const State& s, std::string cause, std::size_t lane, double usable) {
  return {false, std::move(cause), lineage_of(s, lane), usable, 0, 0, 0};
}

Assessment assess_moves(const World& world, double step, const Workspace& w) {
  const State& s = world.state;
  const Moves m = reduce_moves(world, w);
  Assessment a;
  if (m.infinite != Moves::kNone)
    a = reject(s, name_body(s, m.infinite) + ": its displacement is not finite", m.infinite, 0);
  else if (m.excess > 1)
    a = reject(s,
               fmt::format("{} would move {:.3g} um in {:.4g} s", name_body(s, m.too_far),
                           m.distance, step),
               m.too_far, kMoveShare / m.excess);
  else if (m.turned != Moves::kNone)
    a = reject(s, name_body(s, m.turned) + ": a face would turn over", m.turned, kHalf);
  a.max_move = m.largest;
  a.excess = m.excess;
  return a;
}

Assessment assess_contacts(const World& world, const Workspace& w) {
  const State& s = world.state;
  const std::optional<DeepContact> deep = find_deep_contact(world, w);
  if (!deep) return {};
  const std::string into = deep->inner  ? "its nucleus"
                           : deep->pair ? name_body(s, deep->b)
                                        : "its boundary";
  Assessment result = reject(
      s,
      fmt::format("{} would be driven {:.2f} um into {}", name_body(s, deep->a), deep->depth, into),
      deep->a, kHalf);
  if (deep->pair && deep->b != deep->a)
    for (const std::int64_t lineage : lineage_of(s, deep->b)) result.cells.push_back(lineage);
  return result;
}

}  // namespace

double move_limit(double max_move, double mean_edge) {
  return max_move > 0 ? max_move * mean_edge : std::numeric_limits<double>::infinity();
}

std::vector<std::size_t> find_limiting_cells(const World& world, double step, Workspace& w) {
  const State& s = world.state;
  const Numerics& n = world.params.numerics;
  const PointErrors errors(world, step, w);
  const double most_error = kMostOverMean * kErrorAim * n.tolerance;
  std::vector<std::size_t> limiting;
  for_each_own_cell<std::vector<std::size_t>>(
      w, true,
      [&](std::size_t lane, Address first, int n_point, std::vector<std::size_t>& part) {
        double move2 = 0, error2 = 0;
        for (int i = 0; i < n_point; ++i) {
          const Address at = first + static_cast<Address>(i * kPointStride);
          move2 = std::max(move2, load_point(w.move.data(), at).squaredNorm());
        }
        errors.for_each(first, n_point,
                        [&](const Vec3& e) { error2 = std::max(error2, e.squaredNorm()); });
        const double limit = kMoveShare * move_limit(n.max_move, edge_of(world, w, lane));
        if (!(move2 <= limit * limit) || !(error2 <= most_error * most_error) ||
            (lane < s.dcm.n_lane() && turns_over(s.dcm, lane, w.move)))
          part.push_back(lane);
      },
      [&](const std::vector<std::size_t>& part) {
        limiting.insert(limiting.end(), part.begin(), part.end());
      });
  for (std::size_t l = 0; l < w.system.links.size(); ++l)
    if (depth_after(world, w, l) > 0)
      for (const std::size_t lane : lanes_of(w, w.system.links.link[l])) limiting.push_back(lane);
  return limiting;
}

Assessment assess_step(const World& world, double step, double part, const Status& solved,
                       Workspace& w) {
  if (!solved.ok) {
    ++w.failed_solves;
    Assessment failed;
    failed.accepted = false;
    failed.cause = solved.cause;
    return failed;
  }
  const auto scope = w.timings.scope("acceptance");
  Assessment a = assess_moves(world, step, w);
  if (!a.accepted) return a;
  const Assessment moves = std::move(a);
  a = assess_contacts(world, w);
  a.max_move = moves.max_move;
  a.excess = moves.excess;
  if (!a.accepted) return a;
  a.error = (2 - part) * estimate_error(world, step, w);
  const Numerics& n = world.params.numerics;
  const double most = kMostError * n.tolerance;
  if (n.adaptive && a.error > most && step > n.min_step) {
    a.accepted = false;
    a.usable = kHalf * most / a.error;
    a.cause = "the estimated error is too large";
  }
  return a;
}

}  // namespace acinus::coupling
