#include "core/solve/operator.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace acinus::solve {
namespace {

ACINUS_INLINE Lane3 sym_times(const double* d, const Lane3& v) {
  const Lane xy = load(d + kLanes), xz = load(d + 2 * kLanes), yz = load(d + 4 * kLanes);
  return {load(d) * v.x + xy * v.y + xz * v.z, xy * v.x + load(d + 3 * kLanes) * v.y + yz * v.z,
          xz * v.x + yz * v.y + load(d + 5 * kLanes) * v.z};
}

ACINUS_INLINE void store3(double* p, const Lane3& v) {
  store(p, v.x);
  store(p + kLanes, v.y);
  store(p + 2 * kLanes, v.z);
}

/// y = (diagonal + upper + upper^T) x of one block.
ACINUS_KERNEL void block_times(int n_point, const std::array<int, 2>* pair, std::size_t n_pair,
                               const double* diagonal, const double* upper, const double* x,
                               double* y) {
  for (int i = 0; i < n_point; ++i)
    store3(y + i * kPointStride, sym_times(diagonal + i * kSymStride, load3(x + i * kPointStride)));
  for (std::size_t p = 0; p < n_pair; ++p) {
    const double* b = upper + p * kMatStride;
    const int i = pair[p][0] * kPointStride, j = pair[p][1] * kPointStride;
    const Lane3 xi = load3(x + i), xj = load3(x + j);
    const Lane b0 = load(b), b1 = load(b + kLanes), b2 = load(b + 2 * kLanes);
    const Lane b3 = load(b + 3 * kLanes), b4 = load(b + 4 * kLanes), b5 = load(b + 5 * kLanes);
    const Lane b6 = load(b + 6 * kLanes), b7 = load(b + 7 * kLanes), b8 = load(b + 8 * kLanes);
    add3(y + i, {b0 * xj.x + b1 * xj.y + b2 * xj.z, b3 * xj.x + b4 * xj.y + b5 * xj.z,
                 b6 * xj.x + b7 * xj.y + b8 * xj.z});
    add3(y + j, {b0 * xi.x + b3 * xi.y + b6 * xi.z, b1 * xi.x + b4 * xi.y + b7 * xi.z,
                 b2 * xi.x + b5 * xi.y + b8 * xi.z});
  }
}

/// y += c g (g . x) of one block.
ACINUS_KERNEL void add_rank_one(int n_point, const double* g, const double* coefficient,
                                const double* x, double* y) {
  Lane s = lane_of(0);
  for (int i = 0; i < n_point; ++i) s += dot(load3(g + i * kPointStride), load3(x + i * kPointStride));
  s *= load(coefficient);
  for (int i = 0; i < n_point; ++i) add3(y + i * kPointStride, s * load3(g + i * kPointStride));
}

ACINUS_KERNEL void sym_times_all(int n_point, const double* d, const double* x, double* y) {
  for (int i = 0; i < n_point; ++i)
    store3(y + i * kPointStride, sym_times(d + i * kSymStride, load3(x + i * kPointStride)));
}

ACINUS_KERNEL double dot_range(const double* a, const double* b, std::size_t n) {
  Lane s = lane_of(0);
  for (std::size_t k = 0; k < n; k += kLanes) s += load(a + k) * load(b + k);
  double sum = 0;
  for (int l = 0; l < kLanes; ++l) sum += s[l];
  return sum;
}

/// Inverts n symmetric blocks in place, lane by lane.
ACINUS_KERNEL void invert_sym(int n_point, double* d) {
  for (int i = 0; i < n_point; ++i, d += kSymStride) {
    const Lane xx = load(d), xy = load(d + kLanes), xz = load(d + 2 * kLanes);
    const Lane yy = load(d + 3 * kLanes), yz = load(d + 4 * kLanes), zz = load(d + 5 * kLanes);
    const Lane cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
    const Lane r = 1.0 / (xx * cxx + xy * cxy + xz * cxz);
    store(d, cxx * r);
    store(d + kLanes, cxy * r);
    store(d + 2 * kLanes, cxz * r);
    store(d + 3 * kLanes, (xx * zz - xz * xz) * r);
    store(d + 4 * kLanes, (xy * xz - xx * yz) * r);
    store(d + 5 * kLanes, (xx * yy - xy * xy) * r);
  }
}

}  // namespace

void Operator::prepare(const System& system) {
  system_ = &system;
  const Links& links = system.links;
  const std::size_t n_block = system.block.size();

  link_matrix_.resize(links.size());
  link_force_.resize(links.size());
  entry_link_.resize(links.address.size());
  partial_.resize(n_block);
  for (std::size_t l = 0; l < links.size(); ++l) {
    link_matrix_[l] = link_matrix(system, l);
    for (std::uint32_t k = links.start[l]; k < links.start[l + 1]; ++k)
      entry_link_[k] = static_cast<std::uint32_t>(l);
  }

  // Counting sort of the entries by block.
  std::vector<std::uint32_t>& start = entry_start_;
  start.assign(n_block + 1, 0);
  std::vector<std::uint32_t> block_of_row(system.n_row);
  for (std::size_t b = 0; b < n_block; ++b)
    std::fill_n(block_of_row.begin() + static_cast<std::ptrdiff_t>(system.block[b].first_row),
                system.block[b].pattern->n_point, static_cast<std::uint32_t>(b));
  for (Address a : links.address) ++start[block_of_row[a / kPointStride] + 1];
  for (std::size_t b = 0; b < n_block; ++b) start[b + 1] += start[b];
  entry_.resize(links.address.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t k = 0; k < links.address.size(); ++k)
    entry_[next[block_of_row[links.address[k] / kPointStride]]++] = k;

  // Diagonal blocks of the whole matrix, inverted.
  inverse_ = system.diagonal;
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < n_block; ++b) {
    const Block& block = system.block[b];
    const int n = block.pattern->n_point;
    double* d = inverse_.data() + block.first_row * kSymStride;
    for (const RankOne& family : system.rank_one) {
      if (b * kLanes >= family.coefficient.size()) continue;
      const double* g = family.vector.data() + block.first_row * kPointStride;
      const Lane c = load(family.coefficient.data() + b * kLanes);
      for (int i = 0; i < n; ++i)
        add_outer_sym(d + i * kSymStride, c, load3(g + i * kPointStride));
    }
    for (std::uint32_t e = start[b]; e < start[b + 1]; ++e) {
      const std::uint32_t k = entry_[e];
      const Address a = links.address[k];
      const Sym3& m = link_matrix_[entry_link_[k]];
      const double w2 = links.weight[k] * links.weight[k];
      double* at = inverse_.data() + (a / kPointStride) * kSymStride + a % kPointStride;
      const double v[6] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
      for (int c = 0; c < 6; ++c) at[c * kLanes] += w2 * v[c];
    }
    invert_sym(n, d);
  }
}

void Operator::compute_link_forces(std::span<const double> x, bool external_only) const {
  const Links& links = system_->links;
#pragma omp parallel for schedule(static)
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (external_only && !links.external[l]) {
      link_force_[l].setZero();
      continue;
    }
    Vec3 r = Vec3::Zero();
    for (std::uint32_t k = links.start[l]; k < links.start[l + 1]; ++k)
      r += links.weight[k] * load_point(x.data(), links.address[k]);
    link_force_[l] = link_matrix_[l] * r;
  }
}

void Operator::apply(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
  compute_link_forces(x, false);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < s.block.size(); ++b) {
    const Block& block = s.block[b];
    const BlockPattern& pattern = *block.pattern;
    const double* xb = x.data() + block.first_row * kPointStride;
    double* yb = y.data() + block.first_row * kPointStride;
    block_times(pattern.n_point, pattern.pair.data(), pattern.pair.size(),
                s.diagonal.data() + block.first_row * kSymStride,
                s.upper.data() + block.first_pair * kMatStride, xb, yb);
    for (const RankOne& family : s.rank_one)
      if (b * kLanes < family.coefficient.size())
        add_rank_one(pattern.n_point, family.vector.data() + block.first_row * kPointStride,
                     family.coefficient.data() + b * kLanes, xb, yb);
    for (std::uint32_t e = entry_start_[b]; e < entry_start_[b + 1]; ++e) {
      const std::uint32_t k = entry_[e];
      add_point(y.data(), s.links.address[k], s.links.weight[k] * link_force_[entry_link_[k]]);
    }
  }
}

void Operator::apply_external(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
  compute_link_forces(x, true);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < s.block.size(); ++b) {
    const Block& block = s.block[b];
    for (int i = 0; i < block.pattern->n_point; ++i) {
      const std::size_t row = block.first_row + static_cast<std::size_t>(i);
      for (int c = 0; c < 3; ++c)
        for (int l = 0; l < kLanes; ++l) {
          const std::size_t at = row * kPointStride + static_cast<std::size_t>(c * kLanes + l);
          y[at] = s.friction_scale * s.medium[row * kLanes + static_cast<std::size_t>(l)] * x[at];
        }
    }
    for (std::uint32_t e = entry_start_[b]; e < entry_start_[b + 1]; ++e) {
      const std::uint32_t k = entry_[e];
      if (s.links.external[entry_link_[k]])
        add_point(y.data(), s.links.address[k], s.links.weight[k] * link_force_[entry_link_[k]]);
    }
  }
}

void Operator::precondition(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < s.block.size(); ++b) {
    const std::size_t row = s.block[b].first_row;
    sym_times_all(s.block[b].pattern->n_point, inverse_.data() + row * kSymStride,
                  x.data() + row * kPointStride, y.data() + row * kPointStride);
  }
}

void Operator::add_link_forces(std::span<double> pair_force,
                               std::span<double> external_force) const {
  const Links& links = system_->links;
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < system_->block.size(); ++b)
    for (std::uint32_t e = entry_start_[b]; e < entry_start_[b + 1]; ++e) {
      const std::uint32_t k = entry_[e];
      const std::uint32_t l = entry_link_[k];
      double* to = links.external[l] ? external_force.data() : pair_force.data();
      add_point(to, links.address[k], links.weight[k] * links.force[l]);
    }
}

double Operator::dot(std::span<const double> a, std::span<const double> b) const {
  const System& s = *system_;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < s.block.size(); ++k) {
    const std::size_t from = s.block[k].first_row * kPointStride;
    partial_[k] = dot_range(a.data() + from, b.data() + from,
                            static_cast<std::size_t>(s.block[k].pattern->n_point) * kPointStride);
  }
  double sum = 0;
  for (double p : partial_) sum += p;
  return s.halo.ranks.sum(sum);
}

}  // namespace acinus::solve
