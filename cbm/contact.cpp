#include "cbm/contact.hpp"

#include <algorithm>
#include <cmath>

#include "cbm/pair_kernel.hpp"
#include "core/contact/box_pairs.hpp"
#include "core/contact/neighbours.hpp"
#include "core/mesh/measures.hpp"

namespace acinus::cbm {
namespace {

using contact::Contact, contact::Partner;
using contact::SphereBody;

bool was_touching(const State& s, int a, int b) {
  return std::ranges::binary_search(s.touching, std::pair(a, b));
}

/// A key for surroundings that cannot be a cell number.
int surrounding_key(Partner kind, int index) { return ~(index * 4 + static_cast<int>(kind)); }

/// Whether a cell adheres to this segment or to one that shares an end with it: a stretched contact
/// that slides past a joint is still the same contact.
bool was_touching_vessel(const State& s, const contact::Vessels& vessels, int cell, int segment) {
  if (was_touching(s, cell, surrounding_key(Partner::kVessel, segment))) return true;
  for (int node : vessels.network.segment[static_cast<std::size_t>(segment)])
    for (int other : vessels.segments_of_node[static_cast<std::size_t>(node)])
      if (was_touching(s, cell, surrounding_key(Partner::kVessel, other))) return true;
  return false;
}

void count_overlap(ContactWorkspace& work, int cell, double relative, double share) {
  work.overlap_sum[static_cast<std::size_t>(cell)] += share * relative;
}

struct MeshGap {
  double distance;
  Vec3 normal;
};
/// Signed distance of a point to a static mesh within reach; brute force over near triangles.
MeshGap gap_to_mesh(const contact::SurfaceBody& b, const Vec3& x, double reach) {
  double best2 = reach * reach;
  MeshGap gap{reach, Vec3::UnitZ()};
  for (std::size_t t = 0; t < b.triangle->size(); ++t) {
    const double far = reach + b.reach[t];
    if ((x - b.center[t]).squaredNorm() > far * far) continue;
    const auto& corner = (*b.triangle)[t];
    const mesh::ClosestPoint c = mesh::find_closest_point(
        x, b.node[static_cast<std::size_t>(corner[0])], b.node[static_cast<std::size_t>(corner[1])],
        b.node[static_cast<std::size_t>(corner[2])]);
    if (c.squared_distance >= best2) continue;
    best2 = c.squared_distance;
    Vec3 out = Vec3::Zero();
    for (int m = 0; m < 3; ++m)
      out += c.weight[m] *
             b.node_normal[static_cast<std::size_t>(corner[static_cast<std::size_t>(m)])];
    out.normalize();
    const Vec3 apart = x - c.point;
    const double sign = apart.dot(out) >= 0 ? 1.0 : -1.0, distance = std::sqrt(best2);
    gap = {sign * distance, distance > 0 ? Vec3(sign / distance * apart) : out};
  }
  return gap;
}

/// The moduli of all cells, from the overlaps where a law asks for them.
void find_moduli(const State& s, std::span<const Params> params, ContactWorkspace& work) {
  work.modulus.resize(s.n_cell());
  const bool corrects = has_correction(params);
  work.coupling.assign(corrects ? s.n_cell() : 0, 0.0);
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    const StiffnessLaw& law = params[static_cast<std::size_t>(s.type[i])].correction;
    if (!law.corrects()) {
      work.modulus[i] = {s.young[i], 0};
      continue;
    }
    const double d = relative_overlap(work, i);
    work.modulus[i] = corrected_modulus(law, s.young[i], d);
    ++work.corrected;
    work.beyond += d > law.range ? 1 : 0;
  }
}

/// Adds the coupling of its cells to the stiffness of every contact.
void add_coupling(ContactWorkspace& work, std::span<Contact> obstacle,
                  std::vector<solve::PointLink>& link) {
  std::vector<double> contacts(work.coupling.size(), 0.0);
  for (const auto& [a, b] : work.touching) {
    if (b < 0) continue;
    ++contacts[static_cast<std::size_t>(a)];
    ++contacts[static_cast<std::size_t>(b)];
  }
  for (const Contact& o : obstacle) ++contacts[static_cast<std::size_t>(o.a)];
  for (std::size_t i = 0; i < contacts.size(); ++i) work.coupling[i] *= contacts[i] / kNeighbours;
  std::size_t k = 0;
  for (const auto& touching : work.touching) {
    if (touching.second < 0) continue;  // surroundings
    while (work.pair[k] != touching) ++k;
    link[k].stiffness +=
        static_cast<float>(work.coupling[static_cast<std::size_t>(touching.first)] +
                           work.coupling[static_cast<std::size_t>(touching.second)]);
  }
  for (Contact& o : obstacle) o.slope += work.coupling[static_cast<std::size_t>(o.a)];
}

}  // namespace

bool has_correction(std::span<const Params> params) {
  return std::ranges::any_of(params, [](const Params& p) { return p.correction.corrects(); });
}

void find_overlaps(const ContactInput& in, ContactWorkspace& work) {
  const State& s = in.state;
  const CellData& cells = in.cells;
  const std::span<const double> radius = cells.radius;
  work.overlap_sum.assign(s.n_cell(), 0.0);
  std::vector<double> relative(work.pair.size());
#pragma omp parallel for schedule(static) if (relative.size() > 10000)
  for (std::size_t k = 0; k < relative.size(); ++k) {
    const auto i = static_cast<std::size_t>(work.pair[k].first),
               j = static_cast<std::size_t>(work.pair[k].second);
    relative[k] = 1 - (center_of(s, i) - center_of(s, j)).norm() / (radius[i] + radius[j]);
  }
  for (std::size_t k = 0; k < relative.size(); ++k) {
    if (!(relative[k] > 0)) continue;
    const auto [a, b] = work.pair[k];
    const double share = cells.pair_share(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    count_overlap(work, a, relative[k], share);
    count_overlap(work, b, relative[k], share);
  }
  // A wall is as much of an obstacle as the cell's own image behind it.
  for (std::size_t i = 0; i < s.n_cell(); ++i) {
    const auto count = [&](double gap) {
      count_overlap(work, static_cast<int>(i), contact::mirror_wall_compression(radius[i], gap),
                    cells.strength_of(i));
    };
    for (const contact::Plane& p : in.around.planes)
      count(contact::gap_to_plane(p, center_of(s, i), in.time).gap);
    for (const contact::Capsule& c : in.around.capsules)
      count(contact::gap_to_capsule(c, center_of(s, i), in.time).gap);
  }
}

double largest_separation(const State& s, std::span<const Params> params,
                          std::span<const double> radius, const contact::Surroundings& around) {
  if (s.n_cell() == 0) return 0;
  double adhesion = around.vessels.material.adhesion;
  for (const Params& p : params) adhesion = std::max(adhesion, p.adhesion);
  for (const auto& p : around.planes) adhesion = std::max(adhesion, p.material.adhesion);
  for (const auto& m : around.meshes) adhesion = std::max(adhesion, m.material.adhesion);
  if (adhesion <= 0) return 0;
  double softest = *std::ranges::min_element(s.young);
  if (!around.vessels.network.segment.empty())
    softest = std::min(softest, around.vessels.material.young);
  const double largest = *std::ranges::max_element(radius);
  // |delta_min| = 3 a_d^2 / R grows with R^(1/3) and falls with E: flat soft partners are the worst
  // case.
  const contact::SpherePair pair{largest, softest / 2, adhesion};
  return -contact::jkr_special(pair).fold.overlap;
}

double relative_overlap(const ContactWorkspace& work, std::size_t cell) {
  return work.overlap_sum[cell] / kNeighbours;
}

contact::SphereForce weaken(contact::SphereForce law, double share) {
  if (share <= 0) return {};
  law.force *= share;
  law.stiffness *= share;
  law.force_by_modulus *= share;
  law.contact_radius *= std::sqrt(share);
  return law;
}

bool refresh_pairs(const ContactInput& in, ContactWorkspace& work) {
  const State& s = in.state;
  const std::span<const double> radius = in.cells.radius;
  const double skin = in.options.skin;
  if (work.list_position.size() == s.position.size() && work.list_radius.size() == s.n_cell()) {
    double moved = 0, wider = 0;
    for (std::size_t i = 0; i < s.n_cell(); ++i) {
      moved = std::max(
          moved,
          (center_of(s, i) - load_point(work.list_position.data(), cell_address(0, i))).norm());
      wider = std::max(wider, radius[i] - work.list_radius[i]);
    }
    if (2 * (moved + wider) <= skin) return false;
  }
  const double margin = largest_separation(s, in.params, radius, in.around) + skin;
  work.pair = {};  // before the new ones take memory
  work.pair = contact::find_sphere_pairs(s.position.data(), radius, margin);
  work.segment.clear();
  const mesh::Network& network = in.around.vessels.network;
  if (!network.segment.empty()) {
    std::vector<Box> boxes, segments;
    for (std::size_t i = 0; i < s.n_cell(); ++i)
      boxes.push_back(sphere_box(center_of(s, i), radius[i]));
    for (std::size_t k = 0; k < network.segment.size(); ++k) {
      Box box;
      for (int n : network.segment[k]) box.include(network.node[static_cast<std::size_t>(n)]);
      segments.push_back(box.grown(std::max(network.radius[k][0], network.radius[k][1])));
    }
    work.segment = contact::find_pairs_between(boxes, segments, margin);
    std::erase_if(work.segment, [&](const std::pair<int, int>& p) {
      const auto i = static_cast<std::size_t>(p.first);
      return contact::gap_to_segment(network, p.second, center_of(s, i)).gap > radius[i] + margin;
    });
  }
  work.list_position = s.position;
  work.list_radius.assign(radius.begin(), radius.end());
  ++work.list_builds;
  return true;
}

namespace {

/// Finds and completes the contacts of spheres with surroundings.
class ObstacleSearch {
 public:
  ObstacleSearch(const ContactInput& in, ContactWorkspace& work, std::vector<Contact>& out)
      : in_(in), work_(work), out_(out) {}

  void run() {
    const contact::Surroundings& around = in_.around;
    if (around.planes.empty() && around.capsules.empty() && around.meshes.empty() &&
        work_.segment.empty())
      return;
    for (std::size_t i = 0; i < in_.state.n_cell(); ++i) {
      const Vec3 x = center_of(in_.state, i);
      for (std::size_t k = 0; k < around.planes.size(); ++k) meet_plane(i, k, x);
      for (std::size_t k = 0; k < around.capsules.size(); ++k) meet_capsule(i, k, x);
      for (std::size_t k = 0; k < around.meshes.size(); ++k) meet_mesh(i, k, x);
    }
    for (auto [cell, segment] : work_.segment) meet_vessel(static_cast<std::size_t>(cell), segment);
    std::ranges::sort(work_.touching);
  }

 private:
  double radius(std::size_t i) const { return in_.cells.radius[i]; }
  const Params& params_of(std::size_t i) const {
    return in_.params[static_cast<std::size_t>(in_.state.type[i])];
  }
  SphereBody body(std::size_t i) const {
    return {radius(i), work_.modulus[i].value, params_of(i).poisson};
  }
  static SphereBody flat(const contact::Material& m, double shape) {
    return {shape, m.young, m.poisson};
  }

  /// As RangeSearch::couple; a bound, since a partner's own softness only makes it less.
  void couple(std::size_t i, const contact::SphereForce& law, double slope) {
    if (work_.coupling.empty()) return;
    const double poisson = params_of(i).poisson;
    work_.coupling[i] =
        std::max(work_.coupling[i], std::max(law.force_by_modulus, 0.0) / (1 - poisson * poisson) *
                                        slope * work_.modulus[i].slope / radius(i));
  }

  /// Adds a contact, complete.
  void add(Contact k, const contact::SphereForce& law, double friction, double slope) {
    const auto i = static_cast<std::size_t>(k.a);
    k.area = k.touching = kPi * law.contact_radius * law.contact_radius;
    k.force = law.force;
    k.slope = std::max(0.0, law.stiffness);
    k.friction = friction * k.area;
    couple(i, law, slope);
    out_.push_back(k);
    work_.contact_area[i] += k.area;
  }

  /// @param recess  um, by which a wall is met later than at the radius
  /// @param slope   of its modulus over that of the cell
  void meet(const Contact& k, const contact::SpherePair& pair, double recess = 0,
            double slope = 1) {
    const auto i = static_cast<std::size_t>(k.a);
    const int key = surrounding_key(k.partner, k.b);
    const bool before = k.partner == Partner::kVessel
                            ? was_touching_vessel(in_.state, in_.around.vessels, k.a, k.b)
                            : was_touching(in_.state, k.a, key);
    const double overlap = -k.gap;
    if (overlap < recess && !before) return;
    const contact::SphereForce law =
        weaken(contact::jkr_force(pair, overlap - recess, before), in_.cells.strength_of(i));
    if (!law.touching) return;
    work_.touching.emplace_back(k.a, key);
    add(k, law, params_of(i).vessel_friction, slope);
  }

  void meet_wall(const Contact& k, const contact::Material& material, double shape) {
    const auto i = static_cast<std::size_t>(k.a);
    const WallFace face =
        wall_face(params_of(i).correction, in_.state.young[i], work_.modulus[i].value);
    SphereBody crowded = body(i);
    crowded.young = face.modulus;
    // That the face recedes as the cell is crowded is left out of the matrix: it makes the contact
    // softer than the bound of `couple` says, while a law is steepest even unstable.
    meet(k,
         contact::reduced_pair(crowded, flat(material, shape),
                               in_.options.adhesion_factor * material.adhesion),
         radius(i) * face.recess, face.slope);
  }

  Contact contact_with(Partner partner, std::size_t i, int index, double gap,
                       const Vec3& normal) const {
    return {.a = static_cast<int>(i),
            .b = index,
            .partner = partner,
            .normal = normal,
            .gap = -(radius(i) - gap)};
  }

  void meet_plane(std::size_t i, std::size_t index, const Vec3& x) {
    const contact::Plane& p = in_.around.planes[index];
    const contact::Gap g = contact::gap_to_plane(p, x, in_.time);
    const Contact k = contact_with(Partner::kPlane, i, static_cast<int>(index), g.gap, g.normal);
    if (!p.material.mirror) {
      meet_wall(k, p.material, contact::kFlat);
      return;
    }
    const double share = in_.cells.strength_of(i);
    if (g.gap >= radius(i) || share <= 0) return;
    add(k, weaken(contact::mirror_wall_force(body(i), g.gap), share), 0, 1);
  }

  void meet_capsule(std::size_t i, std::size_t index, const Vec3& x) {
    const contact::Capsule& shell = in_.around.capsules[index];
    const double r = shell.radius_at(in_.time);
    if (r <= radius(i) || !std::isfinite(r)) return;
    const contact::Gap g = contact::gap_to_capsule(shell, x, in_.time);
    meet_wall(contact_with(Partner::kCapsule, i, static_cast<int>(index), g.gap, g.normal),
              shell.material, -r);
  }

  void meet_mesh(std::size_t i, std::size_t index, const Vec3& x) {
    const contact::StaticMesh& m = in_.around.meshes[index];
    const double reach = 2 * radius(i);
    if (!m.body.box.grown(reach).contains(x)) return;
    const MeshGap g = gap_to_mesh(m.body, x, reach);
    meet(contact_with(Partner::kMesh, i, static_cast<int>(index), g.distance, g.normal),
         contact::reduced_pair(body(i), flat(m.material, contact::kFlat),
                               in_.options.adhesion_factor * m.material.adhesion));
  }

  void meet_vessel(std::size_t i, int segment) {
    const contact::Vessels& vessels = in_.around.vessels;
    const Vec3 x = center_of(in_.state, i);
    const contact::Gap g = contact::gap_to_segment(vessels.network, segment, x);
    if (!contact::is_local_minimum(vessels, segment, x, g)) return;
    const contact::Material& m = vessels.material;
    meet(contact_with(Partner::kVessel, i, segment, g.gap, g.normal),
         contact::vessel_pair(body(i), {g.radius, m.young, m.poisson},
                              in_.options.adhesion_factor * m.adhesion));
  }

  const ContactInput& in_;
  ContactWorkspace& work_;
  std::vector<Contact>& out_;
};

}  // namespace

void find_contacts(const ContactInput& in, ContactWorkspace& work, contact::ContactList& contacts,
                   std::vector<solve::PointLink>& link) {
  ++work.searches;
  find_moduli(in.state, in.params, work);
  find_pair_contacts(in, work, link);
  ObstacleSearch(in, work, contacts.all).run();
  contacts.sphere_obstacle_end = contacts.all.size();
  if (!work.coupling.empty())
    add_coupling(work, std::span(contacts.all).subspan(contacts.interface_end), link);
}

void add_contact_loads(const ContactInput& in, const ContactWorkspace& work,
                       const contact::ContactList& contacts, solve::System& system) {
  double* force = system.force.data() + in.first_row * kPointStride;
  for (std::size_t k = 0; k < work.force.size(); ++k) force[k] += work.force[k];
  system.point_links.resize(work.pair.size());
  for (const Contact& k : contacts.sphere_obstacle()) {
    const auto i = static_cast<std::size_t>(k.a);
    add_point(system.external_force.data(), cell_address(in.first_row, i), k.force * k.normal);
    solve::PointLink link{cell_point(in.first_row, i),
                          solve::kNowhere,
                          {},
                          static_cast<float>(k.slope),
                          static_cast<float>(k.friction)};
    for (int m = 0; m < 3; ++m)
      link.normal[static_cast<std::size_t>(m)] = static_cast<float>(k.normal[m]);
    system.point_links.push_back(link);
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
    const Address a = cell_address(in.first_row, i);
    const bool cell = i < s.n_cell();
    const double friction = cell ? medium_friction(in.params[static_cast<std::size_t>(s.type[i])],
                                                   in.cells.radius[i], work.contact_area[i])
                                 : 1.0;
    system.medium[a / kPointStride * kLanes + a % kLanes] += friction;
    if (cell) add_point(system.external_force.data(), a, cell_force[i]);
  }
}

}  // namespace acinus::cbm
