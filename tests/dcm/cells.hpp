#pragma once
/// Deformed cells for the tests of the terms.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dcm/lane_data.hpp"
#include "dcm/loads/loads.hpp"
#include "dcm/state.hpp"
#include "dcm/terms/area.hpp"
#include "dcm/terms/bending.hpp"
#include "dcm/terms/cortex.hpp"
#include "dcm/terms/local_area.hpp"
#include "dcm/terms/matrix_shape.hpp"
#include "dcm/terms/volume.hpp"
#include "geometry/topology.hpp"
#include "solve/operator.hpp"
#include "tests/reference/net_force.hpp"
#include "tests/reference/plain_cell.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::dcm {

/// Table 1: cortex 1 kPa, 500 nm; K_A 0.8 mN/m; K_V 2500 Pa.
inline Params table_one() {
  Params p = params_without_terms();
  p.spring_stiffness = cortex_spring_stiffness(1.0, 0.5);
  p.bending_stiffness = cortex_bending_stiffness(1.0, 0.5, 0.5);
  p.fold_repulsion = 5;
  p.area_modulus = p.local_area_modulus = 0.8;
  p.bulk_modulus = 2.5;
  return p;
}

/// One group of cells with the system its terms add to.
struct Cells {
  State state;
  LaneData lanes;
  solve::System system;

  GroupView view() const { return view_group(state, lanes, system, 0); }
  /// The same for terms, which need the shape.
  GroupView view() {
    write_shape(std::as_const(*this).view(), system);
    return std::as_const(*this).view();
  }
  void reset() {
    lanes = make_lane_data(state, 0);
    const Params p = table_one();
    solve::set_blocks(system, make_blocks(state, std::span(&p, 1)));
    size_rank_one(state, std::span(&p, 1), system);
    solve::clear_loads(system);
  }
  Vec3 node(std::size_t lane, int i) const {
    return load_point(state.position.data(), node_address(state, lane, i));
  }
  void move(std::size_t lane, int i, const Vec3& to) {
    store_point(state.position.data(), node_address(state, lane, i), to);
  }
  Vec3 force(std::size_t lane, int i) const {
    return load_point(system.force.data(), node_address(state, lane, i));
  }
  int n_node() const { return state.group[0].topology->n_node; }
  double largest_force(std::size_t lane) const {
    double f = 0;
    for (int i = 0; i < n_node(); ++i) f = std::max(f, force(lane, i).norm());
    return f;
  }
  reference::NetForce net_force(std::size_t lane) const {
    reference::NetForce net;
    for (int i = 0; i < n_node(); ++i) net.add(force(lane, i), node(lane, i));
    return net;
  }
  reference::PlainCell plain(std::size_t lane) const {
    reference::PlainCell c{state.group[0].topology, {}, lanes.radius[lane]};
    copy_nodes(state, lane, c.node);
    return c;
  }
};

/// Force of a device on a node.
inline Vec3 load_of(const Cells& c, std::size_t lane, int i) {
  return load_point(c.system.external_force.data(), node_address(c.state, lane, i));
}

/// Largest difference of a force of the lane from minus the slope of `energy()`, nN.
template <class Energy>
double worst_slope_error(Cells& c, std::size_t lane, const Energy& energy) {
  const double h = 1e-4;  // um: h^2 E''' and kEps E / h are both near 1e-8 of the force
  double worst = 0;
  for (int i = 0; i < c.n_node(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = c.node(lane, i);
      c.move(lane, i, x + h * Vec3::Unit(k));
      const double more = energy();
      c.move(lane, i, x - h * Vec3::Unit(k));
      const double less = energy();
      c.move(lane, i, x);
      worst = std::max(worst, std::abs(c.force(lane, i)[k] + (more - less) / (2 * h)));
    }
  return worst;
}

/// Lane of make_deformed_cells that holds no cell.
inline constexpr std::size_t kNoCell = 3;

/// Cells at rest, one a lane, of the given radii.
inline Cells make_rest_cells(const geometry::Topology& t, const std::vector<double>& radius) {
  std::vector<NewCell> cells;
  for (std::size_t l = 0; l < radius.size(); ++l) {
    NewCell c;
    c.lineage = static_cast<std::int64_t>(l);
    c.topology = &t;
    c.radius = radius[l];
    cells.push_back(c);
  }
  Cells out;
  out.state = make_state(cells);
  out.reset();
  return out;
}

/// Seven cells of different size, place, orientation and shape (sheared by up to 15 %, rough by 10
/// % of an edge) and an empty lane among them.
inline Cells make_deformed_cells(int n_node = 162) {
  auto random = reference::stream(1);
  std::vector<double> radius;
  for (int l = 0; l < kLanes; ++l) radius.push_back(8 + 0.7 * l);
  const geometry::Topology& t = geometry::shared_icosphere(n_node);
  Cells out = make_rest_cells(t, radius);
  for (std::size_t l = 0; l < kLanes; ++l) {
    const Mat3 shape = reference::random_rotation(random) *
                       (1.03 * Mat3::Identity() + reference::random_matrix(random, 0.15));
    const Vec3 center = reference::random_vector(random, 10);
    const double rough = l == kNoCell ? 0 : 0.1 * t.mean_rest_length * radius[l];
    for (int i = 0; i < t.n_node; ++i) {
      const Vec3 noise = reference::random_vector(random, rough);
      const Vec3& rest = t.rest[i];
      out.move(l, i, l == kNoCell ? rest : Vec3(center + radius[l] * (shape * rest) + noise));
    }
  }
  out.state.lineage[kNoCell] = kEmptyLane;
  out.reset();
  return out;
}

/// Term of the cell's own mechanics, with its energy and the energy's plain twin.
struct Term {
  const char* name;
  void (*add)(const Params&, const GroupView&, solve::System&);
  double (*energy)(const Params&, const GroupView&, int lane);
  double (*plain)(const Params&, const reference::PlainCell&);
};

inline const std::vector<Term>& all_terms() {
  using reference::PlainCell;
  static const std::vector<Term> terms{
      {"cortex", add_cortex, cortex_energy,
       [](const Params& p, const PlainCell& c) {
         return reference::plain_cortex_energy(c, p.spring_stiffness);
       }},
      {"bending", add_bending, bending_energy,
       [](const Params& p, const PlainCell& c) {
         return reference::plain_bending_energy(c, p.bending_stiffness);
       }},
      {"volume",
       [](const Params& p, const GroupView& g, solve::System& s) {
         add_volume(p, g, s, s.rank_one[0]);
       },
       volume_energy,
       [](const Params& p, const PlainCell& c) {
         return reference::plain_volume_energy(c, p.bulk_modulus);
       }},
      {"area",
       [](const Params& p, const GroupView& g, solve::System& s) {
         add_area(p, g, s, s.rank_one[1]);
       },
       area_energy,
       [](const Params& p, const PlainCell& c) {
         return reference::plain_area_energy(c, p.area_modulus);
       }},
      {"local_area", add_local_area, local_area_energy, [](const Params& p, const PlainCell& c) {
         return reference::plain_local_area_energy(c, p.local_area_modulus);
       }}};
  return terms;
}

/// Matrices of all lanes, column by column through the operator. Lanes do not meet without
/// links, so one product serves the same column of all of them.
inline std::vector<Eigen::MatrixXd> lane_matrices(const Cells& c) {
  solve::Operator op;
  op.prepare(c.system);
  const int n = 3 * c.n_node();
  std::vector<Eigen::MatrixXd> out(kLanes, Eigen::MatrixXd::Zero(n, n));
  std::vector<double> x(c.system.n_dof()), y(x.size());
  for (int column = 0; column < n; ++column) {
    for (int l = 0; l < kLanes; ++l) x[column * kLanes + l] = 1;
    op.apply(x, y);
    for (int l = 0; l < kLanes; ++l) {
      x[column * kLanes + l] = 0;
      for (int row = 0; row < n; ++row) out[l](row, column) = y[row * kLanes + l];
    }
  }
  return out;
}

}  // namespace acinus::dcm
