/// Kernel benchmarks of contact: closest points scalar and vectorised, contact search, and the JKR
/// law.

#include <algorithm>
#include <array>
#include <vector>

#include "bench/kernels/kernel_clump.hpp"
#include "contact/candidates.hpp"
#include "contact/jkr.hpp"
#include "contact/jkr_lanes.hpp"
#include "core/numbers/random.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "geometry/closest_point.hpp"
#include "geometry/closest_point_lanes.hpp"

namespace acinus::bench {
namespace {

constexpr std::size_t kPairs = 1 << 14;

/// Point and the corners of a candidate triangle, um.
using PointAndTriangle = std::array<Vec3, 4>;

/// First kPairs point-triangle pairs of the candidate lists of a clump.
std::vector<PointAndTriangle> listed_pairs() {
  const dcm::ContactWorkspace& work = packed_clump(64).work.dcm;
  std::vector<PointAndTriangle> pair;
  for (const auto& [body_a, body_b, list] : work.lists.pair) {
    const contact::SurfaceBody &a = work.body[body_a], &b = work.body[body_b];
    for (std::size_t k = 0; k < list.n_point(); ++k) {
      const Vec3 p =
          point_position(a, point_stencil(a, contact::Quadrature::kThreePoint, list.point_at(k)));
      for (std::size_t c = list.begin_of(k); c < list.end_of(k); ++c) {
        if (pair.size() == kPairs) return pair;
        const auto [i, j, m] = (*b.triangle)[list.triangle_at(c)];
        pair.push_back({p, b.node[i], b.node[j], b.node[m]});
      }
    }
  }
  return pair;
}

void find_closest_point(benchmark::State& state) {
  const std::vector<PointAndTriangle> pair = listed_pairs();
  for (auto _ : state) {
    double sum = 0;
    for (const auto& [p, a, b, c] : pair)
      sum += geometry::find_closest_point(p, a, b, c).squared_distance;
    benchmark::DoNotOptimize(sum);
  }
  count(state, "pairs", pair.size());
}
BENCHMARK(find_closest_point)->Unit(benchmark::kMicrosecond);

/// Sum of squared closest distances, um^2.
/// @param pair  [n][4][3][lane] um
ACINUS_KERNEL double sum_closest(const double* pair, std::size_t n) {
  Lane sum = lane_of(0);
  for (std::size_t k = 0; k < n; ++k, pair += 4 * kPointStride)
    sum += geometry::find_closest_point_lanes(load3(pair), load3(pair + kPointStride),
                                              load3(pair + 2 * kPointStride),
                                              load3(pair + 3 * kPointStride))
               .squared_distance;
  return sum_lanes<double>(sum);
}

void find_closest_point_lanes(benchmark::State& state) {
  const std::vector<PointAndTriangle> pair = listed_pairs();
  const std::size_t n = pair.size() / kLanes;
  std::vector<double> packed(n * 4 * kPointStride);
  for (std::size_t k = 0; k < n * kLanes; ++k)
    for (std::size_t m = 0; m < 4; ++m)
      store_point(packed.data(), make_address(k / kLanes * 4 + m, static_cast<int>(k % kLanes)),
                  pair[k][m]);
  for (auto _ : state) benchmark::DoNotOptimize(sum_closest(packed.data(), n));
  count(state, "pairs", n * kLanes);
}
BENCHMARK(find_closest_point_lanes)->Unit(benchmark::kMicrosecond);

/// Search options as used by a step.
contact::SearchOptions search_options(const AssembledClump& clump) {
  const dcm::ContactParams& c = clump.world.params.dcm_contact;
  const dcm::State& cells = clump.world.state.dcm;
  const auto& radius = clump.work.lanes.radius;
  return {c.quadrature,
          contact_range(c, *cells.group[0].topology, *std::ranges::max_element(radius)),
          c.max_depth, c.skin, 2 * dcm::kSelfGap};
}

/// Contact search over all candidate lists.
void find_contacts(benchmark::State& state) {
  const AssembledClump& clump = packed_clump(static_cast<int>(state.range()));
  const contact::SearchOptions options = search_options(clump);
  contact::Contacts found;
  for (auto _ : state) {
    found.clear();
    for (const contact::Candidates& list : clump.work.dcm.lists.pair)
      contact::find_contacts(list, clump.work.dcm.body, {}, options, 0, found);
    benchmark::ClobberMemory();
  }
  count(state, "contacts", found.size());
}
BENCHMARK(find_contacts)->Apply(clump_sizes);

/// Refill of the candidate lists.
void fill_candidates(benchmark::State& state) {
  const AssembledClump& clump = packed_clump(static_cast<int>(state.range()));
  const contact::SearchOptions options = search_options(clump);
  std::vector<contact::Candidates> lists = contact::list_pairs(clump.work.dcm.body, {}, options, 0);
  std::vector<contact::Candidates*> all;
  for (contact::Candidates& list : lists) all.push_back(&list);
  for (auto _ : state) {
    contact::fill_candidates(clump.work.dcm.body, {}, options, all);
    benchmark::ClobberMemory();
  }
  count(state, "cells", state.range());
}
BENCHMARK(fill_candidates)->Apply(clump_sizes);

/// Pairs of spheres as in a clump: on both sides of the rest distance, some strongly compressed.
struct SpherePairs {
  std::vector<double> radius, modulus, adhesion, overlap;

  SpherePairs() {
    UniformStream random(7, Purpose::kPlacement, 1);
    for (std::size_t k = 0; k < kPairs; ++k) {
      radius.push_back(random.uniform(2.5, 3.5));
      modulus.push_back(random.uniform(0.2, 0.4));
      adhesion.push_back(0.01);
      overlap.push_back(random.uniform(-0.1, 1.5));
    }
  }
};

void jkr_force(benchmark::State& state) {
  const SpherePairs s;
  for (auto _ : state) {
    double sum = 0;
    for (std::size_t k = 0; k < kPairs; ++k)
      sum +=
          contact::jkr_force({s.radius[k], s.modulus[k], s.adhesion[k]}, s.overlap[k], true).force;
    benchmark::DoNotOptimize(sum);
  }
  count(state, "pairs", kPairs);
}
BENCHMARK(jkr_force)->Unit(benchmark::kMicrosecond);

ACINUS_KERNEL double sum_jkr(const SpherePairs& s) {
  Lane sum = lane_of(0);
  for (std::size_t k = 0; k < kPairs; k += kLanes)
    sum += contact::jkr_force_lanes(load(&s.radius[k]), load(&s.modulus[k]), load(&s.adhesion[k]),
                                    load(&s.overlap[k]), lane_of(1))
               .force;
  return sum_lanes<double>(sum);
}

void jkr_force_lanes(benchmark::State& state) {
  const SpherePairs s;
  for (auto _ : state) benchmark::DoNotOptimize(sum_jkr(s));
  count(state, "pairs", kPairs);
}
BENCHMARK(jkr_force_lanes)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace acinus::bench
