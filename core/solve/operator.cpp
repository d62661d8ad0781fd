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
  for (int i = 0; i < n_point; ++i)
    s += dot(load3(g + i * kPointStride), load3(x + i * kPointStride));
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

/// x += alpha p, r -= alpha q, z = D^-1 r of one block; returns r . z.
ACINUS_KERNEL double descend_block(int n_point, double alpha, const double* inverse,
                                   const double* p, const double* q, double* x, double* r,
                                   double* z) {
  Lane s = lane_of(0);
  for (int i = 0; i < n_point; ++i) {
    const int at = i * kPointStride;
    Lane3 ri;
    ri.x = load(r + at) - alpha * load(q + at);
    ri.y = load(r + at + kLanes) - alpha * load(q + at + kLanes);
    ri.z = load(r + at + 2 * kLanes) - alpha * load(q + at + 2 * kLanes);
    for (int c = 0; c < kPointStride; c += kLanes)
      store(x + at + c, load(x + at + c) + alpha * load(p + at + c));
    store3(r + at, ri);
    const Lane3 zi = sym_times(inverse + i * kSymStride, ri);
    store3(z + at, zi);
    s += dot(ri, zi);
  }
  double sum = 0;
  for (int l = 0; l < kLanes; ++l) sum += s[l];
  return sum;
}

bool is_zero(const Sym3& m) {
  return m.xx == 0 && m.yy == 0 && m.zz == 0 && m.xy == 0 && m.xz == 0 && m.yz == 0;
}

}  // namespace

void Operator::prepare(const System& system) {
  system_ = &system;
  const Links& links = system.links;
  const std::size_t n_block = system.block.size();
  partial_.resize(n_block);
  packed_.resize(system.n_row * kLanes);

  link_.clear();
  entry_.clear();
  for (std::size_t l = 0; l < links.size(); ++l) {
    const Sym3 m = link_matrix(system, l);
    if (is_zero(m)) continue;
    const auto first = static_cast<std::uint32_t>(entry_.size());
    for (std::uint32_t k = links.start[l]; k < links.start[l + 1]; ++k) {
      const Address a = links.address[k];
      entry_.push_back({a / kPointStride * kLanes + a % kPointStride,
                        static_cast<std::uint32_t>(link_.size()), links.weight[k]});
    }
    link_.push_back({m, first, static_cast<std::uint32_t>(entry_.size()), links.external[l] != 0});
  }
  link_force_.resize(link_.size());

  // Counting sort of the entries by block.
  std::vector<std::uint32_t> block_of_row(system.n_row);
  for (std::size_t b = 0; b < n_block; ++b)
    std::fill_n(block_of_row.begin() + static_cast<std::ptrdiff_t>(system.block[b].first_row),
                system.block[b].pattern->n_point, static_cast<std::uint32_t>(b));
  block_start_.assign(n_block + 1, 0);
  for (const Entry& e : entry_) ++block_start_[block_of_row[e.point / kLanes] + 1];
  for (std::size_t b = 0; b < n_block; ++b) block_start_[b + 1] += block_start_[b];
  block_entry_.resize(entry_.size());
  std::vector<std::uint32_t> next(block_start_.begin(), block_start_.end() - 1);
  for (const Entry& e : entry_) block_entry_[next[block_of_row[e.point / kLanes]]++] = e;

  // Diagonal blocks of the whole matrix, inverted.
  inverse_ = system.diagonal;
#pragma omp parallel for schedule(static) if (parallel())
  for (std::size_t b = 0; b < n_block; ++b) {
    const Block& block = system.block[b];
    const int n = block.pattern->n_point;
    double* d = inverse_.data() + block.first_row * kSymStride;
    for (const RankOne& family : system.rank_one) {
      if (b * kLanes >= family.coefficient.size()) continue;
      const double* g = family.vector.data() + block.first_row * kPointStride;
      const Lane c = load(family.coefficient.data() + b * kLanes);
      for (int i = 0; i < n; ++i) add_outer_sym(d + i * kSymStride, c, load3(g + i * kPointStride));
    }
    for (std::uint32_t k = block_start_[b]; k < block_start_[b + 1]; ++k) {
      const Entry& e = block_entry_[k];
      const Sym3& m = link_[e.link].matrix;
      const double w2 = e.weight * e.weight;
      double* at = inverse_.data() + e.point / kLanes * kSymStride + e.point % kLanes;
      const double v[6] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
      for (int c = 0; c < 6; ++c) at[c * kLanes] += w2 * v[c];
    }
    invert_sym(n, d);
  }
}

void Operator::pack(std::span<const double> x) const {
#pragma omp parallel for schedule(static) if (parallel())
  for (std::size_t row = 0; row < system_->n_row; ++row) {
    const double* from = x.data() + row * kPointStride;
    Packed* to = packed_.data() + row * kLanes;
    for (int l = 0; l < kLanes; ++l) to[l] = {{from[l], from[l + kLanes], from[l + 2 * kLanes], 0}};
  }
}

void Operator::compute_link_forces(bool external_only) const {
#pragma omp parallel for schedule(static) if (parallel())
  for (std::size_t l = 0; l < link_.size(); ++l) {
    const Link& link = link_[l];
    if (external_only && !link.external) {
      link_force_[l] = {};
      continue;
    }
    double r[3] = {0, 0, 0};
    for (std::uint32_t k = link.first; k < link.last; ++k) {
      const Packed& p = packed_[entry_[k].point];
      for (int c = 0; c < 3; ++c) r[c] += entry_[k].weight * p.v[c];
    }
    const Vec3 f = link.matrix * Vec3(r[0], r[1], r[2]);
    link_force_[l] = {{f.x(), f.y(), f.z(), 0}};
  }
}

void Operator::gather_links(std::size_t b, std::span<double> y) const {
  for (std::uint32_t k = block_start_[b]; k < block_start_[b + 1]; ++k) {
    const Entry& e = block_entry_[k];
    const Packed& f = link_force_[e.link];
    double* at = y.data() + e.point / kLanes * kPointStride + e.point % kLanes;
    at[0] += e.weight * f.v[0];
    at[kLanes] += e.weight * f.v[1];
    at[2 * kLanes] += e.weight * f.v[2];
  }
}

double Operator::sum_partials() const {
  double sum = 0;
  for (double p : partial_) sum += p;
  return system_->halo.ranks.sum(sum);
}

double Operator::apply(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
  pack(x);
  compute_link_forces(false);
#pragma omp parallel for schedule(static) if (parallel())
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
    gather_links(b, y);
    partial_[b] = dot_range(xb, yb, static_cast<std::size_t>(pattern.n_point) * kPointStride);
  }
  return sum_partials();
}

void Operator::apply_external(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
  pack(x);
  compute_link_forces(true);
#pragma omp parallel for schedule(static) if (parallel())
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
    gather_links(b, y);
  }
}

void Operator::precondition(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
#pragma omp parallel for schedule(static) if (parallel())
  for (std::size_t b = 0; b < s.block.size(); ++b) {
    const std::size_t row = s.block[b].first_row;
    sym_times_all(s.block[b].pattern->n_point, inverse_.data() + row * kSymStride,
                  x.data() + row * kPointStride, y.data() + row * kPointStride);
  }
}

double Operator::descend(double alpha, std::span<const double> p, std::span<const double> q,
                         std::span<double> x, std::span<double> r, std::span<double> z) const {
  const System& s = *system_;
#pragma omp parallel for schedule(static) if (parallel())
  for (std::size_t b = 0; b < s.block.size(); ++b) {
    const std::size_t row = s.block[b].first_row, at = row * kPointStride;
    partial_[b] =
        descend_block(s.block[b].pattern->n_point, alpha, inverse_.data() + row * kSymStride,
                      p.data() + at, q.data() + at, x.data() + at, r.data() + at, z.data() + at);
  }
  return sum_partials();
}

void Operator::redirect(std::span<const double> z, double beta, std::span<double> p) const {
#pragma omp parallel for simd schedule(static) if (parallel())
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + beta * p[k];
}

void Operator::add_link_forces(std::span<double> pair_force,
                               std::span<double> external_force) const {
  const Links& links = system_->links;
  for (std::size_t l = 0; l < links.size(); ++l) {
    double* to = links.external[l] ? external_force.data() : pair_force.data();
    for (std::uint32_t k = links.start[l]; k < links.start[l + 1]; ++k)
      add_point(to, links.address[k], links.weight[k] * links.force[l]);
  }
}

double Operator::dot(std::span<const double> a, std::span<const double> b) const {
  const System& s = *system_;
#pragma omp parallel for schedule(static) if (parallel())
  for (std::size_t k = 0; k < s.block.size(); ++k) {
    const std::size_t from = s.block[k].first_row * kPointStride;
    partial_[k] = dot_range(a.data() + from, b.data() + from,
                            static_cast<std::size_t>(s.block[k].pattern->n_point) * kPointStride);
  }
  return sum_partials();
}

}  // namespace acinus::solve
