#include "coupling/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace acinus::coupling {
namespace {

/// A predicted gap below minus this share of the search depth, still closing, is too deep.
constexpr double kDeep = 2.0 / 3;
/// The same with step-size control, um: a contact that appears within a step is only felt in the
/// next, so a cell that snaps forward would stand this deep in a hard obstacle until then.
constexpr double kControlledDepth = 0.2;
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

/// f(lane, address of its first point, number of points) for every cell.
template <class F>
void for_each_cell(const Workspace& w, F f) {
  for (std::size_t b = 0; b < w.system.block.size(); ++b)
    for (int l = 0; l < kLanes; ++l) {
      const std::size_t lane = b * kLanes + static_cast<std::size_t>(l);
      if (w.active[lane])
        f(lane, make_address(w.system.block[b].first_row, l), w.system.block[b].pattern->n_point);
    }
}

/// The first triangle of a cell that the move turns over, or -1.
int find_turned_face(const dcm::State& s, std::size_t lane, const std::vector<double>& move) {
  const mesh::Topology& t = *s.group[lane / kLanes].topology;
  for (std::size_t f = 0; f < t.triangle.size(); ++f) {
    Vec3 before[3], after[3];
    for (std::size_t m = 0; m < 3; ++m) {
      const Address a = dcm::node_address(s, lane, t.triangle[f][m]);
      before[m] = load_point(s.position.data(), a);
      after[m] = before[m] + load_point(move.data(), a);
    }
    const Vec3 n0 = (before[1] - before[0]).cross(before[2] - before[0]);
    const Vec3 n1 = (after[1] - after[0]).cross(after[2] - after[0]);
    if (!(n0.dot(n1) > 0)) return static_cast<int>(f);
  }
  return -1;
}

}  // namespace

double move_limit(double max_move, double mean_edge) {
  return max_move > 0 ? max_move * mean_edge : std::numeric_limits<double>::infinity();
}

double error_norm(const World& world, const Workspace& w, std::span<const double> field) {
  const bool noise = world.params.motility.random &&
                     controls_at(world.state.clock, world.params.start_up).motility;
  double sum2 = 0, largest2 = 0, n = 0;
  for_each_cell(w, [&](std::size_t, Address first, int n_point) {
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
      sum2 += e2;
      largest2 = std::max(largest2, e2);
    }
    n += n_point;
  });
  return n > 0 ? std::max(std::sqrt(sum2 / n), std::sqrt(largest2) / 5) : 0;
}

double estimate_error(const World& world, double step, Workspace& w) {
  const State& s = world.state;
  if (s.clock.last_step <= 0 || s.last_move.size() != w.move.size()) return 0;
  const double ratio = step / s.clock.last_step;
  auto& change = w.cg.product;
  change.resize(w.move.size());
  for (std::size_t k = 0; k < w.move.size(); ++k)
    change[k] = 0.5 * (w.move[k] - ratio * s.last_move[k]);
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
  double worst = 1;  // of all cells that move too far, the one that does so most is named
  for_each_cell(w, [&](std::size_t lane, Address first, int n_point) {
    double largest = 0;
    for (int i = 0; i < n_point; ++i) {
      const Vec3 m = load_point(w.move.data(), first + static_cast<Address>(i * kPointStride));
      if (!m.allFinite() && v.good)
        return reject(fmt::format("{}: its displacement is not finite", name_lane(s, lane)), lane);
      largest = std::max(largest, m.norm());
    }
    v.max_move = std::max(v.max_move, largest);
    const bool deformable = lane < s.dcm.n_lane();
    const double edge =
        deformable ? s.dcm.group[lane / kLanes].topology->mean_rest_length * w.lanes.radius[lane]
                   : kSphereEdge * w.cbm_radius[lane - s.dcm.n_lane()];
    const double excess = largest / move_limit(world.params.numerics.max_move, edge);
    if (excess > worst) {
      worst = excess;
      return reject(
          fmt::format("{} would move {:.3g} um in {:.4g} s", name_lane(s, lane), largest, step),
          lane);
    }
    if (!v.good) return;
    if (deformable && find_turned_face(s.dcm, lane, w.move) >= 0)
      return reject(fmt::format("{}: a face would turn over", name_lane(s, lane)), lane);
  });
  if (!v.good) return v;

  const solve::Links& links = w.system.links;
  const double deep =
      -(world.params.numerics.adaptive ? kControlledDepth
                                       : kDeep * world.params.dcm_contact.max_depth);
  const double near = 0.5 * world.params.dcm_contact.max_depth;
  for (const solve::Link& link : links.link) {
    const double gap = static_cast<double>(link.gap);
    if (gap > near) continue;
    const solve::Stencil stencil = solve::stencil_of(link);
    Vec3 r = Vec3::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.n); ++k)
      r += stencil.weight[k] * load_point(w.move.data(), stencil.address[k]);
    double opening = 0;
    for (int k = 0; k < 3; ++k)
      opening += static_cast<double>(link.normal[static_cast<std::size_t>(k)]) * r[k];
    if (gap + opening < deep && opening < -kClosing) {
      const bool pair = link.b.exists();
      const std::size_t a = lane_of(w, solve::address_of(link.a.point[0]));
      const std::size_t b = pair ? lane_of(w, solve::address_of(link.b.point[0])) : a;
      reject(fmt::format("{} would be driven {:.2f} um into {}", name_lane(s, a), -(gap + opening),
                         pair ? name_lane(s, b) : std::string("its surroundings")),
             a);
      if (pair && b != a) v.cells.push_back(lineage_of(s, b));
      return v;
    }
  }
  v.error = estimate_error(world, step, w);
  return v;
}

Balance measure_balance(const World& world, Workspace& w) {
  // Of A dx = b the residual is known; displacements made up of stages need the product.
  const Integrator method = world.params.numerics.integrator;
  if (method == Integrator::kRos2 || method == Integrator::kNewton) {
    w.op.apply(w.move, w.cg.product);
    for (std::size_t k = 0; k < w.rhs.size(); ++k) w.cg.residual[k] = w.rhs[k] - w.cg.product[k];
  }
  w.op.apply_external(w.move, w.cg.product);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero(), rest_torque = Vec3::Zero(),
       center = Vec3::Zero();
  double force_size = 0, torque_size = 0, rest_torque_size = 0, n = 0;
  auto for_each_point = [&](auto f) {
    for_each_cell(w, [&](std::size_t, Address first, int n_point) {
      for (int i = 0; i < n_point; ++i) f(first + static_cast<Address>(i * kPointStride));
    });
  };
  for_each_point([&](Address a) {
    center += load_point(w.position.data(), a);
    n += 1;
  });
  if (n > 0) center /= n;
  for_each_point([&](Address a) {
    const Vec3 conservative = load_point(w.system.force.data(), a);
    // what pair friction and the pair forces' change exert during the step
    const Vec3 product = load_point(w.rhs.data(), a) - load_point(w.cg.residual.data(), a);
    const Vec3 rest = load_point(w.cg.product.data(), a) - product;
    const Vec3 arm = load_point(w.position.data(), a) - center;
    force += conservative + rest;
    force_size += conservative.norm() + rest.norm();
    torque += arm.cross(conservative);
    torque_size += arm.norm() * conservative.norm();
    rest_torque += arm.cross(rest);
    rest_torque_size += arm.norm() * rest.norm();
  });
  Balance b;
  b.momentum = force_size > 0 ? force.norm() / force_size : 0;
  b.torque = torque_size > 0 ? torque.norm() / torque_size : 0;
  b.friction_torque = rest_torque_size > 0 ? rest_torque.norm() / rest_torque_size : 0;
  return b;
}

}  // namespace acinus::coupling
