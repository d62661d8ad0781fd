#include "bench/tissue/contact_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bench/tissue/pulled_pair.hpp"
#include "contact/maugis_triangles.hpp"
#include "core/error.hpp"
#include "core/parallel/clock.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::bench {
namespace {

using dcm::ContactLaw;

constexpr double kClumpSpacing = 0.99;  ///< of the clump, diameters; h0 acts over 20 nm

/// Step and hold time of the pair, s. Contacts with a range of 20 nm come to rest with it and
/// oscillate with 2 s; little changes after 200 s.
constexpr double kPairStep = 0.5, kPairHoldTime = 400;

/// Step and end of the clump, s, without step-size control: the same for both laws.
constexpr double kClumpStep = 60, kClumpEnd = 7200;

struct LawCase {
  std::string name;
  PairCase pair;
  bool after_cohesive = false;
};

std::vector<LawCase> make_pair_cases() {
  std::vector<LawCase> cases;
  for (const int nodes : {162, 642}) {
    const auto name = [nodes](const std::string& law) {
      return fmt::format("pair, {} nodes, {}", nodes, law);
    };
    PairCase c;
    c.nodes = nodes;
    c.step = kPairStep;
    c.hold = kPairHoldTime;
    cases.push_back({name("cohesive"), c});
    c.law = ContactLaw::kMaugisDugdale;
    for (const double h0 : {0.02, 0.1, 0.4}) {
      if (nodes != 162 && h0 != 0.02) continue;
      c.h0 = h0;
      const std::string law = name(fmt::format("Maugis-Dugdale, h0 {:g} nm", 1e3 * h0));
      cases.push_back({law, c, false});
      cases.push_back({law + ", after cohesive", c, true});
    }
  }
  return cases;
}

BenchRow measure_pair(const LawCase& l, const BenchOptions& options) {
  const double unit = vesicle_force(l.pair), start = cpu_seconds();
  PairRest free, held;
  double still = 0, borne = 0, rejected = 0;
  for (int k = 0; k < options.seeds; ++k) {
    PairCase c = l.pair;
    c.seed = options.first + k;
    const HeldPair p = hold_pair(c, unit, l.after_cohesive);
    free.area += p.free.area;
    free.touching += p.free.touching;
    free.pressure += p.free.pressure;
    free.distance += p.free.distance;
    held.area += p.held.area;
    held.distance += p.held.distance;
    still += p.is_still ? 1 : 0;
    borne += p.is_borne ? 1 : 0;
    rejected += static_cast<double>(p.rejected) / static_cast<double>(p.steps);
  }
  const double n = options.seeds;
  BenchRow row{l.name, 2, {}};
  row.value = {{"area_um2", free.area / n},
               {"touching_um2", free.touching / n},
               {"pressure_Pa", 1e3 * free.pressure / n},
               {"distance_um", free.distance / n},
               {"still", still / n},
               {"rejected_per_step", rejected / n},
               {"held_area_um2", held.area / n},
               {"held_distance_um", held.distance / n},
               {"held_borne", borne / n},
               {"cpu_s", (cpu_seconds() - start) / n}};
  print_row(row);
  return row;
}

/// Forces of the pair with rigid cells of R = 12 um.
BenchRow measure_rigid(const LawCase& l, const BenchOptions& options) {
  double pull = 0, near = 0, nearer = 0;
  for (int k = 0; k < options.seeds; ++k) {
    PairCase c = l.pair;
    c.seed = options.first + k;
    pull += compute_rigid_pull_off(c) / (2 * vesicle_force(c));
    near += compute_rigid_push(c, 23.8);
    nearer += compute_rigid_push(c, 23.4);
  }
  const double n = options.seeds;
  BenchRow row{"rigid " + l.name, 2, {}};
  row.value = {{"pull_off_ratio_to_2piWR", pull / n},
               {"push_at_23.8_um_nN", near / n},
               {"push_at_23.4_um_nN", nearer / n}};
  print_row(row);
  return row;
}

/// Work per area of adhesion to separate two triangles along their normal, relative to W. Starts
/// where no force repels; the area is the largest contact area.
/// @param radius  of curvature, um
/// @param h0      range of adhesion, um
double lifting_work(double radius, double h0) {
  constexpr double kEdge = 3.6, kAdhesion = 0.02, kSeparationStep = 1e-4;  // um, nN/um, um
  const dcm::ContactParams c;
  const contact::MaugisLaw law{c.modulus, kAdhesion, kAdhesion / h0, c.max_radius};
  const double corner = std::min(kEdge, 0.5 * radius) / std::sqrt(3.0);
  const auto triangle = [&](double z, double sign) {
    std::array<Vec3, 3> x;
    for (int k = 0; k < 3; ++k) {
      const double angle = sign * 2 * kPi * k / 3;
      x[k] = Vec3(corner * std::cos(angle), corner * std::sin(angle), z);
    }
    return contact::make_curved_triangle(x, 0.5 / radius);
  };
  double work = 0, area = 0;
  for (double z = 0.5; z > -2; z -= kSeparationStep) {  // half of it from either side
    const auto f = contact::compute_triangle_forces(law, triangle(z, 1), triangle(-z, -1));
    area = std::max(area, f.contact_area);
    work -= 2 * kSeparationStep * std::min(0.0, f.normal_force);
  }
  return work / (area * kAdhesion);
}

BenchTable measure_lifting() {
  BenchTable table;
  for (const double h0 : {0.02, 0.1, 0.4}) {
    BenchRow row{fmt::format("lifting a triangle, Maugis-Dugdale, h0 {:g} nm", 1e3 * h0), 0, {}};
    for (const double radius : {6.0, 100.0, 1000.0})
      row.value.emplace_back(fmt::format("work_over_W_{:g}_um", radius), lifting_work(radius, h0));
    print_row(row);
    table.push_back(row);
  }
  return table;
}

BenchRow pull_off_row(const LawCase& l) {
  const PullOff p = measure_pull_off(l.pair);
  BenchRow row{
      fmt::format("{}, W {:g} J/m^2, seed {}", l.name, 1e-3 * l.pair.adhesion, l.pair.seed), 2, {}};
  row.value = {{"adhered", p.adhered ? 1 : 0}};
  if (p.adhered) {
    row.value.insert(row.value.end(), {{"ratio_to_piWR", p.force() / vesicle_force(l.pair)},
                                       {"pull_off_nN", p.force()},
                                       {"area_um2", p.start.area},
                                       {"last_area_um2", p.last.area},
                                       {"last_distance_um", p.last.distance}});
  }
  print_row(row);
  return row;
}

/// Clump under a contact law after two hours.
BenchRow measure_clump(const std::string& name, ContactLaw law, const BenchOptions& options) {
  runs::Scene scene = runs::read_scene(runs::scene_folder() + "/clump13.json");
  scene.seed = options.first;
  scene.cells.spacing = kClumpSpacing;
  scene.contact.law = law;
  scene.numerics.adaptive = false;
  scene.numerics.max_step = kClumpStep;
  const double start = cpu_seconds();
  coupling::Simulation simulation(runs::build_world(scene, Ranks::serial()).world);
  const coupling::LoopResult result = simulation.run_until(kClumpEnd);
  check(!result.last.interrupted, "bench contact-laws: stopped", Exit::kStopped);
  check(result.ok, "bench contact-laws: a step failed: " + result.last.cause,
        Exit::kCannotContinue);
  coupling::observe(simulation.world(), simulation.work());
  double contacts = 0, area = 0, force = 0, normal = 0, pressure = 0, cytosol = 0;
  const auto cells = coupling::measure_cells(simulation.world(), simulation.work());
  for (const coupling::CellMeasure& c : cells) {
    contacts += c.contacts;
    area += c.contact_area;
    force += c.contact_force;
    normal += c.normal_force;
    pressure += c.pressure;
    cytosol += c.cytosol_pressure;
  }
  const double n = static_cast<double>(cells.size());
  const coupling::Clock& clock = simulation.world().state.clock;
  BenchRow row{name, static_cast<int>(cells.size()), {}};
  row.value = {{"contacts_per_cell", contacts / n},
               {"area_per_contact_um2", area / contacts},
               {"force_per_contact_nN", force / contacts},
               {"normal_force_per_contact_nN", normal / contacts},
               {"contact_pressure_Pa", 1e3 * pressure / n},
               {"pressure_Pa", 1e3 * cytosol / n},
               {"steps", static_cast<double>(clock.accepted)},
               {"rejected", static_cast<double>(clock.rejected)},
               {"cpu_s", cpu_seconds() - start}};
  print_row(row);
  return row;
}

}  // namespace

BenchTable bench_contact_laws(const BenchOptions& options) {
  BenchTable table = measure_lifting();
  const std::vector<LawCase> cases = make_pair_cases();
  for (const LawCase& l : cases)
    if (!l.after_cohesive) table.push_back(measure_rigid(l, options));
  for (const LawCase& l : cases) table.push_back(measure_pair(l, options));
  table.push_back(measure_clump("clump13, cohesive", ContactLaw::kCohesive, options));
  table.push_back(measure_clump("clump13, Maugis-Dugdale", ContactLaw::kMaugisDugdale, options));
  return table;
}

BenchTable bench_contact_laws_pull_off(const BenchOptions& options) {
  BenchTable table;
  for (LawCase& l : make_pair_cases()) {
    if (l.after_cohesive || l.pair.h0 != PairCase{}.h0) continue;
    l.pair.step = PairCase{}.step;
    for (const double adhesion : {0.01, 0.02, 0.05})
      for (int k = 0; k < options.seeds; ++k) {
        l.pair.adhesion = adhesion;
        l.pair.seed = options.first + k;
        table.push_back(pull_off_row(l));
      }
  }
  return table;
}

}  // namespace acinus::bench
