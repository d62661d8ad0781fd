#pragma once
/// Cells with nuclei for the tests of what is inside.

#include <Eigen/Dense>
#include <vector>

#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/contact/nucleus_contact.hpp"
#include "dcm/loads/loads.hpp"
#include "dcm/terms/nucleus_links.hpp"
#include "dcm/terms/nucleus_shell.hpp"
#include "solve/operator.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::dcm {

inline Params with_nucleus(const Nucleus& nucleus = {}) {
  Params p = table_one();
  p.nucleus = nucleus;
  return p;
}

/// One group of cells with nuclei, and all that is inside them.
struct NucleatedCells {
  Params params;
  ContactParams options{.cell_friction = 0};
  contact::Boundary boundary;
  State state;
  LaneData lanes;
  solve::System system;
  ContactWorkspace cortices;
  NucleusWorkspace nuclei;
  contact::ContactList contacts;

  ContactInput input() const { return {state, std::span(&params, 1), options, lanes, boundary}; }
  GroupView cortex_view() const { return view_group(state, lanes, system, 0); }
  GroupView view() const { return view_nuclei(state, lanes, system, 0); }
  int n_point() const { return state.group[0].n_point(); }
  int n_cortex() const { return state.group[0].topology->n_node; }

  /// Empty loads for the present positions.
  void reset() {
    lanes = make_lane_data(state, 0);
    solve::set_blocks(system, make_blocks(state, std::span(&params, 1)));
    size_rank_one(state, std::span(&params, 1), system);
    solve::clear_loads(system);
    system.point_links.clear();
  }
  void find_contacts() {
    refresh_bodies(state, cortices);
    contacts.all.clear();
    find_nucleus_contacts(input(), cortices, nuclei, contacts);
  }
  Vec3 point(std::size_t lane, int i) const {
    return load_point(state.position.data(), node_address(state, lane, i));
  }
  void move(std::size_t lane, int i, const Vec3& to) {
    store_point(state.position.data(), node_address(state, lane, i), to);
  }
  Vec3 force(std::size_t lane, int i) const {
    return load_point(system.force.data(), node_address(state, lane, i));
  }
  double largest_force(std::size_t lane) const {
    double f = 0;
    for (int i = 0; i < n_point(); ++i) f = std::max(f, force(lane, i).norm());
    return f;
  }
  /// Adds the forces of links or of contacts, like a step.
  void add_links() { add_nucleus_links(state, std::span(&params, 1), lanes, system); }
  void add_contacts() {
    find_contacts();
    add_nucleus_contacts(input(), cortices, contacts, system.links);
    solve::Operator op;
    op.add_link_forces(system, [&](std::size_t link) -> Vec3 {
      const contact::Contact& k = contacts.all[system.links.law[link].contact];
      return k.force * k.normal;
    });
  }
  double contact_energy() {
    find_contacts();
    double energy = 0;
    for (const contact::Contact& c : contacts.nucleus())
      energy += nucleus_contact_energy(c, nucleus_contact_area(input(), cortices, c));
    return energy;
  }
};

/// Cells at rest of these radii.
inline NucleatedCells make_nucleated(const Params& params, const std::vector<double>& radius,
                                     int n_node = 162) {
  NucleatedCells c;
  c.params = params;
  std::vector<NewCell> cells;
  for (std::size_t l = 0; l < radius.size(); ++l)
    cells.push_back({static_cast<std::int64_t>(l), 0, &geometry::shared_icosphere(n_node),
                     Vec3(40.0 * static_cast<double>(l), 0, 0), radius[l], Vec3::Zero(),
                     Mat3::Identity(), nucleus_mesh(&*params.nucleus)});
  c.state = make_state(cells);
  c.reset();
  return c;
}

/// Cells as above, with the points of every cell sheared, turned and shaken by a tenth of an edge
/// of the nucleus.
inline NucleatedCells make_deformed_nucleated(const Params& params,
                                              const std::vector<double>& radius, int n_node = 162) {
  NucleatedCells c = make_nucleated(params, radius, n_node);
  auto random = reference::stream(3);
  for (std::size_t l = 0; l < radius.size(); ++l) {
    const Mat3 shape = reference::random_rotation(random) *
                       (Mat3::Identity() + reference::random_matrix(random, 0.1));
    const double rough = 0.05 * params.nucleus->size * radius[l];
    const Vec3 center = cell_center(c.state, l);
    for (int i = 0; i < c.n_point(); ++i)
      c.move(l, i,
             center + shape * (c.point(l, i) - center) + reference::random_vector(random, rough));
  }
  c.reset();
  return c;
}

/// Matrix of one lane, column by column.
inline Eigen::MatrixXd matrix_of(const NucleatedCells& c, std::size_t lane) {
  solve::Operator op;
  op.prepare(c.system);
  const int n = 3 * c.n_point();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  std::vector<double> x(c.system.n_dof()), y(x.size());
  const auto at = [&](int k) {
    return node_address(c.state, lane, k / 3) + static_cast<std::size_t>(k % 3 * kLanes);
  };
  for (int column = 0; column < n; ++column) {
    x[at(column)] = 1;
    op.apply(x, y);
    x[at(column)] = 0;
    for (int row = 0; row < n; ++row) out(row, column) = y[at(row)];
  }
  return out;
}

}  // namespace acinus::dcm
