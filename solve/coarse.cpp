#include "solve/coarse.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel/threads.hpp"
#include "solve/kernels.hpp"
#include "solve/link_kernels.hpp"

namespace acinus::solve {
namespace {

/// First shift of the diagonal where a block of the incomplete factor is not positive, in parts of
/// that diagonal; doubled until all are.
constexpr double kFirstShift = 1e-3;

/// Restriction: sums of r and of arm x r over the points of a block, [6][lane].
template <class T>
ACINUS_INLINE void restrict_points(int n, const float* arm, const T* r, double* out) {
  Lane3Of<T> force = {}, torque = {};
  for (int i = 0; i < n; ++i) {
    const Lane3Of<T> ri = load3<T>(r + i * kPointStride);
    force = force + ri;
    torque = torque + cross(load3<T>(arm + i * kPointStride), ri);
  }
  store3(out, force);
  store3(out + 3 * kLanes, torque);
}
/// Prolongation: z += motion + turn x arm.
template <class T>
ACINUS_INLINE void prolong_points(int n, const float* arm, const double* in, T* z) {
  const Lane3Of<T> motion = load3<T>(in), turn = load3<T>(in + 3 * kLanes);
  for (int i = 0; i < n; ++i)
    add3(z + i * kPointStride, motion + cross(turn, load3<T>(arm + i * kPointStride)));
}

ACINUS_KERNEL void restrict_block(int n, const float* arm, const float* r, double* out) {
  restrict_points<float>(n, arm, r, out);
}
ACINUS_KERNEL void restrict_block(int n, const float* arm, const double* r, double* out) {
  restrict_points<double>(n, arm, r, out);
}
ACINUS_KERNEL void prolong_block(int n, const float* arm, const double* in, float* z) {
  prolong_points<float>(n, arm, in, z);
}
ACINUS_KERNEL void prolong_block(int n, const float* arm, const double* in, double* z) {
  prolong_points<double>(n, arm, in, z);
}

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

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
      : normal_(static_cast<double>(l.normal[0]), static_cast<double>(l.normal[1]),
                static_cast<double>(l.normal[2])),
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

/// Places of the two sides of a contact of surfaces, um.
struct SideEnds {
  std::span<const double> position;
  const Link& link;
  Vec3 a() const { return place(link.a); }
  Vec3 b() const { return place(link.b); }
  Vec3 place(const Side& side) const {
    const Vec3 last = load_point(position.data(), address_of(side.point[2]));
    const double w0 = static_cast<double>(side.weight[0]), w1 = static_cast<double>(side.weight[1]);
    return last + w0 * (load_point(position.data(), address_of(side.point[0])) - last) +
           w1 * (load_point(position.data(), address_of(side.point[1])) - last);
  }
};

/// Places of the two points of a contact of spheres, um.
struct PointEnds {
  std::span<const double> position;
  const PointLink& link;
  Vec3 a() const { return load_point(position.data(), address_of(link.a)); }
  Vec3 b() const { return load_point(position.data(), address_of(link.b)); }
};

}  // namespace

void CoarseSpace::place_cells(std::span<const double> position,
                              std::span<const std::uint8_t> active) {
  const System& s = *system_;
  cell_.assign(s.block.size() * kLanes, -1);
  set_size(arm_, s.n_dof());
  clear_own_rows(s, kPointStride, arm_);
  center_.clear();
  size_.clear();
  block_of_cell_.clear();
  for (std::size_t b = 0; b < s.block.size(); ++b) {
    const std::size_t row = s.block[b].first_row;
    const std::size_t n = s.block[b].pattern->n_point;
    for (int l = 0; l < kLanes; ++l) {
      if (!active[b * kLanes + l]) continue;
      cell_[b * kLanes + l] = static_cast<int>(center_.size());
      center_.emplace_back(Vec3::Zero());
      size_.push_back(0);
      block_of_cell_.push_back(b);
      if (!s.ownership.owns(b)) continue;
      Vec3 mean = Vec3::Zero();
      for (std::size_t i = row; i < row + n; ++i)
        mean += load_point(position.data(), make_address(i, l));
      mean /= static_cast<double>(n);
      double sum = 0;
      for (std::size_t i = row; i < row + n; ++i)
        sum += (load_point(position.data(), make_address(i, l)) - mean).squaredNorm();
      const double size = n > 1 ? std::sqrt(sum / static_cast<double>(n)) : 0;
      for (std::size_t i = row; size > 0 && i < row + n; ++i) {
        const Vec3 arm = (load_point(position.data(), make_address(i, l)) - mean) / size;
        for (int c = 0; c < 3; ++c)
          arm_[make_address(i, l) + static_cast<Address>(c * kLanes)] = static_cast<float>(arm[c]);
      }
      center_.back() = mean;
      size_.back() = size;
    }
  }
  gather_cells(center_);
  gather_cells(size_);
}

int CoarseSpace::cell_of(Point p) const {
  return cell_[system_->block_of(p) * kLanes + p % kLanes];
}

void CoarseSpace::make_pattern() {
  using CellPair = std::array<int, 2>;  // row and column
  std::vector<CellPair> pair;
  for (int c = 0; c < static_cast<int>(center_.size()); ++c) pair.push_back({c, c});
  auto join = [&](Point at_a, Point at_b) {
    if (at_b == kNowhere) return;
    const int a = cell_of(at_a), b = cell_of(at_b);
    const CellPair p{std::max(a, b), std::min(a, b)};
    if (p != pair.back()) pair.push_back(p);  // links come sorted by pair of cells
  };
  for (const Link& l : system_->links.link) join(l.a.point[0], l.b.point[0]);
  // Pairs of spheres are listed before they touch, some steps sooner or later.
  for (const PointLink& l : system_->point_links)
    if (has_matrix(l, system_->stiffness_scale)) join(l.a, l.b);
  if (!system_->ownership.is_whole()) {
    std::erase_if(pair, [&](const CellPair& p) { return !owns(p[0]); });
    const std::vector<CellPair> own = std::move(pair);
    system_->ownership.ranks.gather<CellPair>(own, pair);
  }
  std::ranges::sort(pair);
  const auto repeated = std::ranges::unique(pair);
  pair.erase(repeated.begin(), repeated.end());
  start_.assign(center_.size() + 1, 0);
  column_.clear();
  for (const auto& [row, column] : pair) {
    ++start_[row + 1];
    column_.push_back(column);
  }
  for (std::size_t c = 0; c < center_.size(); ++c) start_[c + 1] += start_[c];
  block_.assign(column_.size(), Mat6::Zero());
}

/// Gathers the rows of cells that other processes own.
void CoarseSpace::gather_rows() {
  const Ownership& ownership = system_->ownership;
  if (ownership.is_whole()) return;
  std::vector<Mat6> own, all;
  for (std::size_t c = 0; c < center_.size(); ++c)
    if (owns(static_cast<int>(c)))
      for (int e = start_[c]; e < start_[c + 1]; ++e) own.push_back(block_[e]);
  gather_in_order(
      ownership.ranks, center_.size(),
      [&](std::size_t c) { return ownership.owner[block_of_cell_[c]]; },
      [&](std::size_t c) -> std::size_t { return start_[c + 1] - start_[c]; }, own, all);
  block_ = std::move(all);
}

/// Gathers the values of cells that other processes own.
template <class T>
void CoarseSpace::gather_cells(std::vector<T>& v) const {
  const Ownership& ownership = system_->ownership;
  if (ownership.is_whole()) return;
  std::vector<T> own, all;
  for (std::size_t c = 0; c < v.size(); ++c)
    if (owns(static_cast<int>(c))) own.push_back(v[c]);
  gather_in_order(
      ownership.ranks, v.size(), [&](std::size_t c) { return ownership.owner[block_of_cell_[c]]; },
      [](std::size_t) { return std::size_t{1}; }, own, all);
  v = std::move(all);
}

/// Adds the resistance of single cells to their six motions: medium, and dashpots or strain against
/// rotation.
void CoarseSpace::add_cells(const Operator& op) {
  const System& s = *system_;
  RowVector<double> mode(s.n_dof()), product(s.n_dof());
  for (int m = 0; m < 6; ++m) {
    double unit[6 * kLanes] = {};
    for (int l = 0; l < kLanes; ++l) unit[m * kLanes + l] = 1;
    clear_own_rows(s, kPointStride, mode);
    for (std::size_t k = 0; k < s.block.size(); ++k) {
      if (!s.ownership.owns(k)) continue;
      const Block& b = s.block[k];
      prolong_block(b.pattern->n_point, arm_.data() + b.first_row * kPointStride, unit,
                    mode.data() + b.first_row * kPointStride);
    }
    op.apply_within(mode, product);
    for (std::size_t b = 0; b < s.block.size(); ++b) {
      if (!s.ownership.owns(b)) continue;
      double out[6 * kLanes];
      restrict_block(s.block[b].pattern->n_point, arm_.data() + s.block[b].first_row * kPointStride,
                     product.data() + s.block[b].first_row * kPointStride, out);
      for (std::size_t l = 0; l < kLanes; ++l) {
        const int c = cell_[b * kLanes + l];
        if (c < 0) continue;
        Mat6& e = block_[start_[c + 1] - 1];
        for (int k = 0; k < 6; ++k) e(k, m) = out[k * kLanes + l];
      }
    }
  }
  for (std::size_t c = 0; c < center_.size(); ++c) {
    Mat6& e = block_[start_[c + 1] - 1];
    if (size_[c] == 0) e.bottomRightCorner<3, 3>().setIdentity();
    e = (0.5 * (e + e.transpose())).eval();
  }
}

Vec3 CoarseSpace::arm_of(std::size_t cell, const Vec3& place) const {
  return size_[cell] > 0 ? Vec3((place - center_[cell]) / size_[cell]) : Vec3::Zero();
}

std::size_t CoarseSpace::entry_of(int a, int b) const {
  const int row = std::max(a, b);
  const auto from = column_.begin() + start_[row], to = column_.begin() + start_[row + 1];
  return std::lower_bound(from, to, std::min(a, b)) - column_.begin();
}

template <class L, class Ends>
void CoarseSpace::add_link(const RowShare& share, int a, int b, const Ends& ends, const L& link) {
  const bool owns_a = share.owns(a), owns_b = b >= 0 && share.owns(b);
  if (!owns_a && !owns_b) return;
  const LinkResponse response(*system_, link);
  if (response.is_zero()) return;
  const Vec3 p = arm_of(a, ends.a());
  if (owns_a) block_[entry_of(a, a)] += response.matrix(p, p);
  if (b < 0) return;
  const Vec3 q = arm_of(b, ends.b());
  if (owns_b) block_[entry_of(b, b)] += response.matrix(q, q);
  if (a == b)
    block_[entry_of(a, a)] -= response.matrix(p, q) + response.matrix(q, p);
  else if (share.owns(std::max(a, b)))
    block_[entry_of(a, b)] -= a > b ? response.matrix(p, q) : response.matrix(q, p);
}

void CoarseSpace::add_links(std::span<const double> position) {
  const System& s = *system_;
  // Every part passes over all links and adds to the rows of its own cells, in their order.
  const std::size_t n_part = std::min(count_threads(s.n_row), center_.size());
  for_each_part(n_part, [&](std::size_t part) {
    const RowShare share{part, n_part};
    for (const Link& l : s.links.link)
      add_link(share, cell_of(l.a.point[0]), l.b.exists() ? cell_of(l.b.point[0]) : -1,
               SideEnds{position, l}, l);
    for (const PointLink& l : s.point_links)
      add_link(share, cell_of(l.a), l.b != kNowhere ? cell_of(l.b) : -1, PointEnds{position, l}, l);
  });
}

/// Factors E ~ L L^T by incomplete block Cholesky with the pattern of E.
void CoarseSpace::factor() {
  const std::vector<Mat6> matrix = block_;
  for (double shift = 0;; shift = shift > 0 ? 2 * shift : kFirstShift) {
    bool positive = true;
    for (std::size_t i = 0; i < center_.size() && positive; ++i) {
      const std::size_t from = start_[i], diagonal = start_[i + 1] - 1;
      for (std::size_t e = from; e <= diagonal; ++e) {
        const std::size_t j = column_[e];
        Mat6 sum = matrix[e];
        if (e == diagonal) sum.diagonal() *= 1 + shift;
        std::size_t p = from, q = start_[j];
        const std::size_t q_end = start_[j + 1] - 1;
        while (p < e && q < q_end) {
          if (column_[p] == column_[q])
            sum.noalias() -= block_[p++] * block_[q++].transpose();
          else if (column_[p] < column_[q])
            ++p;
          else
            ++q;
        }
        if (e == diagonal) {
          const Eigen::LLT<Mat6> llt(sum);
          positive = llt.info() == Eigen::Success && llt.matrixLLT().diagonal().minCoeff() > 0;
          block_[e] = llt.matrixL();
        } else {
          // X L_jj^T = sum
          const Mat6& l = block_[start_[j + 1] - 1];
          block_[e] = l.triangularView<Eigen::Lower>().solve(sum.transpose()).transpose();
        }
      }
    }
    if (positive) return;
  }
}

void CoarseSpace::solve(std::vector<Vec6>& v) const {
  const std::size_t n = center_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t diagonal = start_[i + 1] - 1;
    for (std::size_t e = start_[i]; e < diagonal; ++e) v[i].noalias() -= block_[e] * v[column_[e]];
    block_[diagonal].triangularView<Eigen::Lower>().solveInPlace(v[i]);
  }
  for (std::size_t i = n; i-- > 0;) {
    const std::size_t diagonal = start_[i + 1] - 1;
    block_[diagonal].triangularView<Eigen::Lower>().transpose().solveInPlace(v[i]);
    for (std::size_t e = start_[i]; e < diagonal; ++e)
      v[column_[e]].noalias() -= block_[e].transpose() * v[i];
  }
}

void CoarseSpace::prepare(const Operator& op, std::span<const double> position,
                          std::span<const std::uint8_t> active) {
  system_ = &op.system();
  place_cells(position, active);
  if (center_.empty()) return;
  make_pattern();
  add_cells(op);
  add_links(position);
  gather_rows();
  factor();
}

template <class T>
double CoarseSpace::add_of(std::span<const T> r, std::span<T> z) const {
  const System& s = *system_;
  small_.resize(center_.size());
  const std::size_t n_block = s.block.size();
  const bool shared = worth_threads(s.n_row);
  for_each_index(n_block, shared, [&](std::size_t b) {
    if (!s.ownership.owns(b)) return;
    const std::size_t at = s.block[b].first_row * kPointStride;
    double out[6 * kLanes];
    restrict_block(s.block[b].pattern->n_point, arm_.data() + at, r.data() + at, out);
    for (std::size_t l = 0; l < kLanes; ++l)
      if (const int c = cell_[b * kLanes + l]; c >= 0)
        for (int m = 0; m < 6; ++m) small_[c][m] = out[m * kLanes + l];
  });
  gather_cells(small_);
  double product = 0;
  const std::vector<Vec6> load = small_;
  solve(small_);
  for (std::size_t c = 0; c < load.size(); ++c) product += load[c].dot(small_[c]);
  for_each_index(n_block, shared, [&](std::size_t b) {
    if (!s.ownership.owns(b)) return;
    const std::size_t at = s.block[b].first_row * kPointStride;
    double in[6 * kLanes] = {};
    for (std::size_t l = 0; l < kLanes; ++l)
      if (const int c = cell_[b * kLanes + l]; c >= 0)
        for (int m = 0; m < 6; ++m) in[m * kLanes + l] = small_[c][m];
    prolong_block(s.block[b].pattern->n_point, arm_.data() + at, in, z.data() + at);
  });
  return product;
}

double CoarseSpace::add(std::span<const float> r, std::span<float> z) const {
  return add_of<float>(r, z);
}
double CoarseSpace::add(std::span<const double> r, std::span<double> z) const {
  return add_of<double>(r, z);
}

}  // namespace acinus::solve
