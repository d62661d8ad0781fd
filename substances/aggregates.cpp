#include "substances/aggregates.hpp"

#include <algorithm>
#include <numeric>

namespace acinus::substances {
namespace {

/// Groups are joined so often from one level to the next, by twos.
constexpr int kPairings = 3;
/// Links weaker than this share of the strongest of a voxel do not join it to a group.
constexpr float kStrong = 0.25F;
constexpr std::size_t kCoarsest = 40;
constexpr int kCoarsestSweeps = 8;
/// Corrections by constant values are too small; this factor makes up for it.
constexpr float kOverCorrection = 1.5F;

void set_inverse(LinkGraph& g) {
  g.inverse.resize(g.n());
  for (std::size_t i = 0; i < g.n(); ++i) {
    float sum = g.own[i];
    for (std::size_t l = g.start[i]; l < g.start[i + 1]; ++l) sum += g.link[l];
    g.inverse[i] = sum > 0 ? 1 / sum : 0;
  }
}

/// Pairs of neighbours with the strongest links. Those left alone join the group of theirs.
/// @return number of groups
int pair_up(const LinkGraph& g, std::vector<int>& group) {
  group.assign(g.n(), -1);
  int n = 0;
  for (std::size_t i = 0; i < g.n(); ++i) {
    if (group[i] >= 0) continue;
    float strongest = 0, best = 0;
    int partner = -1, joined = -1;
    for (std::size_t l = g.start[i]; l < g.start[i + 1]; ++l) {
      if (g.link[l] > strongest) {
        strongest = g.link[l];
        joined = g.to[l];
      }
      if (group[static_cast<std::size_t>(g.to[l])] < 0 && g.link[l] > best) {
        best = g.link[l];
        partner = g.to[l];
      }
    }
    if (partner >= 0 && best >= kStrong * strongest) {
      group[i] = group[static_cast<std::size_t>(partner)] = n++;
    } else if (joined >= 0 && group[static_cast<std::size_t>(joined)] >= 0 &&
               strongest >= g.own[i]) {
      group[i] = group[static_cast<std::size_t>(joined)];
    } else {
      group[i] = n++;
    }
  }
  return n;
}

/// Graph of the groups: sums of what is in them and between them.
LinkGraph join(const LinkGraph& fine, const std::vector<int>& group, int n) {
  LinkGraph g;
  g.own.assign(static_cast<std::size_t>(n), 0.0F);
  std::vector<std::size_t> first(static_cast<std::size_t>(n) + 1, 0), member(fine.n());
  for (std::size_t i = 0; i < fine.n(); ++i) ++first[static_cast<std::size_t>(group[i]) + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < fine.n(); ++i) member[next[static_cast<std::size_t>(group[i])]++] = i;
  std::vector<long> place(static_cast<std::size_t>(n), -1);
  g.start.push_back(0);
  for (int k = 0; k < n; ++k) {
    const auto begin = static_cast<long>(g.to.size());
    for (std::size_t m = first[static_cast<std::size_t>(k)];
         m < first[static_cast<std::size_t>(k) + 1]; ++m) {
      const std::size_t i = member[m];
      g.own[static_cast<std::size_t>(k)] += fine.own[i];
      for (std::size_t l = fine.start[i]; l < fine.start[i + 1]; ++l) {
        const int other = group[static_cast<std::size_t>(fine.to[l])];
        if (other == k) continue;
        long& at = place[static_cast<std::size_t>(other)];
        if (at < begin) {
          at = static_cast<long>(g.to.size());
          g.to.push_back(other);
          g.link.push_back(0);
        }
        g.link[static_cast<std::size_t>(at)] += fine.link[l];
      }
    }
    g.start.push_back(g.to.size());
  }
  return g;
}

/// Joins groups of a graph, which becomes that of the joined ones, so often by twos.
/// @return [n] joined group
std::vector<int> join_groups(LinkGraph& graph, int pairings) {
  std::vector<int> parent(graph.n()), group;
  std::iota(parent.begin(), parent.end(), 0);
  for (int k = 0; k < pairings; ++k) {
    const int n = pair_up(graph, group);
    graph = join(graph, group, n);
    for (int& p : parent) p = group[static_cast<std::size_t>(p)];
  }
  return parent;
}

/// Sweep of Gauss-Seidel over all unknowns, forward or backward.
void sweep(const LinkGraph& g, const std::vector<float>& b, bool forward, std::vector<float>& x) {
  const std::size_t n = g.n();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = forward ? k : n - 1 - k;
    float sum = b[i];
    for (std::size_t l = g.start[i]; l < g.start[i + 1]; ++l)
      sum += g.link[l] * x[static_cast<std::size_t>(g.to[l])];
    x[i] = g.inverse[i] * sum;
  }
}

/// r = b - A x
void subtract(const LinkGraph& g, const std::vector<float>& b, const std::vector<float>& x,
              std::vector<float>& r) {
  for (std::size_t i = 0; i < g.n(); ++i) {
    float sum = b[i];
    if (g.inverse[i] > 0) sum -= x[i] / g.inverse[i];
    for (std::size_t l = g.start[i]; l < g.start[i + 1]; ++l)
      sum += g.link[l] * x[static_cast<std::size_t>(g.to[l])];
    r[i] = sum;
  }
}

/// Graph of the open voxels of a level.
LinkGraph graph_of(const Level<float>& l, std::span<const double> own, std::vector<int>& unknown) {
  const std::array<int, 3>& n = l.layout.n;
  const std::size_t nx = static_cast<std::size_t>(n[0]), ny = static_cast<std::size_t>(n[1]);
  LinkGraph g;
  unknown.assign(own.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < own.size(); ++v)
    if (own[v] > 0) unknown[v] = count++;
  g.start.push_back(0);
  std::size_t v = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i, ++v) {
        if (unknown[v] < 0) continue;
        const auto add = [&](std::size_t other, float link) {
          if (!(link > 0) || unknown[other] < 0) return;
          g.to.push_back(unknown[other]);
          g.link.push_back(link);
        };
        const std::size_t at = l.layout.row(j, k) + static_cast<std::size_t>(i);
        if (k > 0) add(v - nx * ny, l.partial[2][at]);
        if (j > 0) add(v - nx, l.partial[1][at]);
        if (i > 0) add(v - 1, l.partial[0][at]);
        if (i + 1 < n[0]) add(v + 1, l.partial[0][at + 1]);
        if (j + 1 < n[1]) add(v + nx, l.partial[1][at + l.layout.stride]);
        if (k + 1 < n[2]) add(v + nx * ny, l.partial[2][at + ny * l.layout.stride]);
        g.start.push_back(g.to.size());
        g.own.push_back(static_cast<float>(own[v]));
      }
  return g;
}

}  // namespace

void Aggregates::set(const Level<float>& finest, std::span<const double> own) {
  build(graph_of(finest, own, group_), kPairings);
}

void Aggregates::set(LinkGraph finest) {
  set_inverse(finest);
  group_.resize(finest.n());
  std::iota(group_.begin(), group_.end(), 0);
  finest_residual_.assign(finest.n(), 0.0F);
  finest_ = std::move(finest);
  // Sweeps cannot move two unknowns with a link far stronger than their others. The first level
  // makes one of them, which its own sweeps move.
  build(finest_, 1);
}

void Aggregates::apply(const std::vector<float>& b, std::vector<float>& x) {
  std::ranges::fill(x, 0.0F);
  sweep(finest_, b, true, x);
  subtract(finest_, b, x, finest_residual_);
  std::vector<float>& coarse = rhs_.front();
  std::ranges::fill(coarse, 0.0F);
  for (std::size_t i = 0; i < x.size(); ++i)
    coarse[static_cast<std::size_t>(group_[i])] += finest_residual_[i];
  cycle(0);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += kOverCorrection * solution_.front()[static_cast<std::size_t>(group_[i])];
  sweep(finest_, b, false, x);
}

void Aggregates::build(LinkGraph graph, int pairings) {
  level_.clear();
  for (;;) {
    const std::size_t before = graph.n();
    std::vector<int> parent = join_groups(graph, pairings);
    pairings = kPairings;
    if (level_.empty()) {
      for (int& g : group_)
        if (g >= 0) g = parent[static_cast<std::size_t>(g)];
    } else {
      level_.back().parent = std::move(parent);
    }
    set_inverse(graph);
    level_.push_back(graph);
    constexpr double kLeastShrinkage = 0.8;
    if (graph.n() <= kCoarsest || graph.n() > kLeastShrinkage * static_cast<double>(before)) break;
  }
  rhs_.resize(level_.size());
  solution_.resize(level_.size());
  residual_.resize(level_.size());
  for (std::size_t k = 0; k < level_.size(); ++k) {
    rhs_[k].assign(level_[k].n(), 0.0F);
    solution_[k].assign(level_[k].n(), 0.0F);
    residual_[k].assign(level_[k].n(), 0.0F);
  }
}

void Aggregates::cycle(std::size_t at) {
  const LinkGraph& g = level_[at];
  std::vector<float>& x = solution_[at];
  std::ranges::fill(x, 0.0F);
  sweep(g, rhs_[at], true, x);
  if (g.parent.empty()) {
    for (int k = 0; k < kCoarsestSweeps; ++k) {
      sweep(g, rhs_[at], false, x);
      sweep(g, rhs_[at], true, x);
    }
    sweep(g, rhs_[at], false, x);
    return;
  }
  constexpr int kVisits = 2;
  for (int visit = 0; visit < kVisits; ++visit) {
    if (visit > 0) sweep(g, rhs_[at], true, x);
    subtract(g, rhs_[at], x, residual_[at]);
    std::ranges::fill(rhs_[at + 1], 0.0F);
    for (std::size_t i = 0; i < g.n(); ++i)
      rhs_[at + 1][static_cast<std::size_t>(g.parent[i])] += residual_[at][i];
    cycle(at + 1);
    for (std::size_t i = 0; i < g.n(); ++i)
      x[i] += kOverCorrection * solution_[at + 1][static_cast<std::size_t>(g.parent[i])];
    sweep(g, rhs_[at], false, x);
  }
}

void Aggregates::correct(const PaddedLayout& l, const float* r, float* x) {
  std::vector<float>& b = rhs_.front();
  std::ranges::fill(b, 0.0F);
  const auto for_open = [&](const auto& f) {
    std::size_t v = 0;
    for (int k = 0; k < l.n[2]; ++k)
      for (int j = 0; j < l.n[1]; ++j) {
        const std::size_t row = l.row(j, k);
        for (int i = 0; i < l.n[0]; ++i, ++v)
          if (group_[v] >= 0)
            f(row + static_cast<std::size_t>(i), static_cast<std::size_t>(group_[v]));
      }
  };
  for_open([&](std::size_t at, std::size_t group) { b[group] += r[at]; });
  cycle(0);
  for_open([&](std::size_t at, std::size_t group) {
    x[at] += kOverCorrection * solution_.front()[group];
  });
}

}  // namespace acinus::substances
