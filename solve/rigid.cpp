#include "solve/rigid.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <utility>

#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::solve {
namespace {

using Map3x6 = Eigen::Matrix<double, 3, 6>;

/// Six unit motions of a point: three translations, then rotations about the centre.
Map3x6 unit_motions(const Vec3& from_center) {
  Map3x6 m;
  m.leftCols<3>().setIdentity();
  for (int k = 0; k < 3; ++k) m.col(3 + k) = Vec3::Unit(k).cross(from_center);
  return m;
}

/// Layout of the sums over the points of a group: residual, then friction with its moments.
enum Number : std::size_t {
  kResidual = 0,
  kMass = 6,  ///< of medium friction, and its moments about the centre
  kFirstMoment = 7,
  kSecondMoment = 10,  ///< xx xy xz yy yz zz
  kNumbers = 16
};
/// Number of entries in the upper triangle of a 6 x 6 matrix.
constexpr std::size_t kUpper = 21;

/// Sum of m z^T z over the points of a group.
Mat6 medium_matrix(double mass, const Vec3& f, const Mat3& second_moment) {
  Mat3 cross;  // cross * v = first moment x v
  cross << 0, -f.z(), f.y(), f.z(), 0, -f.x(), -f.y(), f.x(), 0;
  Mat6 m;
  m.topLeftCorner<3, 3>() = mass * Mat3::Identity();
  m.bottomLeftCorner<3, 3>() = cross;
  m.topRightCorner<3, 3>() = cross.transpose();
  m.bottomRightCorner<3, 3>() = second_moment.trace() * Mat3::Identity() - second_moment;
  return m;
}

template <class M, class F>
void for_each_upper(M& m, F f) {
  std::size_t n = 0;
  for (int i = 0; i < m.rows(); ++i)
    for (int j = i; j < m.cols(); ++j) f(n++, m(i, j), m(j, i));
}

Vec6 solve_spd(const Mat6& m, const Vec6& rhs) {
  // Scaled so that a cluster free in one mode (no friction) does not divide by zero.
  const Vec6 scale = m.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Mat6 a = scale.asDiagonal() * m * scale.asDiagonal();
  a.diagonal().array() += 1e-14;
  return scale.asDiagonal() * a.ldlt().solve(Vec6(scale.asDiagonal() * rhs));
}

/// Rigid modes of the groups in one solve, from their centres to their corrections.
class RigidModes {
 public:
  RigidModes(const Operator& op, const RigidCells& cells, RigidWorkspace& work)
      : op_(op), s_(op.system()), position_(cells.position), work_(work), groups_(work.groups) {
    find_groups(s_, cells.active, work.cells);
    groups_.assign(work.cells.n, {});
    // Vessels that bend, the only rotations, are computed by one process.
    for (const auto& [first, last] : s_.own)
      for (std::size_t b = first; b < last; ++b) {
        if (!s_.block[b].pattern->has_rotations()) continue;
        for (std::size_t c = b * kLanes; c < (b + 1) * kLanes; ++c)
          if (const int g = work.cells.of_cell[c]; g >= 0) groups_[g].rotates = true;
      }
    work.sums.prepare(s_, work.cells);
    work.sums.sum<4>(
        [&](Address a, std::size_t, std::array<double, 4>& sum) {
          const Vec3 x = at(a);
          for (std::size_t k = 0; k < 3; ++k) sum[k] += x[static_cast<int>(k)];
          sum[3] += 1;
        },
        [&](std::size_t g, const std::array<double, 4>& sum) {
          groups_[g].center = Vec3(sum[0], sum[1], sum[2]) / sum[3];
        });
  }

  /// Sums each group's residual and its resistance to rigid motion by medium and boundary. That
  /// matrix is a lower bound of the projected one, and equal to it except for rotations: links and
  /// elements within a group do not resist translation.
  void compute_bounds(std::span<const double> residual) {
    work_.sums.largest(
        [&](Address a, std::size_t g) { return (at(a) - groups_[g].center).squaredNorm(); },
        work_.squared_reach);
    work_.sums.sum<kNumbers>(
        [&](Address a, std::size_t g, std::array<double, kNumbers>& sum) {
          const Vec3 d = at(a) - groups_[g].center;
          const Vec3 r = load_point(residual.data(), a), turn = d.cross(r);
          const double m = s_.friction_scale * s_.medium[a / kPointStride * kLanes + a % kLanes];
          for (std::size_t k = 0; k < 3; ++k) {
            const int i = static_cast<int>(k);
            sum[kResidual + k] += r[i];
            sum[kResidual + 3 + k] += turn[i];
            sum[kFirstMoment + k] += m * d[i];
          }
          sum[kMass] += m;
          const Mat3 second = m * d * d.transpose();
          for_each_upper(second,
                         [&](std::size_t n, double v, double) { sum[kSecondMoment + n] += v; });
        },
        [&](std::size_t g, const std::array<double, kNumbers>& sum) {
          RigidGroup& group = groups_[g];
          for (std::size_t k = 0; k < 6; ++k)
            group.residual[static_cast<int>(k)] = sum[kResidual + k];
          Mat3 second;
          for_each_upper(second, [&](std::size_t n, double& v, double& mirrored) {
            v = mirrored = sum[kSecondMoment + n];
          });
          const Vec3 first(sum[kFirstMoment], sum[kFirstMoment + 1], sum[kFirstMoment + 2]);
          group.matrix = medium_matrix(sum[kMass], first, second);
          group.squared_reach = work_.squared_reach[g];
        });
    add_ties();
  }

  /// Selects the groups whose rigid error may exceed the threshold, um; returns their number.
  int choose(double threshold) {
    int chosen = 0;
    for (RigidGroup& g : groups_) {
      g.correct = !g.rotates && size_of(solve_spd(g.matrix, g.residual), g) > threshold;
      chosen += g.correct ? 1 : 0;
    }
    // What follows is done by all processes or by none.
    return static_cast<int>(s_.ownership.ranks.max(chosen));
  }

  /// Replaces the rotation part of the matrices by that of the whole operator. Groups share no
  /// link, so one product serves the same mode of all of them.   @param product  scratch
  void project_rotations(std::span<double> product) {
    set_size(work_.mode, position_.size());
    for (RigidGroup& g : groups_) g.matrix.bottomRightCorner<3, 3>().setZero();
    for (int axis = 0; axis < 3; ++axis) {
      for_each_own_number(s_, [&](std::size_t k) { work_.mode[k] = 0; });
      work_.sums.for_each_point([&](Address a, std::size_t g) {
        if (groups_[g].correct)
          store_point(work_.mode.data(), a, Vec3::Unit(axis).cross(at(a) - groups_[g].center));
      });
      op_.apply(work_.mode, product);
      work_.sums.sum<3>(
          [&](Address a, std::size_t g, std::array<double, 3>& sum) {
            const Vec3 turn = (at(a) - groups_[g].center).cross(load_point(product.data(), a));
            for (std::size_t k = 0; k < 3; ++k) sum[k] += turn[static_cast<int>(k)];
          },
          [&](std::size_t g, const std::array<double, 3>& sum) {
            groups_[g].matrix.block<3, 1>(3, 3 + axis) = Vec3(sum[0], sum[1], sum[2]);
          });
    }
  }

  /// Adds the rigid correction of the chosen groups to x. @return the largest move, um
  double correct(std::span<double> x) {
    double largest = 0;
    for (RigidGroup& g : groups_) {
      if (!g.correct) continue;
      g.motion = solve_spd(0.5 * (g.matrix + g.matrix.transpose()), g.residual);
      largest = std::max(largest, size_of(g.motion, g));
    }
    work_.sums.for_each_point([&](Address a, std::size_t g) {
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
  std::size_t block_of(Address a) const { return s_.block.block_of_row(a / kPointStride); }
  bool is_first_point(Address a) const { return a / kPointStride == s_.row_of(block_of(a)); }
  /// Adds the resistance of the boundary to the matrices of the groups.
  void add_ties() {
    compute_ties();
    if (!s_.ownership.ranks.any(!work_.tie.empty())) return;
    work_.sums.sum<kUpper>(
        [&](Address a, std::size_t, std::array<double, kUpper>& sum) {
          if (!is_first_point(a)) return;
          const int tie = work_.tie_of_cell[s_.lane_of(point_at(a))];
          if (tie < 0) return;
          for_each_upper(std::as_const(work_.tie[tie]),
                         [&](std::size_t n, double v, double) { sum[n] += v; });
        },
        [&](std::size_t g, const std::array<double, kUpper>& sum) {
          Mat6 tie;
          for_each_upper(
              tie, [&](std::size_t n, double& v, double& mirrored) { v = mirrored = sum[n]; });
          groups_[g].matrix += tie;
        });
  }
  /// Sums the resistance of the boundary to each cell, about the centre of its group, in the order
  /// of the contacts.
  void compute_ties() {
    work_.tie.clear();
    set_size(work_.tie_of_cell, work_.cells.of_cell.size());
    for (const auto& [first, last] : s_.own)
      std::fill_n(work_.tie_of_cell.data() + first * kLanes, (last - first) * kLanes, -1);
    op_.for_each_external([&](const Stencil& stencil, const auto& l) {
      const std::size_t cell = s_.lane_of(point_at(stencil.address[0]));
      const int g = work_.cells.of_cell[cell];
      if (g < 0) return;
      Vec3 place = Vec3::Zero();
      for (int k = 0; k < stencil.n; ++k) place += stencil.weight[k] * at(stencil.address[k]);
      const Map3x6 z = unit_motions(place - groups_[g].center);
      const Vec3 n = normal_of(l);
      const Mat3 m = s_.stiffness_scale * static_cast<double>(l.stiffness) * n * n.transpose() +
                     s_.friction_scale * static_cast<double>(l.friction) * Mat3::Identity();
      int& tie = work_.tie_of_cell[cell];
      if (tie < 0) {
        tie = static_cast<int>(work_.tie.size());
        work_.tie.push_back(Mat6::Zero());
      }
      work_.tie[tie] += z.transpose() * m * z;
    });
  }

  const Operator& op_;
  const System& s_;
  std::span<const double> position_;
  RigidWorkspace& work_;
  std::vector<RigidGroup>& groups_;
};

}  // namespace

RigidResult correct_rigid_modes(const Operator& op, const RigidVectors& vectors,
                                std::span<double> x, const RigidCells& cells, double threshold,
                                RigidWorkspace& work) {
  RigidModes modes(op, cells, work);
  modes.compute_bounds(vectors.residual);
  RigidResult result;
  result.corrected_groups = modes.choose(threshold);
  if (result.corrected_groups == 0) return result;
  modes.project_rotations(vectors.product);
  result.largest_move = modes.correct(x);
  return result;
}

}  // namespace acinus::solve
