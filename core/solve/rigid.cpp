#include "core/solve/rigid.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

namespace acinus::solve {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Map3x6 = Eigen::Matrix<double, 3, 6>;

struct Group {
  Vec3 center = Vec3::Zero();
  double n_point = 0;
  double reach = 0;  ///< um, farthest point from the centre
  Vec6 residual = Vec6::Zero();
  Mat6 matrix = Mat6::Zero();
  Vec6 motion = Vec6::Zero();
  bool correct = false;
};

int find_root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    parent[static_cast<std::size_t>(i)] =
        parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
    i = parent[static_cast<std::size_t>(i)];
  }
  return i;
}

/// Numbers the groups of cells joined by pair links; returns how many there are.
int number_groups(const System& s, std::span<const std::uint8_t> active, std::vector<int>& group) {
  std::vector<int> block_of_row(s.n_row);
  for (std::size_t b = 0; b < s.block.size(); ++b)
    std::fill_n(block_of_row.begin() + static_cast<std::ptrdiff_t>(s.block[b].first_row),
                s.block[b].pattern->n_point, static_cast<int>(b));
  auto cell_of = [&](Address a) {
    return block_of_row[a / kPointStride] * kLanes + static_cast<int>(a % kLanes);
  };
  std::vector<int> parent(active.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    if (s.links.external[l]) continue;
    const int a = find_root(parent, cell_of(s.links.address[s.links.start[l]]));
    const int b = find_root(parent, cell_of(s.links.address[s.links.start[l + 1] - 1]));
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  group.assign(active.size(), -1);
  int n = 0;
  for (std::size_t c = 0; c < active.size(); ++c) {
    if (!active[c]) continue;
    const auto root = static_cast<std::size_t>(find_root(parent, static_cast<int>(c)));
    if (group[root] < 0) group[root] = n++;
    group[c] = group[root];
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

/// f(address, group) for every point of every cell.
template <class F>
void for_each_point(const System& s, const std::vector<int>& group, F f) {
  for (std::size_t b = 0; b < s.block.size(); ++b)
    for (int i = 0; i < s.block[b].pattern->n_point; ++i)
      for (int l = 0; l < kLanes; ++l) {
        const int g = group[b * kLanes + static_cast<std::size_t>(l)];
        if (g >= 0)
          f(make_address(s.block[b].first_row + static_cast<std::size_t>(i), l),
            static_cast<std::size_t>(g));
      }
}

Vec6 solve_spd(const Mat6& m, const Vec6& rhs) {
  // Scaled so that a cluster free in one mode (no friction) does not divide by zero.
  const Vec6 scale = m.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Mat6 a = scale.asDiagonal() * m * scale.asDiagonal();
  a.diagonal().array() += 1e-14;
  return scale.asDiagonal() * a.ldlt().solve(Vec6(scale.asDiagonal() * rhs));
}

}  // namespace

RigidResult correct_rigid_modes(const Operator& op, std::span<const double> b, std::span<double> x,
                                std::span<const double> position,
                                std::span<const std::uint8_t> active, double threshold,
                                RigidWorkspace& work) {
  const System& s = op.system();
  for (auto* v : {&work.residual, &work.mode, &work.product}) v->resize(b.size());
  std::vector<Group> groups(static_cast<std::size_t>(number_groups(s, active, work.group)));

  for_each_point(s, work.group, [&](Address a, std::size_t g) {
    groups[g].center += load_point(position.data(), a);
    groups[g].n_point += 1;
  });
  for (Group& g : groups) g.center /= g.n_point;

  op.apply(x, work.product);
  for (std::size_t k = 0; k < b.size(); ++k) work.residual[k] = b[k] - work.product[k];

  // Lower bound of the projected matrix: medium and surroundings only. It bounds the rigid error.
  for_each_point(s, work.group, [&](Address a, std::size_t g) {
    Group& group = groups[g];
    const Vec3 d = load_point(position.data(), a) - group.center;
    group.reach = std::max(group.reach, d.norm());
    const Map3x6 z = unit_motions(d);
    group.residual += z.transpose() * load_point(work.residual.data(), a);
    const double m = s.friction_scale * s.medium[a / kPointStride * kLanes + a % kLanes];
    group.matrix += m * z.transpose() * z;
  });
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    if (!s.links.external[l]) continue;
    Map3x6 z = Map3x6::Zero();
    const Address first = s.links.address[s.links.start[l]];
    std::size_t block = 0;
    {  // blocks are in row order
      const std::size_t row = first / kPointStride;
      std::size_t lo = 0, hi = s.block.size();
      while (hi - lo > 1) {
        const std::size_t mid = (lo + hi) / 2;
        (s.block[mid].first_row <= row ? lo : hi) = mid;
      }
      block = lo;
    }
    const int g = work.group[block * kLanes + first % kLanes];
    if (g < 0) continue;
    Group& group = groups[static_cast<std::size_t>(g)];
    for (std::uint32_t k = s.links.start[l]; k < s.links.start[l + 1]; ++k)
      z += s.links.weight[k] *
           unit_motions(load_point(position.data(), s.links.address[k]) - group.center);
    const Sym3 m = link_matrix(s, l);
    Mat3 full;
    full << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
    group.matrix += z.transpose() * full * z;
  }

  RigidResult result;
  for (Group& g : groups) {
    const Vec6 bound = solve_spd(g.matrix, g.residual);
    g.correct = bound.head<3>().norm() + bound.tail<3>().norm() * g.reach > threshold;
    result.corrected_groups += g.correct ? 1 : 0;
    g.matrix.setZero();
  }
  if (result.corrected_groups == 0) return result;

  // Groups share no link, so one product serves the same mode of all of them.
  for (int mode = 0; mode < 6; ++mode) {
    std::ranges::fill(work.mode, 0.0);
    for_each_point(s, work.group, [&](Address a, std::size_t g) {
      if (groups[g].correct)
        store_point(work.mode.data(), a,
                    unit_motions(load_point(position.data(), a) - groups[g].center).col(mode));
    });
    op.apply(work.mode, work.product);
    for_each_point(s, work.group, [&](Address a, std::size_t g) {
      groups[g].matrix.col(mode) +=
          unit_motions(load_point(position.data(), a) - groups[g].center).transpose() *
          load_point(work.product.data(), a);
    });
  }
  for (Group& g : groups) {
    if (!g.correct) continue;
    g.motion = solve_spd(0.5 * (g.matrix + g.matrix.transpose()), g.residual);
    result.largest_move = std::max(result.largest_move,
                                   g.motion.head<3>().norm() + g.motion.tail<3>().norm() * g.reach);
  }
  for_each_point(s, work.group, [&](Address a, std::size_t g) {
    if (groups[g].correct)
      add_point(x.data(), a,
                unit_motions(load_point(position.data(), a) - groups[g].center) * groups[g].motion);
  });
  return result;
}

}  // namespace acinus::solve
