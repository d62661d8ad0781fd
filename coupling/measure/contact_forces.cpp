#include "coupling/measure/contact_forces.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/numbers/exact_sum.hpp"
#include "coupling/measure/cell_numbers.hpp"
#include "coupling/measure/pair_contacts.hpp"
#include "coupling/migration/fading.hpp"
#include "dcm/contact/contact_points.hpp"

namespace acinus::coupling {
namespace {

/// Points of action of contacts.
struct Places {
  const World& world;
  const Workspace& w;
  CellNumbers numbers;
  std::vector<Vec3> center;  ///< um, of cells with points

  Places(const World& of, const Workspace& work)
      : world(of), w(work), numbers(number_cells(of.state, work)), center(list_centers(of, work)) {}

  Vec3 point(const contact::Contact& k) const {
    const contact::SurfaceBody& body = w.dcm.body[k.a];
    return contact::point_position(body, dcm::stencil_of(world.params.dcm_contact, body, k));
  }

  /// Point of contact: the middle of the overlap of two spheres, the surface of an obstacle.
  void set_arms_of_sphere(const contact::Contact& k, ContactForce& f) const {
    const std::span<const double> radius = w.cbm_radius;
    const bool pair = k.partner == contact::Partner::kSphere;
    const double depth = pair ? -0.5 * k.gap : -k.gap;
    f.arm_a = -(radius[k.a] - depth) * k.normal;
    if (pair) f.arm_b = (radius[k.b] - depth) * k.normal;
  }

  void set_arms_of_surface(const contact::Contact& k, ContactForce& f) const {
    const Vec3 x = point(k);
    f.arm_a = x - center[f.a];
    if (f.b == kNoCell) return;
    const bool surfaces = k.partner == contact::Partner::kSurface;
    f.arm_b = (surfaces ? Vec3(x - k.gap * k.normal) : x) - center[f.b];
  }
};

void visit_fading(const World& world, const Places& places,
                  const std::function<void(const ContactForce&)>& visit) {
  const State& s = world.state;
  if (s.fading.empty()) return;
  std::unordered_map<std::int64_t, std::size_t> number;
  for (const std::size_t lane : places.numbers.lane)
    number.emplace(s.dcm.lineage[lane], number.size());
  for (const std::int64_t lineage : s.cbm.lineage) number.emplace(lineage, number.size());
  for (const FadingForce& fading : s.fading) {
    const auto a = number.find(fading.a), b = number.find(fading.b);
    const bool boundary = fading.b == kNoPartner;
    if (a == number.end() || (b == number.end() && !boundary)) continue;
    ContactForce f;
    f.a = a->second;
    const Vec3& center = places.center[f.a];
    const Vec3 apart = boundary ? center : Vec3(center - places.center[b->second]);
    const double share = left_of(fading, s.clock.time, apart);
    f.force = share * fading.force;
    const double size = f.force.norm();
    if (!(size > 0)) continue;
    f.arm_a = (share * fading.virial / size) * (f.force / size);
    if (!boundary) {
      f.b = b->second;
      f.normal = apart.normalized();
      f.arm_b = f.arm_a + apart;
    }
    f.fades = true;
    visit(f);
  }
}

}  // namespace

std::vector<Vec3> list_centers(const World& world, const Workspace& w) {
  const CellNumbers numbers = number_cells(world.state, w);
  const std::size_t n_sphere = world.state.cbm.n_cell();
  std::vector<Vec3> center(numbers.of_sphere(n_sphere), Vec3::Zero());
  for (std::size_t b = 0; b < numbers.of_body.size(); ++b)
    center[numbers.of_body[b]] = dcm::cell_center(world.state.dcm, w.dcm.lane_of_body[b]);
  for (std::size_t c = 0; c < n_sphere; ++c)
    if (!w.cbm.is_absent(c)) center[numbers.of_sphere(c)] = cbm::center_of(world.state.cbm, c);
  return center;
}

void visit_contacts(const World& world, const Workspace& w,
                    const std::function<void(const ContactForce&)>& visit) {
  const Places places(world, w);
  const CellNumbers& numbers = places.numbers;
  const auto visit_record = [&](const contact::Contact& k) {
    if (k.partner == contact::Partner::kNucleus) return;  // within a cell
    const bool sphere = k.point == contact::kWhole;
    ContactForce f;
    f.a = sphere ? numbers.of_sphere(k.a) : numbers.of_body[k.a];
    f.force = k.force * k.normal;
    f.normal = k.normal;
    f.record = &k;
    if (contact::is_cell(k.partner)) {
      f.b = k.partner == contact::Partner::kSphere ? numbers.of_sphere(k.b) : numbers.of_body[k.b];
      f.touching = f.a != f.b && (sphere || f.force.squaredNorm() > 0);
    } else {
      f.kind = k.partner;
      f.index = k.b;
      f.area = k.touching;
    }
    if (sphere)
      places.set_arms_of_sphere(k, f);
    else
      places.set_arms_of_surface(k, f);
    visit(f);
  };
  for (const contact::Contact& k : w.contacts.all) visit_record(k);
  visit_sphere_pairs(world, w, visit_record);
  visit_fading(world, places, visit);
}

Reactions compute_reactions(const World& world, const Workspace& w) {
  const contact::Boundary& boundary = world.params.boundary;
  Reactions r;
  const auto part_of = [&r](contact::Partner kind) -> std::vector<Reaction>& {
    return r.part[static_cast<std::size_t>(kind)];
  };
  contact::for_each_wall(
      boundary, [&](contact::Partner kind, auto, const auto&) { part_of(kind).emplace_back(); });
  part_of(contact::Partner::kMesh).resize(boundary.meshes.size());
  part_of(contact::Partner::kVessel).resize(boundary.vessels.network.segment.size());
  constexpr std::size_t kNumbers = 5;  // net force, normal, area
  std::vector<ExactSum> sum;
  std::array<std::size_t, contact::kObstacleKinds> first{};
  for (std::size_t kind = 0; kind < r.part.size(); ++kind) {
    first[kind] = sum.size();
    sum.resize(sum.size() + kNumbers * r.part[kind].size());
  }
  visit_contacts(world, w, [&](const ContactForce& c) {
    if (c.b != kNoCell || c.fades) return;
    const std::size_t at =
        first[static_cast<std::size_t>(c.kind)] + kNumbers * static_cast<std::size_t>(c.index);
    for (std::size_t k = 0; k < 3; ++k) sum[at + k].add(-c.force[static_cast<int>(k)]);
    sum[at + 3].add(c.force.dot(c.normal));
    sum[at + 4].add(c.area);
  });
  w.system.ownership.ranks.sum(sum);
  auto next = sum.begin();
  const auto value = [&next] { return (next++)->value(); };
  for (std::vector<Reaction>& parts : r.part)
    for (Reaction& part : parts) {
      for (int k = 0; k < 3; ++k) part.net[k] = value();
      part.normal = value();
      part.area = value();
    }
  return r;
}

double interface_residual(const World& world, const Workspace& w) {
  struct Load {
    Vec3 place, force;
  };
  std::vector<Load> loads;
  for (const contact::Contact& k : w.contacts.interface()) {
    if (w.dcm.is_ghost_body(static_cast<std::size_t>(k.a))) continue;  // another one's to add
    const solve::Stencil stencil = stencil_of(world, w, k);
    for (int m = 0; m < stencil.n; ++m)
      loads.push_back({load_point(w.position.data(), stencil.address[m]),
                       stencil.weight[m] * (k.force * k.normal)});
  }
  const Ranks& ranks = w.system.ownership.ranks;
  const auto sum_over_loads = [&]<std::size_t N>(const auto& numbers_of) {
    std::array<ExactSum, N> sum;
    for (const Load& l : loads) {
      const std::array<double, N> number = numbers_of(l);
      for (std::size_t n = 0; n < N; ++n) sum[n].add(number[n]);
    }
    ranks.sum(sum);
    std::array<double, N> total;
    for (std::size_t n = 0; n < N; ++n) total[n] = sum[n].value();
    return total;
  };
  const auto place = sum_over_loads.template operator()<4>([](const Load& l) {
    return std::array<double, 4>{l.place.x(), l.place.y(), l.place.z(), 1};
  });
  if (place[3] == 0) return 0;
  const Vec3 middle = Vec3(place[0], place[1], place[2]) / place[3];
  const auto total = sum_over_loads.template operator()<8>([&](const Load& l) {
    const Vec3 arm = l.place - middle, turn = arm.cross(l.force);
    return std::array<double, 8>{
        l.force.x(), l.force.y(), l.force.z(),    turn.x(),
        turn.y(),    turn.z(),    l.force.norm(), arm.norm() * l.force.norm()};
  });
  const Vec3 force(total[0], total[1], total[2]), torque(total[3], total[4], total[5]);
  const double size = total[6], moment = total[7];
  return size > 0 ? std::max(force.norm() / size, torque.norm() / moment) : 0;
}

}  // namespace acinus::coupling
