#include "substances/multigrid.hpp"

#include <algorithm>

#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

/// Sweeps before and after the correction, on the finest level and on coarser ones, where they cost
/// little.
constexpr int kFinestSweeps = 1, kCoarserSweeps = 2;

/// Shares of a voxel in the coarse voxel that holds it and in the next one.
constexpr float kNear = 0.75F, kFar = 0.25F;

Transfer make_transfer(int n, bool coarsens) {
  Transfer t;
  const int n_coarse = coarsens ? (n + 1) / 2 : n;
  t.coarse.resize(static_cast<std::size_t>(n_coarse));
  for (int i = 0; i < n; ++i) {
    Transfer::Parents p{i, i, 1, 0};
    if (coarsens) {
      p.near = p.far = i / 2;
      const int far = i % 2 == 0 ? p.near - 1 : p.near + 1;
      if (far >= 0 && far < n_coarse) p = {i / 2, far, kNear, kFar};
    }
    t.fine.push_back(p);
    t.coarse[p.near].emplace_back(i, p.near_share);
    if (p.far_share > 0) t.coarse[p.far].emplace_back(i, p.far_share);
  }
  return t;
}

std::vector<double> join_widths(const std::vector<double>& fine, bool coarsens) {
  if (!coarsens) return fine;
  std::vector<double> width;
  for (std::size_t i = 0; i < fine.size(); i += 2)
    width.push_back(fine[i] + (i + 1 < fine.size() ? fine[i + 1] : 0));
  return width;
}

/// Sums of the diagonal of the voxels in each coarse voxel.
/// @param n, m  voxels of the fine and of the coarse grid
std::vector<double> join_own(std::span<const double> fine, const std::array<int, 3>& n,
                             const std::array<int, 3>& m) {
  const auto parent = [&](int axis, int i) { return n[axis] == m[axis] ? i : i / 2; };
  const auto row = [](const std::array<int, 3>& size, int j, int k) {
    return static_cast<std::size_t>(size[0]) * (static_cast<std::size_t>(k) * size[1] + j);
  };
  std::vector<double> own(row(m, 0, m[2]), 0.0);
  for_each_plane(m[2], fine.size(), [&](int coarse) {
    const bool whole = n[2] == m[2];
    const int first = whole ? coarse : 2 * coarse;
    const int end = whole ? coarse + 1 : std::min(first + 2, n[2]);
    for (int k = first; k < end; ++k)
      for (int j = 0; j < n[1]; ++j) {
        const double* from = fine.data() + row(n, j, k);
        double* to = own.data() + row(m, parent(1, j), coarse);
        for (int i = 0; i < n[0]; ++i) to[parent(0, i)] += from[i];
      }
  });
  return own;
}

/// Up to four rows with their shares.
struct WeightedRows {
  std::array<const float*, 4> row{};
  std::array<float, 4> share{};
  int n = 0;

  void add(const float* from, double with) {
    if (n == 0) row.fill(from);
    row[n] = from;
    share[n++] = static_cast<float>(with);
  }
};

/// to = sum of rows, or to += it.
ACINUS_KERNEL void combine_rows(std::size_t n, const WeightedRows& from, bool add, float* to) {
  const auto [r0, r1, r2, r3] = from.row;
  const auto [s0, s1, s2, s3] = from.share;
  for (std::size_t i = 0; i < n; i += kLanes) {
    const LaneOf<float> sum = (s0 * load<float>(r0 + i) + s1 * load<float>(r1 + i)) +
                              (s2 * load<float>(r2 + i) + s3 * load<float>(r3 + i));
    store(to + i, add ? load<float>(to + i) + sum : sum);
  }
}

/// A row with room for voxels beyond both ends.
class WideRow {
 public:
  explicit WideRow(std::size_t length) : value_(length + 4 * kLanes, 0.0F) {}
  float* data() { return value_.data() + kLanes; }
  /// Repeats the first voxel of n before it and, if wanted, the last one behind it. Clears the
  /// rest.
  void close(std::size_t n, bool repeat_last) {
    float* v = data();
    std::fill(v + n, value_.data() + value_.size(), 0.0F);
    v[-1] = v[0];
    if (repeat_last) v[n] = v[n - 1];
  }

 private:
  std::vector<float> value_;
};

ACINUS_INLINE LaneOf<float> every_second(const float* from) {
  return __builtin_shufflevector(load<float>(from), load<float>(from + kLanes), 0, 2, 4, 6, 8, 10,
                                 12, 14);
}

/// Coarse row of a fine one along x.   @param n  coarse numbers, whole lanes
ACINUS_KERNEL void restrict_row(std::size_t n, const float* fine, float* coarse) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    const float* f = fine + 2 * i;
    store(coarse + i, kNear * (every_second(f) + every_second(f + 1)) +
                          kFar * (every_second(f - 1) + every_second(f + 2)));
  }
}

/// Adds a coarse row to a fine one along x.   @param n  fine numbers, whole lanes
ACINUS_KERNEL void prolong_row(std::size_t n, const float* coarse, float* fine) {
  for (std::size_t i = 0; i < n; i += 2 * kLanes) {
    const float* c = coarse + i / 2;
    const LaneOf<float> own = kNear * load<float>(c), even = own + kFar * load<float>(c - 1),
                        odd = own + kFar * load<float>(c + 1);
    store(fine + i,
          load<float>(fine + i) + __builtin_shufflevector(even, odd, 0, 8, 1, 9, 2, 10, 3, 11));
    if (i + kLanes < n)
      store(fine + i + kLanes, load<float>(fine + i + kLanes) +
                                   __builtin_shufflevector(even, odd, 4, 12, 5, 13, 6, 14, 7, 15));
  }
}

/// b of the coarse level = transposed interpolation of a residual.
void restrict_to(const PaddedLayout& fine, const PaddedLayout& coarse,
                 const std::array<Transfer, 3>& t, const float* r, float* b) {
  const std::size_t length = fine.stride - kLanes, coarse_length = coarse.stride - kLanes;
  const auto n_x = static_cast<std::size_t>(fine.n[0]);
  for_each_plane(coarse.n[2], fine.n_voxel(), [&](int k) {
    WideRow sum(length);
    for (int j = 0; j < coarse.n[1]; ++j) {
      bool first = true;
      for (const auto& [kf, zs] : t[2].coarse[k]) {
        WeightedRows rows;
        for (const auto& [jf, ys] : t[1].coarse[j]) rows.add(r + fine.row(jf, kf), zs * ys);
        combine_rows(length, rows, !first, sum.data());
        first = false;
      }
      float* to = b + coarse.row(j, k);
      if (fine.n[0] == 1) {
        to[0] = sum.data()[0];
        continue;
      }
      sum.close(n_x, n_x % 2 == 0);
      restrict_row(coarse_length, sum.data(), to);
      std::fill(to + coarse.n[0], to + coarse_length, 0.0F);
    }
  });
}

/// x += interpolation of a coarse solution.
void prolong(const PaddedLayout& fine, const PaddedLayout& coarse, const std::array<Transfer, 3>& t,
             const float* from, float* x) {
  const std::size_t length = fine.stride - kLanes, coarse_length = coarse.stride - kLanes;
  for_each_plane(fine.n[2], fine.n_voxel(), [&](int k) {
    WideRow sum(coarse_length);
    const Transfer::Parents& z = t[2].fine[k];
    for (int j = 0; j < fine.n[1]; ++j) {
      const Transfer::Parents& y = t[1].fine[j];
      WeightedRows rows;
      rows.add(from + coarse.row(y.near, z.near), y.near_share * z.near_share);
      rows.add(from + coarse.row(y.far, z.near), y.far_share * z.near_share);
      rows.add(from + coarse.row(y.near, z.far), y.near_share * z.far_share);
      rows.add(from + coarse.row(y.far, z.far), y.far_share * z.far_share);
      combine_rows(coarse_length, rows, false, sum.data());
      float* to = x + fine.row(j, k);
      if (fine.n[0] == 1) {
        to[0] += sum.data()[0];
        continue;
      }
      sum.close(static_cast<std::size_t>(coarse.n[0]), true);
      prolong_row(length, sum.data(), to);
      std::fill(to + fine.n[0], to + length, 0.0F);
    }
  });
}

}  // namespace

void Multigrid::resize(const std::array<int, 3>& n) {
  level_.clear();
  transfer_.clear();
  Level<float> level;
  level.layout = make_layout(n);
  for (int axis = 0; axis < 3; ++axis) level.width[axis].assign(n[axis], 1.0);
  level_.push_back(level);
  for (;;) {
    const Level<float>& fine = level_.back();
    std::array<int, 3> m = fine.layout.n;
    Level<float> next;
    std::array<Transfer, 3> transfer;
    bool any = false;
    for (int axis = 0; axis < 3; ++axis) {
      const bool coarsens = m[axis] > 1;
      any = any || coarsens;
      transfer[axis] = make_transfer(m[axis], coarsens);
      next.width[axis] = join_widths(fine.width[axis], coarsens);
      m[axis] = static_cast<int>(next.width[axis].size());
    }
    if (!any) break;
    next.layout = make_layout(m);
    transfer_.push_back(std::move(transfer));
    level_.push_back(std::move(next));
  }
  own_.assign(level_.size(), {});
  residual_.assign(level_.size(), {});
  rhs_.assign(level_.size(), {});
  solution_.assign(level_.size(), {});
  for (std::size_t k = 0; k < level_.size(); ++k) {
    residual_[k].assign(level_[k].layout.size, 0.0F);
    if (k == 0) continue;
    rhs_[k].assign(level_[k].layout.size, 0.0F);
    solution_[k].assign(level_[k].layout.size, 0.0F);
  }
}

void Multigrid::set(std::span<const double> own, const std::array<double, 3>& conductance,
                    const std::array<std::vector<double>, 3>* open) {
  if (open != nullptr) {
    set_faces(conductance, level_[0]);
    set_partial_faces(conductance, *open, level_[0]);
    set_diagonal(own, level_[0]);
    aggregates_.set(level_[0], own);
    return;
  }
  for (std::size_t k = 0; k < level_.size(); ++k) {
    if (k > 0) {
      own_[k] = join_own(own, level_[k - 1].layout.n, level_[k].layout.n);
      own = own_[k];
    }
    set_faces(conductance, level_[k]);
    set_diagonal(own, level_[k]);
  }
}

void Multigrid::apply(const float* b, float* x) { cycle(0, b, x); }

void Multigrid::cycle(std::size_t at, const float* b, float* x) {
  const Level<float>& level = level_[at];
  const int n_sweep = at == 0 ? kFinestSweeps : kCoarserSweeps;
  for (int k = 0; k < n_sweep; ++k) smooth(level, b, x, true, k == 0);
  if (level.has_obstacles()) {
    subtract_product(level, b, x, residual_[0].data());
    aggregates_.correct(level.layout, residual_[0].data(), x);
    smooth(level, b, x, false, false);
    return;
  }
  if (at + 1 == level_.size()) return;  // a single voxel is solved
  subtract_product(level, b, x, residual_[at].data());
  restrict_to(level.layout, level_[at + 1].layout, transfer_[at], residual_[at].data(),
              rhs_[at + 1].data());
  cycle(at + 1, rhs_[at + 1].data(), solution_[at + 1].data());
  prolong(level.layout, level_[at + 1].layout, transfer_[at], solution_[at + 1].data(), x);
  for (int k = 0; k < n_sweep; ++k) smooth(level, b, x, false, false);
}

}  // namespace acinus::substances
