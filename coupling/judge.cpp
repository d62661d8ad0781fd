#include "coupling/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/threads.hpp"
#include "coupling/closing.hpp"

namespace acinus::coupling {
namespace {

/// A predicted gap below minus this share of the search depth, still closing, is too deep.
constexpr double kDeep = 2.0 / 3;
constexpr double kClosing = 0.1;  ///< um a deep contact may still close in one step

std::string name_lane(const State& s, std::size_t lane) {
  return lane < s.dcm.n_lane() ? name_dcm(s, lane) : name_cbm(s, lane - s.dcm.n_lane());
}
std::int64_t lineage_of(const State& s, std::size_t lane) {
  return lane < s.dcm.n_lane() ? s.dcm.lineage[lane] : s.cbm.lineage[lane - s.dcm.n_lane()];
}

/// Lane index (dcm lanes, then cbm cells) of an address.
std::size_t lane_of(const Workspace& w, Address a) {
  const auto& blocks = w.system.block;
  const std::size_t row = a / kPointStride;
  const auto it =
      std::ranges::upper_bound(blocks, row, {}, [](const solve::Block& b) { return b.first_row; });
  return static_cast<std::size_t>(it - blocks.begin() - 1) * kLanes + a % kLanes;
}

/// Point rows that one part of a sum covers at least.
constexpr std::size_t kPartRows = 64;

/// f(lane, address of its first point, number of points, part) for every cell; the parts are added
/// up in order; of moving cells only, or all. Parts follow from the blocks alone, so the sum is the
/// same for any number of threads.
template <class Part, class F>
Part sum_over_cells(const Workspace& w, bool moving_only, F f) {
  const auto& block = w.system.block;
  std::vector<std::size_t> start{0};
  for (std::size_t b = 0; b < block.size(); ++b)
    if (block[b].first_row - block[start.back()].first_row >= kPartRows) start.push_back(b);
  start.push_back(block.size());
  std::vector<Part> part(start.size() - 1);
#pragma omp parallel for schedule(static) if (worth_threads(w.system.n_row))
  for (std::size_t k = 0; k < part.size(); ++k)
    for (std::size_t b = start[k]; b < start[k + 1]; ++b)
      for (int l = 0; l < kLanes; ++l) {
        const std::size_t lane = b * kLanes + static_cast<std::size_t>(l);
        if (w.active[lane] && !(moving_only && !w.held.empty() && w.held[lane]))
          f(lane, make_address(block[b].first_row, l), block[b].pattern->n_point, part[k]);
      }
  Part total;
  for (const Part& p : part) total.add(p);
  return total;
}

/// Share of its area a face must keep in a step, seen along its normal: one that shrinks faster is
/// resolved by shorter steps before it has no direction left.
constexpr double kLeastArea = 0.25;

/// Whether a move turns a face over, or nearly, or folds two faces of an edge through each other.
bool turns_over(const dcm::State& s, std::size_t lane, const std::vector<double>& move) {
  const mesh::Topology& t = *s.group[lane / kLanes].topology;
  struct Normals {
    Vec3 before, after;
  };
  thread_local std::vector<Normals> normal;
  normal.clear();
  for (const auto& corner : t.triangle) {
    Vec3 before[3], after[3];
    for (std::size_t m = 0; m < 3; ++m) {
      const Address a = dcm::node_address(s, lane, corner[m]);
      before[m] = load_point(s.position.data(), a);
      after[m] = before[m] + load_point(move.data(), a);
    }
    normal.push_back({(before[1] - before[0]).cross(before[2] - before[0]),
                      (after[1] - after[0]).cross(after[2] - after[0])});
    const auto& [was, is] = normal.back();
    if (!(was.dot(is) > kLeastArea * was.squaredNorm())) return true;
  }
  for (std::size_t e = 0; e < t.edge.size(); ++e) {
    const Normals &f = normal[static_cast<std::size_t>(t.edge_triangle[e][0])],
                  &g = normal[static_cast<std::size_t>(t.edge_triangle[e][1])];
    if (f.before.dot(g.before) > 0 || f.after.dot(g.after) > 0) continue;
    // Faces beyond a right angle on both sides of the step: the edge must bend the same way still.
    const Address a = dcm::node_address(s, lane, t.edge[e][0]),
                  b = dcm::node_address(s, lane, t.edge[e][1]);
    const Vec3 along = load_point(s.position.data(), b) - load_point(s.position.data(), a);
    const Vec3 moved = load_point(move.data(), b) - load_point(move.data(), a);
    if (f.before.cross(g.before).dot(along) * f.after.cross(g.after).dot(along + moved) < 0)
      return true;
  }
  return false;
}

}  // namespace

double move_limit(double max_move, double mean_edge) {
  return max_move > 0 ? max_move * mean_edge : std::numeric_limits<double>::infinity();
}

double error_norm(const World& world, const Workspace& w, std::span<const double> field) {
  const bool noise = world.params.motility.random &&
                     controls_at(world.state.clock, world.params.start_up).motility;
  struct Part {
    double sum2 = 0, largest2 = 0, n = 0;
    void add(const Part& o) {
      sum2 += o.sum2;
      largest2 = std::max(largest2, o.largest2);
      n += o.n;
    }
  };
  const Part p =
      sum_over_cells<Part>(w, true, [&](std::size_t, Address first, int n_point, Part& part) {
        auto at = [&](int i) {
          return load_point(field.data(), first + static_cast<Address>(i * kPointStride));
        };
        Vec3 mean = Vec3::Zero();
        if (noise) {
          for (int i = 0; i < n_point; ++i) mean += at(i);
          mean /= n_point;
        }
        for (int i = 0; i < n_point; ++i) {
          const double e2 = (at(i) - mean).squaredNorm();
          part.sum2 += e2;
          part.largest2 = std::max(part.largest2, e2);
        }
        part.n += n_point;
      });
  return p.n > 0 ? std::max(std::sqrt(p.sum2 / p.n), std::sqrt(p.largest2) / 5) : 0;
}

double estimate_error(const World& world, double step, Workspace& w) {
  const State& s = world.state;
  auto& change = w.cg.product;
  change.resize(w.move.size());
  for_each_number(w.move.size(), [&](std::size_t k) { change[k] = 0.5 * w.move[k]; });
  if (has_last_move(s)) {  // else the step is compared with rest
    const double ratio = step / s.clock.last_step;
    for_each_number(w.move.size(),
                    [&](std::size_t k) { change[k] -= 0.5 * ratio * s.last_move[k]; });
  }
  return error_norm(world, w, change);
}

Verdict judge_step(const World& world, double step, Workspace& w) {
  const State& s = world.state;
  Verdict v;
  auto reject = [&](std::string why, std::size_t lane) {
    v.good = false;
    v.cause = std::move(why);
    v.cells = {lineage_of(s, lane)};
  };
  constexpr auto kNone = static_cast<std::size_t>(-1);
  struct Part {
    double largest = 0, excess = 1;
    std::size_t infinite = kNone, too_far = kNone, turned = kNone;  ///< lanes
    double distance = 0;                                            ///< um, of the lane too far
    void add(const Part& o) {
      largest = std::max(largest, o.largest);
      if (infinite == kNone) infinite = o.infinite;
      if (turned == kNone) turned = o.turned;
      if (o.excess > excess) {  // of all cells that move too far, the one that does so most
        excess = o.excess;
        too_far = o.too_far;
        distance = o.distance;
      }
    }
  };
  const Part p =
      sum_over_cells<Part>(w, true, [&](std::size_t lane, Address first, int n_point, Part& part) {
        double largest2 = 0;
        bool finite = true;
        for (int i = 0; i < n_point; ++i) {
          const Vec3 m = load_point(w.move.data(), first + static_cast<Address>(i * kPointStride));
          finite = finite && m.allFinite();
          largest2 = std::max(largest2, m.squaredNorm());
        }
        const double largest = std::sqrt(largest2);
        const bool deformable = lane < s.dcm.n_lane();
        const double edge = deformable ? s.dcm.group[lane / kLanes].topology->mean_rest_length *
                                             w.lanes.radius[lane]
                                       : kSphereEdge * w.cbm_radius[lane - s.dcm.n_lane()];
        Part own;
        own.largest = largest;
        if (!finite) own.infinite = lane;
        own.excess = largest / move_limit(world.params.numerics.max_move, edge);
        own.too_far = lane;
        own.distance = largest;
        if (finite && deformable && turns_over(s.dcm, lane, w.move)) own.turned = lane;
        part.add(own);
      });
  v.max_move = p.largest;
  if (p.infinite != kNone)
    reject(fmt::format("{}: its displacement is not finite", name_lane(s, p.infinite)), p.infinite);
  else if (p.too_far != kNone)
    reject(fmt::format("{} would move {:.3g} um in {:.4g} s", name_lane(s, p.too_far), p.distance,
                       step),
           p.too_far);
  else if (p.turned != kNone)
    reject(fmt::format("{}: a face would turn over", name_lane(s, p.turned)), p.turned);
  if (!v.good) return v;

  const solve::Links& links = w.system.links;
  // Where the repulsion is in the matrix, depth is a matter of load, not of the step: only the
  // range of the search bounds it. Where it is not, what counts is the depth beyond the point at
  // which the contact would have begun to push.
  const double range = -kDeep * world.params.dcm_contact.max_depth;
  const double unfelt = world.params.numerics.adaptive ? -kControlledDepth : range;
  const double near = 0.5 * world.params.dcm_contact.max_depth;
  auto depth_after = [&](std::size_t l) {  // um; 0: no danger
    const solve::Link& link = links.link[l];
    const solve::LinkLoad& load = links.load[l];
    const double gap = static_cast<double>(link.gap);
    if (gap > near) return 0.0;
    const double end = gap_after(w, link);
    if (end - gap > -kClosing) return 0.0;
    const bool felt = load.active || load.clearance <= 0;
    const bool deep = end < range || (!felt && clearance_at(end, link, load) < unfelt);
    return deep ? -end : 0.0;
  };
  std::size_t first_deep = links.size();
#pragma omp parallel for schedule(static) \
    reduction(min                         \
              : first_deep) if (worth_threads(w.system.n_row))
  for (std::size_t l = 0; l < links.size(); ++l)
    if (depth_after(l) > 0) first_deep = std::min(first_deep, l);
  if (first_deep < links.size()) {
    const solve::Link& link = links.link[first_deep];
    const bool pair = link.b.exists();
    const std::size_t a = lane_of(w, solve::address_of(link.a.point[0]));
    const std::size_t b = pair ? lane_of(w, solve::address_of(link.b.point[0])) : a;
    reject(fmt::format("{} would be driven {:.2f} um into {}", name_lane(s, a),
                       depth_after(first_deep),
                       pair ? name_lane(s, b) : std::string("its surroundings")),
           a);
    if (pair && b != a) v.cells.push_back(lineage_of(s, b));
    return v;
  }
  v.error = estimate_error(world, step, w);
  return v;
}

Balance measure_balance(const World& world, Workspace& w) {
  // Of A dx = b the residual is known; displacements made up of stages need the product.
  const Integrator method = world.params.numerics.integrator;
  if (method == Integrator::kRos2 || method == Integrator::kNewton) {
    w.op.apply(w.move, w.cg.product);
    for_each_number(w.rhs.size(),
                    [&](std::size_t k) { w.cg.residual[k] = w.rhs[k] - w.cg.product[k]; });
  }
  if (w.ahead.used()) {  // the matrix is that of the rest of the way
    for_each_number(w.move.size(), [&](std::size_t k) { w.move[k] -= w.ahead.move[k]; });
    w.op.apply_external(w.move, w.cg.product);
    for_each_number(w.move.size(), [&](std::size_t k) {
      w.move[k] += w.ahead.move[k];
      w.cg.product[k] -= w.ahead.pair_friction[k];
    });
  } else {
    w.op.apply_external(w.move, w.cg.product);
  }
  struct Middle {
    Vec3 sum = Vec3::Zero();
    double n = 0;
    void add(const Middle& o) {
      sum += o.sum;
      n += o.n;
    }
  };
  const Middle middle =
      sum_over_cells<Middle>(w, true, [&](std::size_t, Address first, int n_point, Middle& part) {
        for (int i = 0; i < n_point; ++i)
          part.sum += load_point(w.position.data(), first + static_cast<Address>(i * kPointStride));
        part.n += n_point;
      });
  const Vec3 center = middle.sum / std::max(middle.n, 1.0);
  struct Sums {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero(), rest_torque = Vec3::Zero();
    double force_size = 0, torque_size = 0, rest_torque_size = 0;
    void add(const Sums& o) {
      force += o.force;
      torque += o.torque;
      rest_torque += o.rest_torque;
      force_size += o.force_size;
      torque_size += o.torque_size;
      rest_torque_size += o.rest_torque_size;
    }
  };
  const Sums t =
      sum_over_cells<Sums>(w, false, [&](std::size_t, Address first, int n_point, Sums& part) {
        for (int i = 0; i < n_point; ++i) {
          const Address a = first + static_cast<Address>(i * kPointStride);
          const Vec3 conservative = load_point(w.system.force.data(), a);
          // what pair friction and the pair forces' change exert during the step
          const Vec3 product = load_point(w.rhs.data(), a) - load_point(w.cg.residual.data(), a);
          const Vec3 rest = load_point(w.cg.product.data(), a) - product;
          const Vec3 arm = load_point(w.position.data(), a) - center;
          part.force += conservative + rest;
          part.force_size += conservative.norm() + rest.norm();
          part.torque += arm.cross(conservative);
          part.torque_size += arm.norm() * conservative.norm();
          part.rest_torque += arm.cross(rest);
          part.rest_torque_size += arm.norm() * rest.norm();
        }
      });
  auto relative = [](const Vec3& sum, double size) { return size > 0 ? sum.norm() / size : 0; };
  return {relative(t.force, t.force_size), relative(t.torque, t.torque_size),
          relative(t.rest_torque, t.rest_torque_size)};
}

}  // namespace acinus::coupling
