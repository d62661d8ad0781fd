#include "coupling/vessels/vessel_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace acinus::coupling {
namespace {

constexpr int kLane = 0;  ///< lane of the tree in its block

double mean_radius(const geometry::Network& n, std::size_t segment) {
  return 0.5 * (n.radius[segment][0] + n.radius[segment][1]);
}

/// Point numbers of a segment: two nodes, then their rotations.
std::array<int, 4> points_of(const VesselTree& tree, std::size_t segment) {
  const auto [a, b] = tree.rest.segment[segment];
  const int n = static_cast<int>(tree.n_node());
  return {a, b, n + a, n + b};
}

BeamEnds ends_of(const VesselTree& tree, const TreeState& state, std::size_t segment) {
  BeamEnds ends;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t node = tree.rest.segment[segment][k];
    ends.place[k] = state.node[node];
    ends.frame[k] = state.rotation[node].toRotationMatrix() * tree.frame[segment];
  }
  return ends;
}

/// Number of segments at every node.
std::vector<int> count_segments(const geometry::Network& n) {
  std::vector<int> degree(n.node.size(), 0);
  for (const auto& segment : n.segment)
    for (const int node : segment) ++degree[node];
  return degree;
}

Mat3 frame_along(const Vec3& axis) {
  Mat3 f;
  f.col(0) = axis.normalized();
  f.col(1) = f.col(0).unitOrthogonal();
  f.col(2) = f.col(0).cross(f.col(1));
  return f;
}

/// Writes a vector into the tree's lane of an element.
void put(const Vec3& v, std::size_t number, float* element) {
  for (std::size_t k = 0; k < 3; ++k)
    element[(number + k) * kLanes + kLane] = static_cast<float>(v[static_cast<int>(k)]);
}

/// Spring of the block: `along` in its direction, `across` in all others.
void put_spring(double length, double along, double across, float* element) {
  element[kLane] = static_cast<float>((along - across) / (length * length));
  element[kLanes + kLane] = static_cast<float>(across);
}

/// Writes the places of nodes from their mean, for their rotations as well.
void put_shape(const TreeState& s, float* shape) {
  const Vec3 sum = std::accumulate(s.node.begin(), s.node.end(), Vec3(Vec3::Zero()));
  const Vec3 middle = sum / static_cast<double>(s.node.size());
  for (std::size_t i = 0; i < s.n_row(); ++i)
    put(s.node[i % s.node.size()] - middle, 0, shape + i * kPointStride);
}

}  // namespace

bool VesselTree::has_ends() const {
  const std::vector<int> degree = count_segments(rest);
  return std::ranges::find(degree, 1) != degree.end();
}

VesselTree make_tree(geometry::Network rest, const TubeMaterial& m, VesselAnchors anchors) {
  VesselTree tree;
  tree.rest = std::move(rest);
  tree.material = m;
  const std::size_t n_node = tree.rest.node.size(), n_segment = tree.rest.segment.size();
  tree.friction.assign(n_node, 0.0);
  tree.turn_friction.assign(n_node, 0.0);
  for (std::size_t s = 0; s < n_segment; ++s) {
    const auto [a, b] = tree.rest.segment[s];
    const Vec3 axis = tree.rest.node[b] - tree.rest.node[a];
    const double length = axis.norm(), radius = mean_radius(tree.rest, s);
    tree.tube.push_back({radius, m.wall});
    tree.beam.push_back(make_beam(tree.tube.back(), length, m.young, m.poisson, m.pressure));
    tree.frame.push_back(frame_along(axis));
    const double half = m.friction * kPi * radius * length;  // of its surface
    for (const int n : {a, b}) {
      tree.friction[n] += half;
      tree.turn_friction[n] += half * radius * radius;
    }
  }
  for (const int d : count_segments(tree.rest))
    tree.anchored.push_back(d == 0 || (d == 1 && anchors == VesselAnchors::kEnds) ? 1 : 0);
  tree.pattern.n_place = static_cast<int>(n_node);
  tree.pattern.n_point = static_cast<int>(2 * n_node);
  for (std::size_t s = 0; s < n_segment; ++s) {
    const auto [a, b, turn_a, turn_b] = points_of(tree, s);
    tree.pattern.spring.push_back({a, b});
    tree.pattern.spring.push_back({turn_a, turn_b});
    tree.pattern.beam.push_back({a, b, turn_a, turn_b});
  }
  return tree;
}

TreeState at_rest(const VesselTree& tree) {
  return {tree.rest.node,
          std::vector<Eigen::Quaterniond>(tree.n_node(), Eigen::Quaterniond::Identity())};
}

void move_tree(std::span<const double> by, TreeState& s) {
  const std::size_t n = s.node.size();
  for (std::size_t i = 0; i < n; ++i) {
    s.node[i] += load_point(by.data(), make_address(i, kLane));
    const Vec3 turn = load_point(by.data(), make_address(n + i, kLane));
    const double angle = turn.norm();
    if (!(angle > 0)) continue;
    s.rotation[i] = Eigen::AngleAxisd(angle, turn / angle) * s.rotation[i];
    s.rotation[i].normalize();
  }
}

void copy_places(const TreeState& s, std::span<double> out) {
  std::ranges::fill(out, 0.0);
  for (std::size_t i = 0; i < s.n_row(); ++i)
    store_point(out.data(), make_address(i, kLane), s.node[i % s.node.size()]);
}

void place_vessels(const VesselTree& tree, const TreeState& s, contact::Vessels& vessels) {
  if (s.node.empty()) return;
  vessels.network.node = s.node;
  const TubeMaterial& m = tree.material;
  for (std::size_t k = 0; k < tree.beam.size(); ++k) {
    const auto [a, b] = tree.rest.segment[k];
    const double strain = (s.node[b] - s.node[a]).norm() / tree.beam[k].length - 1;
    for (std::size_t end = 0; end < 2; ++end) {
      const double radius = tree.rest.radius[k][end];
      vessels.network.radius[k][end] =
          radius * radius_ratio({radius, m.wall}, m.young, m.poisson, m.pressure, strain);
    }
  }
}

double largest_displacement(const VesselTree& tree, const TreeState& s) {
  double largest2 = 0;
  for (std::size_t i = 0; i < s.node.size(); ++i)
    largest2 = std::max(largest2, (s.node[i] - tree.rest.node[i]).squaredNorm());
  return std::sqrt(largest2);
}

void add_tree_loads(const VesselTree& tree, const TreeState& s, const solve::Block& block,
                    solve::System& system) {
  const double scale = system.stiffness_scale;
  const double root = std::sqrt(scale);
  const auto address = [&](int point) {
    return make_address(block.first_row + static_cast<std::size_t>(point), kLane);
  };
  put_shape(s, system.shape.data() + block.first_shape * kPointStride);
  float* spring = system.spring.data() + block.first_spring * solve::kSpringStride;
  float* beam = system.beam.data() + block.first_beam * solve::kBeamStride;
  for (std::size_t k = 0; k < tree.beam.size(); ++k) {
    const BeamEnds ends = ends_of(tree, s, k);
    const BeamLoad load = compute_load(tree.beam[k], ends);
    const std::array<int, 4> point = points_of(tree, k);
    add_point(system.force.data(), address(point[0]), -load.force);
    add_point(system.force.data(), address(point[1]), load.force);
    for (std::size_t end = 0; end < 2; ++end)
      add_point(system.force.data(), address(point[2 + end]), load.moment[end]);
    const BeamStiffness stiffness = compute_stiffness(tree.beam[k], ends);
    const double length = (ends.place[1] - ends.place[0]).norm();
    put_spring(length, scale * stiffness.axial, scale * stiffness.lateral, spring);
    spring += solve::kSpringStride;
    put_spring(length, scale * stiffness.twist, scale * stiffness.bend, spring);
    spring += solve::kSpringStride;
    for (std::size_t d = 0; d < 2; ++d) {
      put(root * stiffness.place[d], 6 * d, beam);
      put(root * stiffness.turn[d], 6 * d + 3, beam);
    }
    beam += solve::kBeamStride;
  }
  // Empty lanes need some friction, or the matrix would be singular there.
  for (std::size_t i = 0; i < s.n_row(); ++i)
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t node = i % tree.n_node();
      double friction = 1;
      if (lane == kLane)
        friction = i < tree.n_node() ? tree.friction[node] : tree.turn_friction[node];
      system.medium[(block.first_row + i) * kLanes + static_cast<std::size_t>(lane)] += friction;
    }
}

}  // namespace acinus::coupling
