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

/// Largest of these displacements, um, of own points and of those in contact with them.
double largest_rest(const Workspace& w) {
  std::atomic<double> largest2 = 0;
  const auto raise = [&](double here) {
    double known = largest2;
    while (here > known && !largest2.compare_exchange_weak(known, here)) {
    }
  };
  for (const auto& [first, last] : w.system.own) {
    const std::size_t first_row = w.system.row_of(first), n_row = w.system.row_of(last) - first_row;
    const std::size_t n_part = count_threads(n_row);
    for_each_part(n_part, [&](std::size_t part) {
      double here = 0;
      for (std::size_t row = part * n_row / n_part; row < (part + 1) * n_row / n_part; ++row)
        for (int lane = 0; lane < kLanes; ++lane)
          here = std::max(here, rest_of_move(w, make_address(first_row + row, lane)).squaredNorm());
      raise(here);
    });
  }
  for (const solve::Point p : w.op.ghost_points())
    raise(rest_of_move(w, solve::address_of(p)).squaredNorm());
  return std::sqrt(largest2);
}

/// Force and stiffness of a contact: by its own law, or by that of the closed gap.
struct ActiveLaw {
  double force, stiffness;
};

/// Replaces the law of a contact and adds the change of its force to the system.
void replace_law(const ActiveLaw& from, const ActiveLaw& to_law, const Vec3& normal,
                 solve::Link& link, solve::System& s) {
  const Vec3 change = (to_law.force - from.force) * normal;
  RowVector<double>& to = link.b.exists() ? s.force : s.external_force;
  const solve::Stencil stencil = solve::stencil_of(link);
  for (int k = 0; k < stencil.n; ++k)
    add_point(to.data(), stencil.address[k], stencil.weight[k] * change);
  link.stiffness = static_cast<float>(to_law.stiffness);
}

}  // namespace

double gap_after(const Workspace& w, const solve::Link& link) {
  const solve::Stencil stencil = solve::stencil_of(link);
  Vec3 r = Vec3::Zero();
  for (int k = 0; k < stencil.n; ++k) r += stencil.weight[k] * rest_of_move(w, stencil.address[k]);
  double gap = static_cast<double>(link.gap);
  for (int k = 0; k < 3; ++k) gap += static_cast<double>(link.normal[k]) * r[k];
  return gap;
}

bool activate_closing(Workspace& w) {
  solve::Links& links = w.system.links;
  // No gap changes by more than its two sides move; their weights are rounded to float.
  const double reach = 2.001 * largest_rest(w);
  // 1: closes, 2: is active and opens
  std::vector<std::uint8_t> change(links.size(), 0);
  std::atomic<bool> wrong = false;
  for_each_index(links.size(), worth_threads(w.system.n_row), [&](std::size_t l) {
    const solve::LinkLaw& law = links.law[l];
    if (!(law.closed_stiffness > 0) || law.clearance <= 0) return;
    if (law.clearance + kShallowDepth > reach && !links.is_closed(l)) return;
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
  links.closed.resize(links.size(), 0);
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (change[l] == 0) continue;
    const solve::LinkLaw& law = links.law[l];
    const contact::Contact& contact = w.contacts.all[law.contact];
    const ActiveLaw own{contact.force, contact.slope},
        closed{-law.closed_stiffness * law.clearance, law.closed_stiffness};
    links.closed[l] = change[l] == 1 ? 1 : 0;
    if (links.closed[l] != 0)
      replace_law(own, closed, contact.normal, links.link[l], w.system);
    else
      replace_law(closed, own, contact.normal, links.link[l], w.system);
  }
  w.op.prepare(w.system);
  return true;
}

bool pulls_open(const Workspace& w) {
  const solve::Links& links = w.system.links;
  bool open = false;
  for (std::size_t l = 0; l < links.size() && !open; ++l)
    open = links.is_closed(l) &&
           clearance_at(gap_after(w, links.link[l]), links.link[l], links.law[l]) > kMostGap;
  return w.system.ownership.ranks.any(open);
}

Status settle_active_set(const World& world, Workspace& w, Effort& effort) {
  for (int change = 0; change < kMostChanges; ++change) {
    if (!activate_closing(w)) return Status::fine();
    Status status = solve_again(world, w, effort);
    if (!status.ok) return status;
  }
  if (pulls_open(w)) return Status::failed("which contacts close within the step does not settle");
  return Status::fine();
}

}  // namespace acinus::coupling
