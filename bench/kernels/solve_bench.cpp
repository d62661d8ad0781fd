/// Kernel benchmarks of the solver: matrix-vector products, whole and in parts, and the
/// preconditioner.

#include <span>
#include <vector>

#include "bench/kernels/kernel_clump.hpp"
#include "solve/kernels.hpp"
#include "solve/merged_links.hpp"

namespace acinus::bench {
namespace {

template <class T>
using Points = std::vector<solve::Packed<T>>;

/// Product with the blocks of the cells.
template <class T>
void multiply_block(benchmark::State& state) {
  const solve::System& s = packed_clump(static_cast<int>(state.range())).work.system;
  std::vector<solve::BlockView> view;
  for (std::size_t b = 0; b < s.block.size(); ++b) view.push_back(view_block(s, b));
  const std::vector<T> x(s.n_dof(), T(1e-3));
  std::vector<T> y(s.n_dof());
  const Points<T> contact(s.n_row * kLanes);
  for (auto _ : state)
    for (std::size_t b = 0; b < s.block.size(); ++b) {
      const std::size_t row = s.block[b].first_row, at = row * kPointStride;
      benchmark::DoNotOptimize(solve::multiply_block(view[b], x.data() + at,
                                                     contact.data() + row * kLanes, y.data() + at));
    }
  count(state, "cells", state.range());
}
BENCHMARK_TEMPLATE(multiply_block, double)->Apply(clump_sizes);
BENCHMARK_TEMPLATE(multiply_block, float)->Apply(clump_sizes);

/// Product with the links of single contacts.
template <class T>
void multiply_links(benchmark::State& state) {
  const solve::System& s = packed_clump(static_cast<int>(state.range())).work.system;
  solve::ShareLists share(1);
  for (std::size_t l = 0; l < s.links.size(); ++l)
    if (has_matrix(s.links.link[l], s.stiffness_scale))
      share[0].push_back({static_cast<std::uint32_t>(l), 1, s.links.link[l].b.exists()});
  const Points<T> x(s.n_row * kLanes, {T(1e-3), T(1e-3), T(1e-3), 0});
  Points<T> y(x.size());
  for (auto _ : state) {
    solve::multiply_links(solve::LinkSet<solve::Link>{s.links.link, share},
                          {s.stiffness_scale, s.friction_scale}, x.data(), y.data());
    benchmark::ClobberMemory();
  }
  count(state, "contacts", share[0].size());
}
BENCHMARK_TEMPLATE(multiply_links, double)->Apply(clump_sizes);
BENCHMARK_TEMPLATE(multiply_links, float)->Apply(clump_sizes);

/// Linear map of an operator: member function from vector to vector.
template <class T>
using Map = double (solve::Operator::*)(std::span<const T>, std::span<T>) const;

template <class T>
void measure(benchmark::State& state, Map<T> map, bool merged = false) {
  const solve::System& s = packed_clump(static_cast<int>(state.range())).work.system;
  solve::Operator op;
  op.prepare(s);
  if (merged) op.merge_links();
  const std::vector<T> x(s.n_dof(), T(1e-3));
  std::vector<T> y(s.n_dof());
  for (auto _ : state) benchmark::DoNotOptimize((op.*map)(x, y));
  count(state, "cells", state.range());
}

/// Whole product of an iteration of conjugate gradients.
template <class T>
void apply(benchmark::State& state) {
  measure<T>(state, &solve::Operator::apply<T>);
}
BENCHMARK_TEMPLATE(apply, double)->Apply(clump_sizes);
BENCHMARK_TEMPLATE(apply, float)->Apply(clump_sizes);

/// Whole product with merged contacts: multiply_pairs in place of multiply_links.
void apply_merged(benchmark::State& state) {
  measure<float>(state, &solve::Operator::apply<float>, true);
}
BENCHMARK(apply_merged)->Apply(clump_sizes);

/// Merging of links, the overhead of the merged product.
void merge_links(benchmark::State& state) {
  const solve::System& s = packed_clump(static_cast<int>(state.range())).work.system;
  solve::LinkMerger merger;
  solve::MergedLinks merged;
  for (auto _ : state) merger.merge(s, merged);
  count(state, "cells", state.range());
}
BENCHMARK(merge_links)->Apply(clump_sizes);

template <class T>
void precondition(benchmark::State& state) {
  measure<T>(state, &solve::Operator::precondition<T>);
}
BENCHMARK_TEMPLATE(precondition, double)->Apply(clump_sizes);
BENCHMARK_TEMPLATE(precondition, float)->Apply(clump_sizes);

}  // namespace
}  // namespace acinus::bench
