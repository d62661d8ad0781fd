#pragma once
/// Touching cells for the tests of contact.

#include <span>
#include <vector>

#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/system.hpp"
#include "tests/reference/net_force.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::dcm {

struct Clump {
  State state;
  std::vector<Params> params;
  ContactParams options{.cell_friction = 0};
  contact::Boundary boundary;
  double time = 0;
  LaneData lanes;
  ContactWorkspace work;
  contact::ContactList contacts;
  solve::Links links;

  ContactInput input() const { return {state, params, options, lanes, boundary, time}; }
  std::span<const contact::Contact> surface() const { return contacts.surface(); }
  std::span<const contact::Contact> obstacle() const { return contacts.obstacle(); }

  void add_cells(const std::vector<NewCell>& cells) {
    state = make_state(cells);
    params.assign(1, params_without_terms());
    params[0].adhesion = 0.01;
    options.cell_friction = 50;
  }
  void find() {
    lanes = make_lane_data(state, time);
    work.fixed.clear();
    for (const contact::StaticMesh& m : boundary.meshes) work.fixed.push_back(m.body);
    refresh_bodies(state, work);
    refresh_lists(input(), work);
    find_contacts(input(), work, contacts);
    links.clear();
    add_contact_loads(input(), work, contacts, links);
  }
  /// Contacts as if no list had been made before.
  void find_afresh() {
    work.lists = {};
    find();
  }
  /// Force of a contact on its side a, nN.
  Vec3 force(std::size_t link) const {
    const contact::Contact& k = contacts.all[links.law[link].contact];
    return k.force * k.normal;
  }
  reference::NetForce net_force(std::span<const double> node_force) const {
    reference::NetForce net;
    for_each_node([&](Address a) {
      net.add(load_point(node_force.data(), a), load_point(state.position.data(), a));
    });
    return net;
  }
  /// [n_dof] the force of all links on the nodes.
  std::vector<double> node_force() const {
    std::vector<double> f(state.position.size());
    for (std::size_t l = 0; l < links.size(); ++l) {
      const solve::Stencil s = solve::stencil_of(links.link[l]);
      for (std::size_t k = 0; k < static_cast<std::size_t>(s.n); ++k)
        add_point(f.data(), s.address[k], s.weight[k] * force(l));
    }
    return f;
  }
  /// f(address) for all nodes of all cells.
  template <class F>
  void for_each_node(F f) const {
    for (std::size_t l = 0; l < state.n_lane(); ++l)
      for (int i = 0; state.active(l) && i < state.group[l / kLanes].topology->n_node; ++i)
        f(node_address(state, l, i));
  }
  /// Moves every node by t * (its part of a direction).
  void shift(const std::vector<double>& direction, double t) {
    for (std::size_t k = 0; k < direction.size(); ++k) state.position[k] += t * direction[k];
  }
};

inline NewCell new_cell(std::int64_t lineage, const Vec3& center, double radius,
                        const Mat3& rotation, int n_node = 162) {
  NewCell c;
  c.lineage = lineage;
  c.topology = &geometry::shared_icosphere(n_node);
  c.center = center;
  c.radius = radius;
  c.rotation = rotation;
  return c;
}

/// Five rough cells of three sizes that all touch or overlap their neighbours.
inline Clump make_clump(std::uint64_t seed) {
  auto random = reference::stream(seed);
  Clump c;
  std::vector<NewCell> cells;
  const Vec3 place[5] = {{0, 0, 0}, {19.6, 0, 0}, {9.8, 17, 0}, {9.8, 5.6, 16}, {9.8, 5.6, -16.4}};
  const double radius[5] = {10, 10, 9.8, 10, 10.3};
  for (int k = 0; k < 5; ++k)
    cells.push_back(new_cell(k, Vec3(7, -5, 3) + place[k], radius[k],
                             reference::random_rotation(random), k == 2 ? 42 : 162));
  c.add_cells(cells);
  c.for_each_node([&](Address a) {
    add_point(c.state.position.data(), a, reference::random_vector(random, 0.1));
  });
  return c;
}

}  // namespace acinus::dcm
