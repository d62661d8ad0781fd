#include "substances/multigrid.hpp"

#include <algorithm>

#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

/// Number of voxels along an axis up to which it is not coarsened.
constexpr int kCoarsest = 1;
/// Pairs of sweeps that solve the coarsest level.
constexpr int kCoarsestSweeps = 8;

Transfer make_transfer(int n, bool coarsens) {
  Transfer t;
  const int n_coarse = coarsens ? (n + 1) / 2 : n;
  t.coarse.resize(static_cast<std::size_t>(n_coarse));
  for (int i = 0; i < n; ++i) {
    Transfer::Parents p{i, i, 1, 0};
    if (coarsens) {
      p.near = p.far = i / 2;
      const int far = i % 2 == 0 ? p.near - 1 : p.near + 1;
      if (far >= 0 && far < n_coarse) p = {i / 2, far, 0.75, 0.25};
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

ACINUS_KERNEL void add_scaled(std::size_t n, float share, const float* from, float* to) {
  for (std::size_t i = 0; i < n; i += kLanes)
    store(to + i, load<float>(to + i) + share * load<float>(from + i));
}

/// b of the coarse level = transposed interpolation of a residual.
void restrict_to(const PaddedLayout& fine, const PaddedLayout& coarse,
                 const std::array<Transfer, 3>& t, const float* r, float* b) {
  const std::size_t length = fine.stride - kLanes;
  for_each_plane(coarse.n[2], fine.n_voxel(), [&](int k) {
    std::vector<float> sum(length);
    for (int j = 0; j < coarse.n[1]; ++j) {
      std::fill(sum.begin(), sum.end(), 0.0F);
      for (const auto& [kf, zs] : t[2].coarse[k])
        for (const auto& [jf, ys] : t[1].coarse[j])
          add_scaled(length, static_cast<float>(zs * ys), r + fine.row(jf, kf), sum.data());
      float* to = b + coarse.row(j, k);
      for (int i = 0; i < coarse.n[0]; ++i) {
        float value = 0;
        for (const auto& [xf, xs] : t[0].coarse[i]) value += static_cast<float>(xs) * sum[xf];
        to[i] = value;
      }
    }
  });
}

/// x += interpolation of a coarse solution.
void prolong(const PaddedLayout& fine, const PaddedLayout& coarse, const std::array<Transfer, 3>& t,
             const float* from, float* x) {
  const std::size_t length = coarse.stride - kLanes;
  for_each_plane(fine.n[2], fine.n_voxel(), [&](int k) {
    std::vector<float> sum(length);
    const Transfer::Parents& z = t[2].fine[k];
    for (int j = 0; j < fine.n[1]; ++j) {
      const Transfer::Parents& y = t[1].fine[j];
      std::fill(sum.begin(), sum.end(), 0.0F);
      const auto add = [&](int jc, int kc, double share) {
        if (share > 0)
          add_scaled(length, static_cast<float>(share), from + coarse.row(jc, kc), sum.data());
      };
      add(y.near, z.near, y.near_share * z.near_share);
      add(y.far, z.near, y.far_share * z.near_share);
      add(y.near, z.far, y.near_share * z.far_share);
      add(y.far, z.far, y.far_share * z.far_share);
      float* to = x + fine.row(j, k);
      for (int i = 0; i < fine.n[0]; ++i) {
        const Transfer::Parents& p = t[0].fine[i];
        to[i] += static_cast<float>(p.near_share) * sum[p.near] +
                 static_cast<float>(p.far_share) * sum[p.far];
      }
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
      const bool coarsens = m[axis] > kCoarsest;
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
  smooth(level, b, x, true, true);
  if (level.has_obstacles()) {
    subtract_product(level, b, x, residual_[0].data());
    aggregates_.correct(level.layout, residual_[0].data(), x);
    smooth(level, b, x, false, false);
    return;
  }
  if (at + 1 == level_.size()) {
    smooth(level, b, x, false, false);
    for (int k = 1; k < kCoarsestSweeps; ++k) {
      smooth(level, b, x, true, false);
      smooth(level, b, x, false, false);
    }
    return;
  }
  subtract_product(level, b, x, residual_[at].data());
  restrict_to(level.layout, level_[at + 1].layout, transfer_[at], residual_[at].data(),
              rhs_[at + 1].data());
  cycle(at + 1, rhs_[at + 1].data(), solution_[at + 1].data());
  prolong(level.layout, level_[at + 1].layout, transfer_[at], solution_[at + 1].data(), x);
  smooth(level, b, x, false, false);
}

}  // namespace acinus::substances
