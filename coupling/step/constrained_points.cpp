#include "coupling/step/constrained_points.hpp"

namespace acinus::coupling {
namespace {

/// Penalty stiffness of a constrained point, nN/um: large enough that other points do not feel it
/// move, small enough for the conditioning of the solve. The remaining displacement is discarded:
/// add_constraint yields the reaction force, place_constrained the position.
constexpr double kStiffness = 1e6;

/// Calls f with the row and the lane of every constrained point.
template <class F>
void for_each_constrained_point(const Workspace& w, F f) {
  for (const std::size_t row : w.constraint.anchored_row) f(row, std::size_t{0});
  if (!w.constraint.applies()) return;
  for (std::size_t lane = 0; lane < w.active.size(); ++lane) {
    const solve::Block& b = w.system.block[lane / kLanes];
    if (!w.constraint.holds(lane) && !b.still) continue;  // with the empty lanes beside these
    for (int i = 0; i < b.pattern->n_point; ++i) f(b.first_row + i, lane % kLanes);
  }
}

}  // namespace

void apply_constraints(Workspace& w) {
  w.dcm.constrained.clear();
  w.cbm.constrained.clear();
  for (std::size_t lane = 0; lane < w.dcm.ghost.size(); ++lane)
    if (w.dcm.ghost[lane] != 0) w.lanes.active[lane] = 0;
  if (!w.constraint.applies()) return;
  for (std::size_t lane = 0; lane < w.lanes.active.size(); ++lane) {
    w.dcm.constrained.push_back(w.constraint.holds(lane) ? 1 : 0);
    if (w.dcm.constrained[lane] != 0) w.lanes.active[lane] = 0;
  }
  const std::span<const std::uint8_t> all = w.constraint.cell;
  const auto spheres = all.subspan(w.lanes.active.size());
  w.cbm.constrained.assign(spheres.begin(), spheres.end());
}

void add_constraint(double step, Workspace& w) {
  for_each_constrained_point(w, [&](std::size_t row, std::size_t lane) {
    w.system.medium[row * kLanes + lane] += kStiffness * step;
  });
}

void remove_constraint(const Workspace& w, std::span<const double> move,
                       std::span<double> product) {
  for_each_constrained_point(w, [&](std::size_t row, std::size_t lane) {
    const Address a = make_address(row, static_cast<int>(lane));
    add_point(product.data(), a, -kStiffness * load_point(move.data(), a));
  });
}

void place_constrained(std::span<const double> move, Workspace& w) {
  for_each_constrained_point(w, [&](std::size_t row, std::size_t lane) {
    const Address a = make_address(row, static_cast<int>(lane));
    store_point(w.move.data(), a, move.empty() ? Vec3::Zero() : load_point(move.data(), a));
  });
}

}  // namespace acinus::coupling
