#include "cbm/obstacle_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cbm/vessel_stiffness.hpp"
#include "contact/boundary.hpp"
#include "contact/jkr.hpp"
#include "geometry/measures.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::cbm {
namespace {

using contact::Contact, contact::Partner;
using contact::SphereBody;

bool was_touching(const State& s, int a, int b) {
  return std::ranges::binary_search(s.touching, std::pair(a, b));
}

/// Key of an obstacle, distinct from all cell numbers. Checkpoints hold it: kinds that came later
/// than the first four have a range of their own.
int boundary_key(Partner kind, int index) {
  constexpr int kFirstKinds = 4, kLater = 1 << 28;
  const int number = static_cast<int>(kind);
  if (number < kFirstKinds) return ~(index * kFirstKinds + number);
  return ~((number - kFirstKinds + 1) * kLater + index);
}

/// True if a cell adheres to this segment or to one that shares an end with it: a stretched contact
/// that slides past a joint is still the same contact.
bool was_touching_vessel(const State& s, const contact::Vessels& vessels, int cell, int segment) {
  if (was_touching(s, cell, boundary_key(Partner::kVessel, segment))) return true;
  for (int node : vessels.network.segment[segment])
    for (int other : vessels.segments_of_node[node])
      if (was_touching(s, cell, boundary_key(Partner::kVessel, other))) return true;
  return false;
}

/// Search for the contacts of spheres with the boundary, and evaluation of their law.
class ObstacleSearch {
 public:
  ObstacleSearch(const ContactInput& in, ContactWorkspace& work, contact::Contacts& out)
      : in_(in), work_(work), out_(out) {}

  void run() {
    const contact::Boundary& boundary = in_.boundary;
    if (boundary.empty()) return;
    for (std::size_t i = 0; i < in_.state.n_cell(); ++i) {
      if (work_.is_ghost(i)) continue;
      const Vec3 x = center_of(in_.state, i);
      contact::for_each_wall(boundary, [&](Partner kind, int k, const auto& wall) {
        evaluate_wall(kind, i, k, wall, x);
      });
      for (std::size_t k = 0; k < boundary.meshes.size(); ++k) evaluate_mesh(i, k, x);
    }
    if (in_.vessel_row == contact::kAtRest)
      for (auto [cell, segment] : work_.segment) evaluate_vessel(cell, segment);
    else
      evaluate_moving_vessels();
    std::ranges::sort(work_.touching);
  }

 private:
  double radius(std::size_t i) const { return in_.cells.radius[i]; }
  const Params& params_of(std::size_t i) const { return in_.params[in_.state.type[i]]; }
  SphereBody body(std::size_t i) const {
    return {radius(i), work_.modulus[i].value, params_of(i).poisson};
  }
  /// Modulus toward an obstacle. @param overlap  relative, of the contact alone
  FaceModulus face_of(std::size_t i, double overlap) const {
    return modulus_toward(params_of(i).correction, in_.state.young[i], work_.modulus[i], overlap,
                          kOwnObstacleOverlap);
  }
  static SphereBody flat(const contact::Material& m, double shape) {
    return {shape, m.young, m.poisson};
  }

  /// Bounds the change of a contact force of the cell with the modulus that all its contacts set,
  /// as `by_modulus` for pairs. A bound, since the compliance of a partner only reduces it.
  void couple(std::size_t i, const contact::SphereForce& law, double slope) {
    if (work_.coupling.empty()) return;
    const double poisson = params_of(i).poisson;
    work_.coupling[i] =
        std::max(work_.coupling[i], std::max(law.force_by_modulus, 0.0) / (1 - poisson * poisson) *
                                        slope * work_.modulus[i].slope / radius(i));
  }

  /// Adds a complete contact.
  /// @param by_overlap  dE^/d overlap of its own, kPa/um
  void add(Contact k, const contact::SphereForce& law, double friction, double slope,
           double by_overlap = 0) {
    const std::size_t i = k.a;
    k.touching = kPi * law.contact_radius * law.contact_radius;
    k.force = law.force;
    k.slope = std::max(0.0, law.stiffness) + std::max(0.0, law.force_by_modulus) * by_overlap;
    k.friction = static_cast<float>(friction * k.touching);
    couple(i, law, slope);
    out_.push_back(k);
    work_.contact_area[i] += k.touching;
  }

  /// Evaluates a pair and adds its contact if it touches.
  /// @param recess      um, distance of the wall contact's onset from the radius
  /// @param slope       derivative of its modulus by that of the cell
  /// @param share       of its force
  /// @param by_overlap  dE^/d overlap, kPa/um
  void evaluate(const Contact& k, const contact::SpherePair& pair, double recess = 0,
                double slope = 1, double share = 1, double by_overlap = 0) {
    const std::size_t i = k.a;
    const int key = boundary_key(k.partner, k.b);
    const bool before = k.partner == Partner::kVessel
                            ? was_touching_vessel(in_.state, in_.boundary.vessels, k.a, k.b)
                            : was_touching(in_.state, k.a, key);
    const double overlap = -k.gap;
    if (overlap < recess && !before) return;
    const contact::SphereForce law = weaken(contact::jkr_force(pair, overlap - recess, before),
                                            share * in_.cells.strength_of(i));
    if (!law.touching) return;
    work_.touching.emplace_back(k.a, key);
    add(k, law, params_of(i).vessel_friction, slope, by_overlap);
  }

  void evaluate_face(const Contact& k, const contact::Material& material, double shape) {
    const std::size_t i = k.a;
    const StiffnessLaw& law = params_of(i).correction;
    const double modulus = work_.modulus[i].value;
    // The paper's law has spheres at walls, no faces.
    const WallFace face = law.mean_of_contacts ? WallFace{.modulus = modulus}
                                               : wall_face(law, in_.state.young[i], modulus);
    SphereBody crowded = body(i);
    crowded.young = face.modulus;
    // The recession of the face with crowding is left out of the matrix: it makes the contact
    // softer than the bound of `couple`, and even unstable where a law is steepest.
    evaluate(k,
             contact::reduced_pair(crowded, flat(material, shape),
                                   in_.options.adhesion_factor * material.adhesion),
             radius(i) * face.recess, face.slope);
  }

  Contact contact_with(Partner partner, std::size_t i, int index, double gap,
                       const Vec3& normal) const {
    return {.a = static_cast<int>(i),
            .b = index,
            .partner = partner,
            .place = {},
            .normal = normal,
            .gap = -(radius(i) - gap)};
  }

  template <class Wall>
  void evaluate_wall(Partner kind, std::size_t i, int index, const Wall& wall, const Vec3& x) {
    const double shape = contact::shape_radius(wall, in_.time);
    if (shape < 0 && -shape <= radius(i)) return;  // concave, and smaller than the sphere
    const contact::Gap g = contact::gap_to_wall(wall, x, in_.time);
    if (!std::isfinite(g.gap)) return;  // vanished
    const Contact k = contact_with(kind, i, index, g.gap, g.normal);
    if (!wall.material.mirror) {
      evaluate_face(k, wall.material, shape);
      return;
    }
    evaluate_mirror(k, g.gap);
  }

  /// Evaluates a mirror plane. It stands for an equal cell, which a law stiffens like a single
  /// neighbour, from a deeper overlap on.
  /// @param gap  um, of the centre
  void evaluate_mirror(const Contact& k, double gap) {
    const std::size_t i = k.a;
    const double share = in_.cells.strength_of(i);
    if (gap >= radius(i) || share <= 0) return;
    const FaceModulus face = face_of(i, contact::mirror_wall_compression(radius(i), gap));
    const double poisson = params_of(i).poisson;
    const double by_overlap = face.own ? face.slope / radius(i) / (1 - poisson * poisson) : 0;
    add(k, weaken(contact::mirror_wall_force({radius(i), face.value, poisson}, gap), share), 0,
        face.own ? 0 : 1, by_overlap);
  }

  void evaluate_mesh(std::size_t i, std::size_t index, const Vec3& x) {
    const contact::StaticMesh& m = in_.boundary.meshes[index];
    const double reach = 2 * radius(i);
    if (!m.body.box.grown(reach).contains(x)) return;
    const contact::Gap g = contact::gap_to_mesh(m.body, x, reach);
    evaluate(contact_with(Partner::kMesh, i, static_cast<int>(index), g.gap, g.normal),
             contact::reduced_pair(body(i), flat(m.material, contact::kFlat),
                                   in_.options.adhesion_factor * m.material.adhesion));
  }

  /// Gap to a segment, if its contact is one of its own.
  std::optional<contact::Gap> vessel_gap(std::size_t i, int segment) const {
    const contact::Vessels& vessels = in_.boundary.vessels;
    const Vec3 x = center_of(in_.state, i);
    if (!contact::is_local_minimum(vessels, segment, x,
                                   contact::gap_to_segment(vessels.network, segment, x)))
      return std::nullopt;
    return contact::gap_to_wall(vessels, segment, x, 2 * radius(i));
  }

  void evaluate_vessel(std::size_t i, int segment) {
    if (const std::optional<contact::Gap> g = vessel_gap(i, segment))
      evaluate_segment(i, segment, *g, 1);
  }

  /// Evaluates moving vessels. A bent vessel has two contacts in place of one on the inner side of
  /// every joint that is no longer straight: contacts with segments that share a node count as one
  /// in proportion to the similarity of their directions.
  void evaluate_moving_vessels() {
    const geometry::Network& network = in_.boundary.vessels.network;
    std::vector<std::pair<int, contact::Gap>> found;  // [contact] segment, gap
    for (auto pair = work_.segment.begin(); pair != work_.segment.end();) {
      const int cell = pair->first;
      found.clear();
      for (; pair != work_.segment.end() && pair->first == cell; ++pair)
        if (const std::optional<contact::Gap> g = vessel_gap(cell, pair->second))
          found.emplace_back(pair->second, *g);
      for (const auto& [segment, gap] : found) {
        double count = 1;
        for (const auto& [other, there] : found)
          if (other != segment && geometry::share_a_node(network, other, segment))
            count += likeness(gap.normal, there.normal) *
                     share_of(radius(cell) - there.gap, radius(cell) - gap.gap);
        evaluate_segment(cell, segment, gap, 1 / count);
      }
    }
  }

  /// Weight of a neighbouring contact of this depth beside a contact: at most 1.
  static double share_of(double neighbour, double own) {
    if (neighbour <= 0) return 0;
    return neighbour >= own ? 1 : neighbour / own;
  }

  /// Similarity of two directions: 1 if they are equal, 0 if they are separate. Contacts merge
  /// where their distance on the sphere is the diameter of a contact some hundredths of the radius
  /// deep.
  static double likeness(const Vec3& a, const Vec3& b) {
    constexpr double kApart = 0.5;  // rad
    const double x = std::min(1.0, std::acos(std::clamp(a.dot(b), -1.0, 1.0)) / kApart);
    return (1 - x) * (1 - x) * (1 + 2 * x);
  }

  /// Evaluates the contact of a sphere with a segment. @param share  of its force
  void evaluate_segment(std::size_t i, int segment, const contact::Gap& g, double share) {
    const contact::Material& m = in_.boundary.vessels.material;
    const Contact k = contact_with(Partner::kVessel, i, segment, g.gap, g.normal);
    const double adhesion = in_.options.adhesion_factor * m.adhesion;
    const StiffnessLaw& law = params_of(i).correction;
    if (!law.corrects() || !law.single_overlaps) {
      evaluate(k, contact::vessel_pair(body(i), {g.radius, m.young, m.poisson}, adhesion), 0, 1,
               share);
      return;
    }
    const FaceModulus face = face_of(i, -k.gap / (radius(i) + g.radius));
    const VesselPair bounded = corrected_vessel_pair(
        face, {radius(i), face.value, params_of(i).poisson}, m, g.radius, -k.gap, adhesion);
    evaluate(k, bounded.pair, 0, face.own ? 0 : 1, share, bounded.modulus_by_overlap);
  }

  const ContactInput& in_;
  ContactWorkspace& work_;
  contact::Contacts& out_;
};

}  // namespace

void find_obstacle_contacts(const ContactInput& in, ContactWorkspace& work,
                            contact::Contacts& contacts) {
  ObstacleSearch(in, work, contacts).run();
}

}  // namespace acinus::cbm
