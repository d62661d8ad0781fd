#include "solve/coarse_matrix.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel/threads.hpp"
#include "core/sort_unique.hpp"
#include "solve/coarse_kernels.hpp"
#include "solve/kernels.hpp"
#include "solve/link_kernels.hpp"

namespace acinus::solve {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Response of a contact to rigid motions of its two cells.
class LinkResponse {
 public:
  template <class L>
  LinkResponse(const System& s, const L& l)
      : normal_(normal_of(l)),
        stiffness_(s.stiffness_scale * static_cast<double>(l.stiffness)),
        friction_(s.friction_scale * static_cast<double>(l.friction)) {}

  bool is_zero() const { return stiffness_ == 0 && friction_ == 0; }
  /// Block J_p^T (k n n^T + g I) J_q with J = [I, -arm x]. @param p, q  arms of the two places
  Mat6 matrix(const Vec3& p, const Vec3& q) const {
    Vec6 u, v;
    u << normal_, p.cross(normal_);
    v << normal_, q.cross(normal_);
    Mat6 m = stiffness_ * u * v.transpose();
    m.topLeftCorner<3, 3>() += friction_ * Mat3::Identity();
    m.bottomLeftCorner<3, 3>() += friction_ * cross_matrix(p);
    m.topRightCorner<3, 3>() -= friction_ * cross_matrix(q);
    m.bottomRightCorner<3, 3>() -= friction_ * cross_matrix(p) * cross_matrix(q);
    return m;
  }

 private:
  Vec3 normal_;
  double stiffness_, friction_;
};

/// Place of a side of a contact of surfaces, um.
Vec3 place_of(std::span<const double> position, const Side& side) {
  const Vec3 last = load_point(position.data(), address_of(side.point[2]));
  const double w0 = static_cast<double>(side.weight[0]), w1 = static_cast<double>(side.weight[1]);
  return last + w0 * (load_point(position.data(), address_of(side.point[0])) - last) +
         w1 * (load_point(position.data(), address_of(side.point[1])) - last);
}
Vec3 place_of(std::span<const double> position, Point p) {
  return load_point(position.data(), address_of(p));
}

Point point_of(const Side& side) { return side.point[0]; }
Point point_of(Point p) { return p; }

/// Calls f(link) for the contacts between surfaces, then for those between single points.
template <class F>
void for_each_link(const System& s, const F& f) {
  for (const Link& l : s.links.link) f(l);
  // Pairs of spheres are listed before they touch, some steps sooner or later.
  for (const PointLink& l : s.point_links)
    if (has_matrix(l, s.stiffness_scale)) f(l);
}

}  // namespace

void CoarseMatrix::number_cells(std::span<const std::uint8_t> active) {
  number_ = make_zeros<std::uint32_t>(system_->block.size() * kLanes);
  lane_.clear();
  for (const auto& [first, last] : system_->own)
    for (std::size_t lane = first * kLanes; lane < last * kLanes; ++lane) {
      if (active[lane] == 0) continue;
      lane_.push_back(static_cast<LaneIndex>(lane));
      number_[lane] = static_cast<std::uint32_t>(lane_.size());
    }
  n_own_ = lane_.size();
}

void CoarseMatrix::place_cells(std::span<const double> position) {
  const System& s = *system_;
  set_size(arm_, s.n_dof());
  clear_own_rows(s, kPointStride, arm_);
  center_.assign(n_own_, Vec3::Zero());
  size_.assign(n_own_, 0);
  for_each_index(n_own_, worth_threads(s.n_row), [&](std::size_t c) {
    const int l = static_cast<int>(lane_[c] % kLanes);
    const Block& b = s.block[lane_[c] / kLanes];
    const std::size_t n = b.pattern->n_point;
    const auto point = [&](std::size_t i) {
      return load_point(position.data(), make_address(b.first_row + i, l));
    };
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < n; ++i) mean += point(i);
    mean /= static_cast<double>(n);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += (point(i) - mean).squaredNorm();
    const double size = n > 1 ? std::sqrt(sum / static_cast<double>(n)) : 0;
    for (std::size_t i = 0; size > 0 && i < n; ++i) {
      const Vec3 arm = (point(i) - mean) / size;
      for (int k = 0; k < 3; ++k)
        arm_[make_address(b.first_row + i, l) + static_cast<Address>(k * kLanes)] =
            static_cast<float>(arm[k]);
    }
    center_[c] = mean;
    size_[c] = size;
  });
}

/// Lists the pairs of cells in contact, and the cells of other processes among them. Both processes
/// of a contact know it, so each knows what the other one needs.
void CoarseMatrix::join_cells(std::span<const std::uint8_t> active) {
  using LanePair = std::array<LaneIndex, 2>;
  std::vector<LanePair> pair;  // row and column
  std::vector<BorderPair> across;
  LanePair last{};
  const auto join = [&](LaneIndex row, LaneIndex column) {
    if (!owns(row)) return;
    pair.push_back({row, column});
    if (!owns(column)) across.push_back({row, column});
  };
  for_each_link(*system_, [&](const auto& l) {
    const Point at_b = point_of(l.b);
    if (at_b == kNowhere) return;
    const LanePair ends{system_->lane_of(point_of(l.a)), system_->lane_of(at_b)};
    if (ends == last || ends[0] == ends[1] || active[ends[0]] == 0 || active[ends[1]] == 0) return;
    last = ends;  // links come sorted by pair of cells
    join(ends[0], ends[1]);
    join(ends[1], ends[0]);
  });
  sort_unique(pair);
  BorderExchange border = plan_border_exchange(system_->ownership, across);
  plan_ = std::move(border.plan);
  send_.clear();
  for (const LaneIndex lane : border.send)
    send_.push_back(static_cast<std::uint32_t>(number_of(lane)));
  for (const LaneIndex lane : border.receive) {
    lane_.push_back(lane);
    number_[lane] = static_cast<std::uint32_t>(lane_.size());
  }

  start_.assign(n_own_ + 1, 0);
  column_.clear();
  for (const auto& [row, column] : pair) {
    ++start_[number_of(row) + 1];
    column_.push_back(static_cast<std::uint32_t>(number_of(column)));
  }
  for (std::size_t c = 0; c < n_own_; ++c) start_[c + 1] += start_[c];
  block_.assign(column_.size(), Entry::Zero());
}

template <class T>
void CoarseMatrix::fetch_cells(std::vector<T>& x) const {
  if (plan_.empty()) return;
  std::vector<T> out;
  for (const std::uint32_t c : send_) out.push_back(x[c]);
  x.resize(n_cell());
  system_->ownership.ranks.exchange<T>(plan_, out, std::span(x).subspan(n_own_));
}

/// Adds the resistance of single cells to their six motions: medium, and dashpots or strain against
/// rotation.
void CoarseMatrix::add_cells(const Operator& op, const CoarseInput& in) {
  const System& s = *system_;
  std::vector<Mat6> resistance(n_own_);
  for (auto* v : {&in.mode, &in.product}) set_size(*v, s.n_dof());
  for (int m = 0; m < 6; ++m) {
    double unit[6 * kLanes] = {};
    for (int l = 0; l < kLanes; ++l) unit[m * kLanes + l] = 1;
    clear_own_rows(s, kPointStride, in.mode);
    for (const auto& [first, last] : s.own)
      for (std::size_t b = first; b < last; ++b) {
        const std::size_t at = s.block[b].first_row * kPointStride;
        prolong_block(s.block[b].pattern->n_point, arm_.data() + at, unit, in.mode.data() + at);
      }
    op.apply_within(in.mode, in.product);
    for (const auto& [first, last] : s.own)
      for (std::size_t b = first; b < last; ++b) {
        const std::size_t at = s.block[b].first_row * kPointStride;
        double out[6 * kLanes];
        restrict_block(s.block[b].pattern->n_point, arm_.data() + at, in.product.data() + at, out);
        for (std::size_t l = 0; l < kLanes; ++l)
          if (const std::uint32_t c = number_[b * kLanes + l]; c != 0)
            for (int k = 0; k < 6; ++k) resistance[c - 1](k, m) = out[k * kLanes + l];
      }
  }
  diagonal_.resize(n_own_);
  for (std::size_t c = 0; c < n_own_; ++c) {
    Mat6& e = resistance[c];
    if (size_[c] == 0) e.bottomRightCorner<3, 3>().setIdentity();
    diagonal_[c] = (0.5 * (e + e.transpose())).cast<float>();
  }
}

Vec3 CoarseMatrix::arm_of(std::size_t cell, const Vec3& place) const {
  return size_[cell] > 0 ? Vec3((place - center_[cell]) / size_[cell]) : Vec3::Zero();
}

CoarseMatrix::Entry& CoarseMatrix::entry_of(std::size_t row, LaneIndex column) {
  const auto from = column_.begin() + static_cast<std::ptrdiff_t>(start_[row]),
             to = column_.begin() + static_cast<std::ptrdiff_t>(start_[row + 1]);
  const auto at =
      std::ranges::lower_bound(from, to, column, {}, [&](std::uint32_t c) { return lane_[c]; });
  return block_[static_cast<std::size_t>(at - column_.begin())];
}

void CoarseMatrix::add_links(const CoarseInput& in) {
  const System& s = *system_;
  // Every part passes over all links and adds to the rows of its own cells, in their order.
  const std::size_t n_part = std::max<std::size_t>(1, std::min(count_threads(s.n_row), n_own_));
  for_each_part(n_part, [&](std::size_t part) {
    const auto adds_to = [&](LaneIndex lane) {
      return owns(lane) && number_of(lane) % n_part == part;
    };
    for_each_link(s, [&](const auto& l) {
      const LaneIndex a = s.lane_of(point_of(l.a));
      const Point at_b = point_of(l.b);
      std::optional<LaneIndex> b;
      if (at_b != kNowhere && in.active[s.lane_of(at_b)] != 0) b = s.lane_of(at_b);
      const bool to_a = in.active[a] != 0 && adds_to(a), to_b = b && adds_to(*b);
      if (!to_a && !to_b) return;
      const LinkResponse response(s, l);
      if (response.is_zero()) return;
      const Vec3 p = in.active[a] != 0 ? arm_of(number_of(a), place_of(in.position, l.a)) : Vec3();
      const Vec3 q = b ? arm_of(number_of(*b), place_of(in.position, l.b)) : Vec3();
      if (to_a) diagonal_[number_of(a)] += response.matrix(p, p).template cast<float>();
      if (to_b) diagonal_[number_of(*b)] += response.matrix(q, q).template cast<float>();
      if (!b || in.active[a] == 0) return;
      if (a == *b) {
        const Mat6 both = response.matrix(p, q) + response.matrix(q, p);
        diagonal_[number_of(a)] -= both.template cast<float>();
        return;
      }
      const Entry upper =  // of the lower lane's row
          (a < *b ? response.matrix(p, q) : response.matrix(q, p)).template cast<float>();
      if (to_a) entry_of(number_of(a), *b) -= a < *b ? upper : Entry(upper.transpose());
      if (to_b) entry_of(number_of(*b), a) -= a < *b ? Entry(upper.transpose()) : upper;
    });
  });
}

/// Inverts the diagonal entries. A cell without resistance is left out of the coarse space.
void CoarseMatrix::invert_diagonals() {
  inverse_.resize(n_own_);
  for_each_index(n_own_, worth_threads(system_->n_row), [&](std::size_t c) {
    Mat6 e = diagonal_[c].cast<double>();
    e = (0.5 * (e + e.transpose())).eval();
    diagonal_[c] = e.cast<float>();
    e.diagonal() *= 1 + kRegularise;
    const Eigen::LLT<Mat6> llt(e);
    inverse_[c].setZero();
    if (llt.info() != Eigen::Success || !(llt.matrixLLT().diagonal().minCoeff() > 0)) return;
    const Mat6 inverse = llt.solve(Mat6::Identity());
    inverse_[c] = (0.5 * (inverse + inverse.transpose())).cast<float>();
  });
}

void CoarseMatrix::assemble(const Operator& op, const CoarseInput& in) {
  system_ = &op.system();
  number_cells(in.active);
  place_cells(in.position);
  join_cells(in.active);
  fetch_cells(center_);
  fetch_cells(size_);
  add_cells(op, in);
  add_links(in);
  invert_diagonals();
}

CoarseMatrix::Vec6 CoarseMatrix::multiply(std::size_t cell, const std::vector<Vec6>& x) const {
  Vec6 y = diagonal_[cell].cast<double>() * x[cell];
  for (std::size_t e = start_[cell]; e < start_[cell + 1]; ++e)
    y.noalias() += block_[e].cast<double>() * x[column_[e]];
  return y;
}

CoarseMatrix::Vec6 CoarseMatrix::invert_diagonal(std::size_t cell, const Vec6& x) const {
  return inverse_[cell].cast<double>() * x;
}

void CoarseMatrix::fetch(std::vector<Vec6>& x) const { fetch_cells(x); }

std::size_t CoarseMatrix::memory() const {
  return memory_of(number_) + memory_of(lane_) + memory_of(center_) + memory_of(size_) +
         memory_of(diagonal_) + memory_of(inverse_) + memory_of(start_) + memory_of(column_) +
         memory_of(block_) + memory_of(send_);
}

}  // namespace acinus::solve
