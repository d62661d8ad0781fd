#include "coupling/step/active_set.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/parallel/threads.hpp"
#include "coupling/step/solve.hpp"

namespace acinus::coupling {
namespace {

/// Depth of a closing contact, um, below which it stays out of the active set: most closing
/// contacts are below it, and each change of the set costs a solve.
constexpr double kShallowDepth = 0.02;
/// Largest gap, um, of a contact that ends open on its repulsive branch: with 10 nN/um it then
/// pulls with 0.02 nN.
constexpr double kMostGap = 0.002;
/// Largest number of changes of the active set in a step.
constexpr int kMostChanges = 6;

/// Displacement of a point from the point of linearisation, which the gaps of contacts do not
/// contain yet.
Vec3 rest_of_move(const Workspace& w, Address a) {
  const Vec3 move = load_point(w.move.data(), a);
  return w.linearisation.is_elsewhere() ? Vec3(move - load_point(w.linearisation.move.data(), a))
                                        : move;
}

/// Largest of these displacements in each cell, um, [lane]: of own points, and of others that are
/// in contact with them.
std::vector<double> largest_rests(const Workspace& w) {
  const solve::System& s = w.system;
  std::vector<double> largest(s.block.size() * kLanes, 0.0);
  for_each_own_block(s, [&](std::size_t, std::size_t b) {
    for (std::size_t row = s.row_of(b); row < s.row_of(b + 1); ++row)
      for (int lane = 0; lane < kLanes; ++lane) {
        double& of_cell = largest[b * kLanes + lane];
        of_cell = std::max(of_cell, rest_of_move(w, make_address(row, lane)).norm());
      }
  });
  for (const solve::Point p : w.op.ghost_points()) {
    double& of_cell = largest[s.lane_of(p)];
    of_cell = std::max(of_cell, rest_of_move(w, solve::address_of(p)).norm());
  }
  return largest;
}

/// Force and stiffness of a contact: by its own law, or by that of the closed gap.
struct ActiveLaw {
  double force, stiffness;
};

/// Part of a displacement along the normal of a contact that opens its gap, um.
template <class Displacement>
double opening(const solve::Stencil& stencil, const solve::Link& link, const Displacement& of) {
  Vec3 r = Vec3::Zero();
  for (int k = 0; k < stencil.n; ++k) r += stencil.weight[k] * of(stencil.address[k]);
  const Vec3 n = solve::normal_of(link);
  return n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
}

/// Replaces the law of a contact. Adds the change of its force to force, right-hand side and
/// residual, and that of its stiffness times displacements to residual and product.
/// @return change of its stiffness in the matrix, nN/um
double replace_law(const ActiveLaw& from, const ActiveLaw& to_law, const Vec3& normal,
                   solve::Link& link, Workspace& w) {
  solve::System& s = w.system;
  const auto stiffness = static_cast<float>(to_law.stiffness);
  const double stiffer =
      s.stiffness_scale * (static_cast<double>(stiffness) - static_cast<double>(link.stiffness));
  const solve::Stencil stencil = solve::stencil_of(link);
  const Vec3 direction = solve::normal_of(link);
  const Vec3 force = (to_law.force - from.force) * normal;
  const Vec3 resistance =
      stiffer * opening(stencil, link, [&](Address a) { return rest_of_move(w, a); }) * direction;
  const auto add = [&](RowVector<double>& to, const Vec3& v) {
    for (int k = 0; k < stencil.n; ++k)
      if (s.owns(solve::point_at(stencil.address[k])))
        add_point(to.data(), stencil.address[k], stencil.weight[k] * v);
  };
  add(link.b.exists() ? s.force : s.external_force, force);
  add(w.rhs, force);
  add(w.cg.residual, force - resistance);
  link.stiffness = stiffness;
  return stiffer;
}

}  // namespace

double gap_after(const Workspace& w, const solve::Link& link) {
  return static_cast<double>(link.gap) +
         opening(solve::stencil_of(link), link, [&](Address a) { return rest_of_move(w, a); });
}

bool activate_closing(Workspace& w) {
  solve::Links& links = w.system.links;
  const std::vector<double> rest = links.link.empty() ? std::vector<double>() : largest_rests(w);
  // No gap changes by more than its two sides move; their weights are rounded to float.
  const auto reach = [&](const solve::Link& link) {
    const auto of = [&](const solve::Side& side) {
      return side.exists() ? rest[w.system.lane_of(side.point[0])] : 0;
    };
    return 1.001 * (of(link.a) + of(link.b));
  };
  // 1: closes, 2: is active and opens
  std::vector<std::uint8_t> change(links.size(), 0);
  std::atomic<bool> wrong = false;
  for_each_index(links.size(), worth_threads(w.system.n_row), [&](std::size_t l) {
    const solve::ClosedLaw law = links.law[l].closed();
    if (!(law.stiffness > 0) || law.clearance <= 0) return;
    if (!links.is_closed(l) && law.clearance + kShallowDepth > reach(links.link[l])) return;
    const double end = clearance_at(gap_after(w, links.link[l]), links.link[l], law);
    if (links.is_closed(l)) {
      change[l] = end > 0 ? 2 : 0;
      if (end > kMostGap) wrong = true;
    } else if (end < -kShallowDepth) {
      change[l] = 1;
      if (end < -kControlledDepth) wrong = true;
    }
  });
  if (!w.system.ownership.ranks.any(wrong)) return false;
  std::vector<solve::LinkChange> changes;
  links.closed.resize(links.size(), 0);
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (change[l] == 0) continue;
    const solve::ClosedLaw law = links.law[l].closed();
    const contact::Contact& contact = w.contacts.all[links.law[l].contact];
    const ActiveLaw own{contact.force, contact.slope},
        closed{-law.stiffness * law.clearance, law.stiffness};
    const bool gained =
        links.closed[l] == 0 && !has_matrix(links.link[l], w.system.stiffness_scale);
    links.closed[l] = change[l];
    const bool closes = links.is_closed(l);
    const double stiffer =
        replace_law(closes ? own : closed, closes ? closed : own, contact.normal, links.link[l], w);
    changes.push_back({static_cast<std::uint32_t>(l), stiffer, gained});
  }
  w.op.update_links(changes);
  return true;
}

bool pulls_open(const Workspace& w) {
  const solve::Links& links = w.system.links;
  bool open = false;
  for (std::size_t l = 0; l < links.size() && !open; ++l)
    open = links.is_closed(l) && clearance_at(gap_after(w, links.link[l]), links.link[l],
                                              links.law[l].closed()) > kMostGap;
  return w.system.ownership.ranks.any(open);
}

Status settle_active_set(const World& world, Workspace& w, Effort& effort) {
  for (int change = 0; change < kMostChanges; ++change) {
    if (!activate_closing(w)) return Status::fine();
    const Status status = solve_again(world, w, effort);
    if (!status.ok) return status;
  }
  if (pulls_open(w)) return Status::failed("which contacts close within the step does not settle");
  return Status::fine();
}

}  // namespace acinus::coupling
