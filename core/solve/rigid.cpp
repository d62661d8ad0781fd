#include "core/solve/rigid.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "core/solve/link_kernels.hpp"
#include "core/solve/row_blocks.hpp"
#include "core/threads.hpp"

namespace acinus::solve {
namespace {

using Map3x6 = Eigen::Matrix<double, 3, 6>;

int find_root(std::vector<int>& parent, int i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

/// Numbers the groups of cells joined by pair links; returns how many there are.
int number_groups(const System& s, std::span<const std::uint8_t> active, RigidWorkspace& work) {
  find_row_blocks(s, work.block_of_row);
  auto cell_of = [&](Point p) {
    return work.block_of_row[p / kLanes] * kLanes + static_cast<int>(p % kLanes);
  };
  std::vector<int>& parent = work.parent;
  parent.resize(active.size());
  std::iota(parent.begin(), parent.end(), 0);
  int last_a = -1, last_b = -1;  // links come sorted by pair of cells
  auto join = [&](Point at_a, Point at_b) {
    if (at_b == kNowhere) return;
    const int a = cell_of(at_a), b = cell_of(at_b);
    if (a == last_a && b == last_b) return;
    last_a = a;
    last_b = b;
    const int root_a = find_root(parent, a), root_b = find_root(parent, b);
    parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
  };
  for (const Link& l : s.links.link) join(l.a.point[0], l.b.point[0]);
  // Pairs of spheres are listed before they touch, some steps sooner or later.
  for (const PointLink& l : s.point_links)
    if (has_matrix(l, s.stiffness_scale)) join(l.a, l.b);
  work.group.assign(active.size(), -1);
  int n = 0;
  for (std::size_t c = 0; c < active.size(); ++c) {
    if (!active[c]) continue;
    const std::size_t root = find_root(parent, static_cast<int>(c));
    if (work.group[root] < 0) work.group[root] = n++;
    work.group[c] = work.group[root];
  }
  return n;
}

/// The six unit motions of a point: three translations, then rotations about the centre.
Map3x6 unit_motions(const Vec3& from_center) {
  Map3x6 m;
  m.leftCols<3>().setIdentity();
  for (int k = 0; k < 3; ++k) m.col(3 + k) = Vec3::Unit(k).cross(from_center);
  return m;
}

/// Sum of m z^T z over the points of a group.
Mat6 medium_matrix(const RigidGroup& g) {
  Mat3 cross;  // cross * v = first_moment x v
  const Vec3& f = g.first_moment;
  cross << 0, -f.z(), f.y(), f.z(), 0, -f.x(), -f.y(), f.x(), 0;
  Mat6 m;
  m.topLeftCorner<3, 3>() = g.mass * Mat3::Identity();
  m.bottomLeftCorner<3, 3>() = cross;
  m.topRightCorner<3, 3>() = cross.transpose();
  m.bottomRightCorner<3, 3>() = g.second_moment.trace() * Mat3::Identity() - g.second_moment;
  return m;
}

/// f(address, group) for the points of cells in blocks [first, last).
template <class F>
void for_each_point(const System& s, const std::vector<int>& group, std::size_t first,
                    std::size_t last, F f) {
  for (std::size_t b = first; b < last; ++b)
    for (int i = 0; i < s.block[b].pattern->n_point; ++i)
      for (int l = 0; l < kLanes; ++l) {
        const int g = group[b * kLanes + l];
        if (g >= 0) f(make_address(s.block[b].first_row + i, l), static_cast<std::size_t>(g));
      }
}

/// Parts of a sum over all points: as many whatever the number of threads, one if there are so many
/// groups that their sums would take more memory than the points.
std::size_t count_parts(const System& s, std::size_t n_group) {
  return n_group > 64 ? 1 : std::min<std::size_t>(32, std::max<std::size_t>(s.block.size(), 1));
}

/// f(address, group number) for every point, in parallel; f writes to that point only.
template <class F>
void for_each_point(const System& s, const std::vector<int>& group, F f) {
  const std::size_t n_part = count_parts(s, 1);
  for_each_index(n_part, worth_threads(s.n_row), [&](std::size_t k) {
    for_each_point(s, group, k * s.block.size() / n_part, (k + 1) * s.block.size() / n_part, f);
  });
}

/// f(address, its group's part) for every point; parts are added to the groups in order.
template <class F>
void sum_over_points(const System& s, RigidWorkspace& work, F f) {
  std::vector<RigidGroup>& groups = work.groups;
  const std::size_t n_group = groups.size(), n_part = count_parts(s, n_group);
  work.part.assign(n_part * n_group, {});
  for_each_index(n_part, worth_threads(s.n_row), [&](std::size_t k) {
    for_each_point(s, work.group, k * s.block.size() / n_part, (k + 1) * s.block.size() / n_part,
                   [&](Address a, std::size_t g) { f(a, groups[g], work.part[k * n_group + g]); });
  });
  for (std::size_t k = 0; k < n_part; ++k)
    for (std::size_t g = 0; g < n_group; ++g) groups[g].add(work.part[k * n_group + g]);
}

Vec6 solve_spd(const Mat6& m, const Vec6& rhs) {
  // Scaled so that a cluster free in one mode (no friction) does not divide by zero.
  const Vec6 scale = m.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Mat6 a = scale.asDiagonal() * m * scale.asDiagonal();
  a.diagonal().array() += 1e-14;
  return scale.asDiagonal() * a.ldlt().solve(Vec6(scale.asDiagonal() * rhs));
}

/// The groups of one solve, from their centres to their corrections.
class RigidModes {
 public:
  RigidModes(const Operator& op, const RigidCells& cells, RigidWorkspace& work)
      : op_(op), s_(op.system()), position_(cells.position), work_(work), groups_(work.groups) {
    groups_.assign(number_groups(s_, cells.active, work), {});
    sum([&](Address a, const RigidGroup&, RigidGroup& part) {
      part.sum += at(a);
      part.n_point += 1;
    });
    for (RigidGroup& g : groups_) g.center = g.sum / g.n_point;
  }

  /// What ties a group to the outside: medium and boundary. It is a lower bound of the
  /// projected matrix, and all of it but for the rotations: no link or element within a group feels
  /// a translation.
  void tie_to_outside(std::span<const double> residual) {
    sum([&](Address a, const RigidGroup& whole, RigidGroup& group) {
      const Vec3 d = at(a) - whole.center;
      group.squared_reach = std::max(group.squared_reach, d.squaredNorm());
      const Vec3 r = load_point(residual.data(), a);
      group.residual.head<3>() += r;
      group.residual.tail<3>() += d.cross(r);
      const double m = s_.friction_scale * s_.medium[a / kPointStride * kLanes + a % kLanes];
      group.mass += m;
      group.first_moment += m * d;
      group.second_moment += m * d * d.transpose();
    });
    for (RigidGroup& g : groups_) g.matrix = medium_matrix(g);
    // Every part looks at all links and ties its own groups, in their order.
    const std::size_t n_part = std::min(count_threads(s_.n_row), groups_.size());
    for_each_part(n_part, [&](std::size_t part) {
      const auto is_mine = [&](Address a) {
        const int g = group_of(a);
        return g >= 0 && static_cast<std::size_t>(g) % n_part == part;
      };
      for (const Link& l : s_.links.link)
        if (!l.b.exists() && is_mine(address_of(l.a.point[0]))) tie(stencil_of(l), l);
      for (const PointLink& l : s_.point_links)
        if (l.b == kNowhere && is_mine(address_of(l.a))) tie({1, {address_of(l.a)}, {1}}, l);
    });
  }

  /// Chooses the groups whose rigid error may be larger, um.
  int choose(double threshold) {
    int chosen = 0;
    for (RigidGroup& g : groups_) {
      g.correct = size_of(solve_spd(g.matrix, g.residual), g) > threshold;
      chosen += g.correct ? 1 : 0;
    }
    return chosen;
  }

  /// Replaces the part of rotations by that of the whole operator. Groups share no link, so one
  /// product serves the same mode of all of them.
  void project_rotations() {
    work_.mode.resize(position_.size());
    work_.product.resize(position_.size());
    for (RigidGroup& g : groups_) g.matrix.bottomRightCorner<3, 3>().setZero();
    for (int axis = 0; axis < 3; ++axis) {
      std::ranges::fill(work_.mode, 0.0);
      for_each_point(s_, work_.group, [&](Address a, std::size_t g) {
        if (groups_[g].correct)
          store_point(work_.mode.data(), a, Vec3::Unit(axis).cross(at(a) - groups_[g].center));
      });
      op_.apply(work_.mode, work_.product);
      sum([&](Address a, const RigidGroup& whole, RigidGroup& group) {
        group.matrix.block<3, 1>(3, 3 + axis) +=
            (at(a) - whole.center).cross(load_point(work_.product.data(), a));
      });
    }
  }

  /// Moves the chosen groups. @return the largest move, um
  double correct(std::span<double> x) {
    double largest = 0;
    for (RigidGroup& g : groups_) {
      if (!g.correct) continue;
      g.motion = solve_spd(0.5 * (g.matrix + g.matrix.transpose()), g.residual);
      largest = std::max(largest, size_of(g.motion, g));
    }
    for_each_point(s_, work_.group, [&](Address a, std::size_t g) {
      if (groups_[g].correct)
        add_point(x.data(), a, unit_motions(at(a) - groups_[g].center) * groups_[g].motion);
    });
    return largest;
  }

 private:
  Vec3 at(Address a) const { return load_point(position_.data(), a); }
  static double size_of(const Vec6& motion, const RigidGroup& g) {
    return motion.head<3>().norm() + motion.tail<3>().norm() * std::sqrt(g.squared_reach);
  }
  template <class F>
  void sum(F f) {
    sum_over_points(s_, work_, f);
  }
  /// Number of the group that a point belongs to; -1: none.
  int group_of(Address a) const {
    const std::size_t block = work_.block_of_row[a / kPointStride];
    return work_.group[block * kLanes + a % kPointStride];
  }
  template <class L>
  void tie(const Stencil& stencil, const L& l) {
    RigidGroup& group = groups_[group_of(stencil.address[0])];
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < stencil.n; ++k) place += stencil.weight[k] * at(stencil.address[k]);
    const Map3x6 z = unit_motions(place - group.center);
    const Vec3 n(static_cast<double>(l.normal[0]), static_cast<double>(l.normal[1]),
                 static_cast<double>(l.normal[2]));
    const Mat3 m = s_.stiffness_scale * static_cast<double>(l.stiffness) * n * n.transpose() +
                   s_.friction_scale * static_cast<double>(l.friction) * Mat3::Identity();
    group.matrix += z.transpose() * m * z;
  }

  const Operator& op_;
  const System& s_;
  std::span<const double> position_;
  RigidWorkspace& work_;
  std::vector<RigidGroup>& groups_;
};

}  // namespace

RigidResult correct_rigid_modes(const Operator& op, std::span<const double> residual,
                                std::span<double> x, const RigidCells& cells, double threshold,
                                RigidWorkspace& work) {
  RigidModes modes(op, cells, work);
  modes.tie_to_outside(residual);
  RigidResult result;
  result.corrected_groups = modes.choose(threshold);
  if (result.corrected_groups == 0) return result;
  modes.project_rotations();
  result.largest_move = modes.correct(x);
  return result;
}

}  // namespace acinus::solve
