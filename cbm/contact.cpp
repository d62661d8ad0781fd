#include "cbm/contact.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "cbm/obstacle_contacts.hpp"
#include "cbm/pair_kernel.hpp"
#include "contact/jkr.hpp"
#include "contact/neighbours.hpp"
#include "contact/pair_adhesion.hpp"
#include "contact/vessel_side.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/box_pairs.hpp"

namespace acinus::cbm {
namespace {

using contact::Contact;

/// Moduli of all cells, from the overlaps where a law needs them.
void compute_moduli(const State& s, std::span<const Params> params, ContactWorkspace& work) {
  set_size(work.modulus, s.n_cell());
  const bool corrects = has_correction(params);
  work.coupling.assign(corrects ? s.n_cell() : 0, 0.0);
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    if (work.is_far(i)) continue;
    const StiffnessLaw& law = params[s.type[i]].correction;
    if (!law.corrects()) {
      work.modulus[i] = {s.young[i], 0};
      continue;
    }
    const double d = relative_overlap(work, i, law);
    work.modulus[i] = corrected_modulus(law, s.young[i], d);
    if (work.is_ghost(i)) continue;
    ++work.corrected;
    work.beyond += d > law.range ? 1 : 0;
  }
}

/// Converts the coupling of one contact to that of all contacts of a cell.
void scale_coupling(const ContactInput& in, ContactWorkspace& work,
                    std::span<const Contact> obstacle) {
  std::vector<double>& contacts = work.scratch;
  contacts.assign(work.coupling.size(), 0.0);
  for (const auto& [a, b] : work.touching) {
    if (b < 0) continue;
    ++contacts[a];
    ++contacts[b];
  }
  for (const Contact& o : obstacle) ++contacts[o.a];
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (!in.params[in.state.type[i]].correction.mean_of_contacts)
      work.coupling[i] *= contacts[i] / kNeighbours;
}

/// True if a contact acts on moving vessels, so that it is no point link, which joins two points.
bool acts_on_moving_vessel(const ContactInput& in, const Contact& k) {
  return k.partner == contact::Partner::kVessel && in.vessel_row != contact::kAtRest;
}

}  // namespace

bool has_correction(std::span<const Params> params) {
  return std::ranges::any_of(params, [](const Params& p) { return p.correction.corrects(); });
}

void compute_overlaps(const ContactInput& in, ContactWorkspace& work) {
  const State& s = in.state;
  const CellData& cells = in.cells;
  const std::span<const double> radius = cells.radius;
  work.overlap_sum.assign(s.n_cell(), 0.0);
  const bool counts =
      std::ranges::any_of(in.params, [](const Params& p) { return p.correction.mean_of_contacts; });
  work.overlap_count.assign(counts ? s.n_cell() : 0, 0.0);
  std::vector<double>& relative = work.scratch;
  relative.resize(work.pair.size());
  for_each_index(relative.size(), relative.size() > 10000, [&](std::size_t k) {
    const std::size_t i = work.pair[k].first, j = work.pair[k].second;
    relative[k] = 1 - (center_of(s, i) - center_of(s, j)).norm() / (radius[i] + radius[j]);
  });
  for (std::size_t k = 0; k < relative.size(); ++k) {
    if (!(relative[k] > 0)) continue;
    const auto [a, b] = work.pair[k];
    const double share = cells.pair_share(a, b);
    count_overlap(work, a, relative[k], share);
    count_overlap(work, b, relative[k], share);
  }
  // A wall adds as much as the cell's own image behind it.
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    if (work.is_ghost(i)) continue;
    const auto count = [&](double gap) {
      count_overlap(work, i, contact::mirror_wall_compression(radius[i], gap),
                    cells.strength_of(i));
    };
    contact::for_each_wall(in.boundary, [&](auto, auto, const auto& wall) {
      count(contact::gap_to_wall(wall, center_of(s, i), in.time).gap);
    });
  }
}

double largest_separation(std::span<const Params> params, const Extremes& spheres,
                          const contact::Boundary& boundary) {
  if (spheres.largest == 0) return 0;
  double adhesion = std::max(boundary.vessels.material.adhesion, contact::largest_adhesion(params));
  contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
    adhesion = std::max(adhesion, wall.material.adhesion);
  });
  for (const auto& m : boundary.meshes) adhesion = std::max(adhesion, m.material.adhesion);
  if (adhesion <= 0) return 0;
  double softest = spheres.softest;
  if (!boundary.vessels.network.segment.empty())
    softest = std::min(softest, boundary.vessels.material.young);
  // |delta_min| = 3 a_d^2 / R grows with R^(1/3) and falls with E: flat soft partners are the worst
  // case.
  const contact::SpherePair pair{spheres.largest, softest / 2, adhesion};
  return -contact::jkr_special(pair).fold.overlap;
}

double largest_separation(const State& s, std::span<const Params> params,
                          std::span<const double> radius, const contact::Boundary& boundary) {
  if (s.n_cell() == 0) return 0;
  return largest_separation(
      params, {*std::ranges::min_element(s.young), *std::ranges::max_element(radius)}, boundary);
}

double relative_overlap(const ContactWorkspace& work, std::size_t cell, const StiffnessLaw& law) {
  if (!law.mean_of_contacts) return work.overlap_sum[cell] / kNeighbours;
  const double count = work.overlap_count[cell];
  return count > 0 ? work.overlap_sum[cell] / count : 0;
}

void count_overlap(ContactWorkspace& work, std::size_t cell, double relative, double share) {
  work.overlap_sum[cell] += share * relative;
  if (!work.overlap_count.empty() && relative > 0) work.overlap_count[cell] += share;
}

namespace {

/// True if the listed pairs include all near ones: no cell of any process moved or grew too far.
bool pairs_hold(const ContactInput& in, const ContactWorkspace& work, const Ranks& ranks) {
  const State& s = in.state;
  if (work.list_position.size() != s.position.size() || work.list_radius.size() != s.n_cell())
    return false;
  double moved = 0, wider = 0;
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    if (work.is_ghost(i)) continue;
    const Vec3 before = load_point(work.list_position.data(), cell_address(0, i));
    moved = std::max(moved, (center_of(s, i) - before).norm());
    wider = std::max(wider, in.cells.radius[i] - work.list_radius[i]);
  }
  if (in.vessel_row != contact::kAtRest)
    moved =
        std::max(moved, geometry::largest_motion(in.boundary.vessels.network, work.list_network));
  if (!work.ghost.empty()) {
    std::array<double, 2> largest{moved, wider};
    ranks.max(largest);
    moved = largest[0];
    wider = largest[1];
  }
  return 2 * (moved + wider) <= in.options.skin;
}

/// Extremes over the spheres of all processes.
Extremes find_extremes(const ContactInput& in, const ContactWorkspace& work, const Ranks& ranks) {
  Extremes e;
  for (std::size_t i = 0; i < in.state.n_cell(); ++i) {
    if (work.is_ghost(i)) continue;
    e.softest = std::min(e.softest, in.state.young[i]);
    e.largest = std::max(e.largest, in.cells.radius[i]);
  }
  if (work.ghost.empty()) return e;
  std::array<double, 2> most{-e.softest, e.largest};
  ranks.max(most);
  return {-most[0], most[1]};
}

/// Pairs of own spheres and segments of vessels, closer than a margin.
std::vector<std::pair<int, int>> find_segments(const ContactInput& in, const ContactWorkspace& work,
                                               double margin) {
  const State& s = in.state;
  const geometry::Network& network = in.boundary.vessels.network;
  if (network.segment.empty()) return {};
  std::vector<Box> boxes, segments;
  std::vector<int> sphere;
  double widest = 0;
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    if (work.is_ghost(i)) continue;
    boxes.push_back(sphere_box(center_of(s, i), in.cells.radius[i]));
    sphere.push_back(static_cast<int>(i));
  }
  for (std::size_t k = 0; k < network.segment.size(); ++k) {
    Box box;
    for (int n : network.segment[k]) box.include(network.node[n]);
    const double wide = std::max(network.radius[k][0], network.radius[k][1]);
    segments.push_back(box.grown(wide));
    widest = std::max(widest, wide);
  }
  // A surface about the vessels may be that much farther out, in its rounded creases.
  constexpr double kRounding = 0.05;
  const double beyond = in.boundary.vessels.wall ? margin + kRounding * widest : margin;
  std::vector<std::pair<int, int>> pairs = geometry::find_pairs_between(boxes, segments, beyond);
  for (std::pair<int, int>& p : pairs) p.first = sphere[p.first];
  std::erase_if(pairs, [&](const std::pair<int, int>& p) {
    const std::size_t i = p.first;
    return contact::gap_to_segment(network, p.second, center_of(s, i)).gap >
           in.cells.radius[i] + beyond;
  });
  return pairs;
}

/// Notes the sizes and places of own cells, and which others are near them.
void note_cells(const ContactInput& in, ContactWorkspace& work) {
  const State& s = in.state;
  set_size(work.list_position, s.position.size());
  set_size(work.list_radius, s.n_cell());
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    if (work.is_ghost(i)) {
      if (!work.is_absent(i)) work.ghost[i] = ContactWorkspace::kFar;
      continue;
    }
    store_point(work.list_position.data(), cell_address(0, i), center_of(s, i));
    work.list_radius[i] = in.cells.radius[i];
  }
  for (const auto& [a, b] : work.pair) {
    work.come_near(static_cast<std::size_t>(a));
    work.come_near(static_cast<std::size_t>(b));
  }
}

}  // namespace

bool refresh_pairs(const ContactInput& in, ContactWorkspace& work, const Ranks& ranks) {
  if (pairs_hold(in, work, ranks)) return false;
  const State& s = in.state;
  const double margin =
      largest_separation(in.params, find_extremes(in, work, ranks), in.boundary) + in.options.skin;
  contact::find_sphere_pairs(s.position.data(), in.cells.radius, margin, work.ghost, work.pair);
  work.segment = find_segments(in, work, margin);
  work.list_network = {};
  if (in.vessel_row != contact::kAtRest) work.list_network = in.boundary.vessels.network;
  note_cells(in, work);
  ++work.list_builds;
  return true;
}

void find_contacts(const ContactInput& in, ContactWorkspace& work, contact::ContactList& contacts,
                   solve::PointLinks& link) {
  ++work.searches;
  compute_moduli(in.state, in.params, work);
  find_pair_contacts(in, work, link);
  find_obstacle_contacts(in, work, contacts.all);
  contacts.close(contact::ContactKind::kSphereObstacle);
  if (!work.coupling.empty())
    scale_coupling(in, work, contacts.of(contact::ContactKind::kSphereObstacle));
}

void add_coupling(ContactWorkspace& work, std::span<Contact> obstacle,
                  std::span<solve::PointLink> link) {
  if (work.coupling.empty()) return;
  std::size_t k = 0;
  for (const auto& touching : work.touching) {
    if (touching.second < 0) continue;  // contact with the boundary
    while (work.pair[k] != touching) ++k;
    link[k].stiffness +=
        static_cast<float>(work.coupling[touching.first] + work.coupling[touching.second]);
  }
  for (Contact& o : obstacle) o.slope += work.coupling[o.a];
}

void add_contact_loads(const ContactInput& in, const ContactWorkspace& work,
                       const contact::ContactList& contacts, solve::System& system) {
  const std::size_t first = in.first_row * kPointStride;
  for_each_own_number(system, [&](std::size_t k) {
    if (k >= first && k - first < work.force.size()) system.force[k] += work.force[k - first];
  });
  system.point_links.resize(work.pair.size());
  for (const Contact& k : contacts.sphere_obstacle()) {
    if (acts_on_moving_vessel(in, k)) continue;
    const std::size_t i = k.a;
    add_point(system.external_force.data(), cell_address(in.first_row, i), k.force * k.normal);
    solve::PointLink link{
        cell_point(in.first_row, i), solve::kNowhere, {}, static_cast<float>(k.slope), k.friction};
    for (int m = 0; m < 3; ++m) link.normal[m] = static_cast<float>(k.normal[m]);
    system.point_links.push_back(link);
  }
}

void add_vessel_loads(const ContactInput& in, const contact::ContactList& contacts,
                      solve::Links& links) {
  if (in.vessel_row == contact::kAtRest) return;
  const std::size_t first = contacts.first(contact::ContactKind::kSphereObstacle);
  const std::span<const Contact> obstacle = contacts.sphere_obstacle();
  for (std::size_t n = 0; n < obstacle.size(); ++n) {
    const Contact& k = obstacle[n];
    if (!acts_on_moving_vessel(in, k)) continue;
    const std::size_t i = k.a, l = links.size();
    links.resize(l + 1);
    links.link[l].a = solve::Side::at(cell_point(in.first_row, i));
    links.link[l].b =
        contact::vessel_side(in.boundary.vessels, in.vessel_row, k.b, center_of(in.state, i));
    // Spheres may overlap without limit: no depth is too large.
    solve::set_law(k.slope, k.friction, std::numeric_limits<double>::infinity(), k.normal,
                   links.link[l]);
    links.law[l] = {.contact = static_cast<std::uint32_t>(first + n)};
  }
}

double medium_friction(const Params& p, double radius, double contact_area) {
  const double surface = 4 * kPi * radius * radius;
  const double per_area =
      p.viscosity > 0 ? 6 * kPi * p.viscosity * radius / surface : p.medium_friction;
  if (p.whole_medium_area) return per_area * surface;
  return per_area * std::max(kLeastFree * surface, surface - contact_area);
}

void add_cell_loads(const ContactInput& in, const ContactWorkspace& work,
                    std::span<const Vec3> cell_force, solve::System& system) {
  const State& s = in.state;
  for (std::size_t i = 0; i < s.n_row() * kLanes; ++i) {
    if (i < s.n_cell() && work.is_ghost(i)) continue;
    const Address a = cell_address(in.first_row, i);
    const bool cell = i < s.n_cell();
    const double friction =
        cell ? medium_friction(in.params[s.type[i]], in.cells.radius[i], work.contact_area[i])
             : 1.0;
    system.medium[a / kPointStride * kLanes + a % kLanes] += friction;
    if (cell) add_point(system.external_force.data(), a, cell_force[i]);
  }
}

}  // namespace acinus::cbm
