#pragma once
/// Spheres in contact, made without a scene.

#include <cstdint>
#include <span>
#include <vector>

#include "cbm/contact.hpp"
#include "cbm/pair_kernel.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::cbm {

/// Blocks of unknowns of spheres alone.
inline solve::Blocks blocks_of(const State& state) {
  solve::Blocks blocks;
  append_blocks(state, blocks);
  return blocks;
}

/// Spheres with everything around them that a step needs.
struct Spheres {
  State state;
  std::vector<Params> params = std::vector<Params>(1);
  ContactParams options;
  contact::Boundary boundary;
  double time = 0;
  ContactWorkspace work;
  solve::System system;
  contact::ContactList contacts;     ///< with obstacles, of the last find()
  contact::Contacts pairs;           ///< of the last find()
  std::vector<std::int64_t> mother;  ///< empty: all are sisters

  explicit Spheres(const std::vector<NewCell>& cells) : state(make_state(cells)) {
    params[0].adhesion = 0.01;
    params[0].medium_friction = 0.5;
    params[0].vessel_friction = 0.5;
    params[0].cell_friction = 10;
  }
  std::vector<double> radius() const { return radii_at(state, time); }
  void find() {
    const std::vector<double> r = radius(), strength = strengths_at(state, time);
    const ContactInput in{state, params, options, {r, strength, mother}, boundary, time, 0};
    refresh_pairs(in, work);
    solve::set_blocks(system, blocks_of(state));
    compute_overlaps(in, work);
    contacts.all.clear();
    contacts.close(contact::ContactKind::kInterface);
    find_contacts(in, work, contacts, system.point_links);
    add_coupling(work, contacts.of(contact::ContactKind::kSphereObstacle), system.point_links);
    add_contact_loads(in, work, contacts, system);
    pairs.clear();
    visit_pairs(in, work, [this](const contact::Contact& c) { pairs.push_back(c); });
  }
  const contact::Contacts& sphere() const { return pairs; }
  std::span<const contact::Contact> obstacle() const { return contacts.sphere_obstacle(); }
  /// Links of what touches; near pairs that do not have links of zeros.
  solve::PointLinks links() const {
    solve::PointLinks out;
    for (const solve::PointLink& l : system.point_links)
      if (l.stiffness > 0 || l.friction > 0) out.push_back(l);
    return out;
  }
  /// Force on a cell from other cells, and from boundary, nN.
  Vec3 force(std::size_t cell) const {
    return load_point(system.force.data(), cell_address(0, cell));
  }
  Vec3 external_force(std::size_t cell) const {
    return load_point(system.external_force.data(), cell_address(0, cell));
  }
  /// Takes over the touching pairs, like an accepted step.
  void accept() { state.touching = work.touching; }
  void move(std::size_t cell, const Vec3& to) {
    store_point(state.position.data(), cell_address(0, cell), to);
  }
};

inline NewCell sphere(const Vec3& center, double radius = 12, double young = 0.45) {
  NewCell c;
  c.center = center;
  c.radius = radius;
  c.young = young;
  return c;
}

inline Spheres random_spheres(std::uint64_t seed, int n, double width) {
  auto random = reference::stream(seed);
  std::vector<NewCell> cells;
  for (int k = 0; k < n; ++k) {
    cells.push_back(sphere(reference::random_vector(random, width), random.uniform(9, 15),
                           random.uniform(0.3, 0.6)));
    cells.back().type = k % 3 == 0 ? 1 : 0;
  }
  Spheres s(cells);
  s.params.push_back(s.params[0]);
  s.params[1].adhesion = 0.05;
  s.params[1].poisson = 0.4;
  return s;
}

}  // namespace acinus::cbm
