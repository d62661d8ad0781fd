#include "bench/step/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/step/packed_clump.hpp"
#include "contact/jkr.hpp"
#include "contact/jkr_lanes.hpp"
#include "core/numbers/random.hpp"
#include "core/parallel/clock.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/loads/loads.hpp"
#include "solve/merged_links.hpp"

namespace acinus::bench {
namespace {

/// Median CPU time of one call, us, over repetitions of about 20 ms each.
template <class F>
double time_us(F f) {
  f();
  double start = cpu_seconds();
  f();
  const int n = std::clamp(static_cast<int>(0.02 / std::max(cpu_seconds() - start, 1e-7)), 1, 1000);
  std::vector<double> samples;
  for (int r = 0; r < 9; ++r) {
    start = cpu_seconds();
    for (int k = 0; k < n; ++k) f();
    samples.push_back((cpu_seconds() - start) / n);
  }
  std::ranges::sort(samples);
  return 1e6 * samples[samples.size() / 2];
}

ACINUS_KERNEL void evaluate_jkr(std::size_t n, const double* radius, const double* modulus,
                                const double* adhesion, const double* overlap, double* force) {
  for (std::size_t k = 0; k < n; k += kLanes)
    store(force + k, contact::jkr_force_lanes(load(radius + k), load(modulus + k),
                                              load(adhesion + k), load(overlap + k), lane_of(1))
                         .force);
}

double time_merge_us(const solve::System& system) {
  solve::LinkMerger merger;
  solve::MergedLinks merged;
  return time_us([&] { merger.merge(system, merged); });
}

/// Size of the matrix block of one cell, bytes.
double matrix_bytes(const solve::Block& block) {
  return 4.0 *
         (static_cast<double>(block.pattern->spring.size()) * solve::kSpringStride +
          static_cast<double>(block.pattern->wing.size()) * solve::kHingeStride +
          (block.pattern->has_shape() ? block.pattern->n_point : 0) * 1.0 * kPointStride +
          static_cast<double>(block.pattern->face.size()) * solve::kFaceStride) /
         kLanes;
}

BenchRow measure_parts(int count, const std::string& quadrature) {
  AssembledClump clump({.count = count, .quadrature = quadrature});
  coupling::World& world = clump.world;
  coupling::Workspace& w = clump.work;
  const coupling::State& s = world.state;
  const std::size_t n = w.system.n_dof();
  std::vector<double> x(n, 1e-3), y(n);
  std::vector<float> xf(n, 1e-3f), yf(n);
  const double cells = count;

  const dcm::ContactInput in{s.dcm,   world.params.dcm,      world.params.dcm_contact,
                             w.lanes, world.params.boundary, 0};
  const double within = time_us([&] {
    solve::clear_loads(w.system);
    dcm::add_loads(s.dcm, world.params.dcm, w.lanes, w.medium_area, w.forces.dcm, w.system);
  });
  const double contacts_build = time_us([&] {
    w.system.links.clear();
    dcm::add_contact_loads(in, w.dcm, w.contacts, w.system.links);
  });
  const double links = static_cast<double>(w.system.links.size());
  const double prepare = time_us([&] { w.op.prepare(w.system); });
  const double product_double = time_us([&] { w.op.apply(x, y); });
  const double product = time_us([&] { w.op.apply<float>(xf, yf); });
  const double merge = time_merge_us(w.system);
  w.op.merge_links();
  const double product_merged = time_us([&] { w.op.apply<float>(xf, yf); });
  const double narrow = time_us([&] { dcm::find_contacts(in, w.dcm, w.contacts); });
  const double lists = time_us([&] {
    w.dcm.lists = {};
    dcm::refresh_lists(in, w.dcm);
  });
  double listed_points = 0, listed_triangles = 0;
  for (const contact::Candidates& c : w.dcm.lists.pair) {
    listed_points += static_cast<double>(c.list.n_point());
    listed_triangles += static_cast<double>(c.list.n_triangle());
  }
  w.system.links.clear();
  w.op.prepare(w.system);
  const double product_alone = time_us([&] { w.op.apply<float>(xf, yf); });
  BenchRow row{fmt::format("{} DCM cells, {}", count, quadrature),
               count,
               {{"us_per_cell", within / cells},
                {"bytes_per_cell", matrix_bytes(w.system.block[0])},
                {"product_us_per_cell", product / cells},
                {"merge_contacts_us_per_cell", merge / cells},
                {"product_merged_us_per_cell", product_merged / cells},
                {"product_without_contacts_us_per_cell", product_alone / cells},
                {"product_double_us_per_cell", product_double / cells},
                {"contacts_per_cell", links / cells},
                {"contact_loads_us_per_cell", contacts_build / cells},
                {"preconditioner_us_per_cell", prepare / cells},
                {"narrow_phase_us_per_cell", narrow / cells},
                {"list_build_us_per_cell", lists / cells},
                {"listed_points_per_cell", listed_points / cells},
                {"listed_triangles_per_cell", listed_triangles / cells}}};
  print_row(row);
  return row;
}

}  // namespace

BenchTable bench_assembly(const BenchOptions&) {
  BenchTable table;
  for (const char* quadrature : {"3-point", "nodes-and-edges", "nodes"})
    for (int count : {8, 27, 64, 512}) table.push_back(measure_parts(count, quadrature));
  return table;
}

BenchTable bench_jkr(const BenchOptions&) {
  // Overlaps and radii as in a clump: both sides of rest, some far pressed.
  constexpr std::size_t kPairs = 1 << 14;
  UniformStream random(7, Purpose::kPlacement, 1);
  std::vector<contact::SpherePair> pair(kPairs);
  std::vector<double> overlap(kPairs);
  for (std::size_t k = 0; k < kPairs; ++k) {
    pair[k] = {random.uniform(2.5, 3.5), random.uniform(0.2, 0.4), 0.01};
    overlap[k] = random.uniform(-0.1, 1.5);
  }
  double sum = 0;
  const double exact = time_us([&] {
    for (std::size_t k = 0; k < kPairs; ++k)
      sum += contact::jkr_force(pair[k], overlap[k], true).force;
  });
  BenchRow row{"JKR contacts, exact, one by one",
               static_cast<int>(kPairs),
               {{"million_per_s", kPairs / exact}, {"mean_force_nN", sum / kPairs}}};
  print_row(row);

  std::vector<double> radius, modulus, adhesion, force(kPairs);
  for (const contact::SpherePair& p : pair) {
    radius.push_back(p.radius);
    modulus.push_back(p.modulus);
    adhesion.push_back(p.adhesion);
  }
  const double lanes = time_us([&] {
    evaluate_jkr(kPairs, radius.data(), modulus.data(), adhesion.data(), overlap.data(),
                 force.data());
  });
  BenchRow eight{"JKR contacts, eight at a time",
                 static_cast<int>(kPairs),
                 {{"million_per_s", kPairs / lanes}}};
  double worst = 0;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const double one = contact::jkr_force(pair[k], overlap[k], true).force;
    worst = std::max(worst, std::abs(force[k] - one) / std::max(std::abs(one), 1e-3));
  }
  eight.value.emplace_back("largest_difference", worst);
  print_row(eight);
  return {row, eight};
}

}  // namespace acinus::bench
