/// Kernel benchmarks of force and stiffness of deformable cells: internal terms and contacts.

#include "bench/kernels/kernel_clump.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/loads/loads.hpp"
#include "dcm/terms/area.hpp"
#include "dcm/terms/bending.hpp"
#include "dcm/terms/cortex.hpp"
#include "dcm/terms/volume.hpp"

namespace acinus::bench {
namespace {

/// All internal terms, as a step adds them.
void add_loads(benchmark::State& state) {
  const AssembledClump& clump = packed_clump(static_cast<int>(state.range()));
  const coupling::Workspace& w = clump.work;
  solve::System system = w.system;
  for (auto _ : state) {
    clear_loads(system);
    dcm::add_loads(clump.world.state.dcm, clump.world.params.dcm, w.lanes, w.medium_area,
                   w.forces.dcm, system);
    benchmark::ClobberMemory();
  }
  count(state, "cells", state.range());
}
BENCHMARK(add_loads)->Apply(clump_sizes);

/// One internal term of all cells. Sums are not cleared between iterations, which only lets values
/// grow.
template <class Term>
void add_term(benchmark::State& state, Term add) {
  const AssembledClump& clump = packed_clump(static_cast<int>(state.range()));
  const dcm::State& cells = clump.world.state.dcm;
  solve::System system = clump.work.system;
  for (auto _ : state) {
    for (std::size_t k = 0; k < cells.group.size(); ++k)
      add(clump.world.params.dcm[cells.group[k].type],
          view_group(cells, clump.work.lanes, system, k), system);
    benchmark::ClobberMemory();
  }
  count(state, "cells", state.range());
}

using dcm::GroupView, dcm::Params, solve::System;
BENCHMARK_CAPTURE(add_term, cortex, [](const Params& p, const GroupView& g, System& s) {
  dcm::add_cortex(p, g, s);
})->Apply(clump_sizes);
BENCHMARK_CAPTURE(add_term, bending, [](const Params& p, const GroupView& g, System& s) {
  dcm::add_bending(p, g, s);
})->Apply(clump_sizes);
BENCHMARK_CAPTURE(add_term, volume, [](const Params& p, const GroupView& g, System& s) {
  dcm::add_volume(p, g, s, s.rank_one.front());
})->Apply(clump_sizes);
BENCHMARK_CAPTURE(add_term, area, [](const Params& p, const GroupView& g, System& s) {
  dcm::add_area(p, g, s, s.rank_one.back());
})->Apply(clump_sizes);

/// Links of all contacts found.
void add_contact_loads(benchmark::State& state) {
  const AssembledClump& clump = packed_clump(static_cast<int>(state.range()));
  const coupling::Params& p = clump.world.params;
  const dcm::ContactInput in{clump.world.state.dcm, p.dcm,      p.dcm_contact,
                             clump.work.lanes,      p.boundary, 0};
  contact::ContactList contacts = clump.work.contacts;
  solve::Links links;
  for (auto _ : state) {
    links.clear();
    dcm::add_contact_loads(in, clump.work.dcm, contacts, links);
    benchmark::ClobberMemory();
  }
  count(state, "contacts", links.size());
}
BENCHMARK(add_contact_loads)->Apply(clump_sizes);

}  // namespace
}  // namespace acinus::bench
