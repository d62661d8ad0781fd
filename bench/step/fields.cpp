#include "bench/step/fields.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/parallel/clock.hpp"
#include "core/sphere.hpp"
#include "substances/diffusion.hpp"

namespace acinus::bench {
namespace {

constexpr int kFieldVoxels = 100;     // along an edge of the box
constexpr double kFieldSpacing = 10;  // um
constexpr double kFieldStep = 60;     // s
constexpr int kFieldWarmUp = 5, kFieldSteps = 9;

struct FieldCase {
  std::string name;
  double diffusion, decay;
  substances::FaceCondition face;
  double start;
  substances::Exchange exchange;
};

/// Cells of a ball in the middle of the box, on a lattice.
std::vector<Vec3> ball_of_cells(double spacing, double radius) {
  const Vec3 middle = Vec3::Constant(0.5 * kFieldVoxels * kFieldSpacing);
  const int n = static_cast<int>(radius / spacing);
  std::vector<Vec3> center;
  for (int k = -n; k <= n; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i)
        if (const Vec3 x = spacing * Vec3(i, j, k); x.norm() <= radius)
          center.push_back(middle + x);
  return center;
}

BenchRow measure_field(const FieldCase& c) {
  constexpr double kCellRadius = 12, kTissueRadius = 290;
  const substances::VoxelGrid grid = substances::make_grid(
      {Vec3::Zero(), Vec3::Constant(kFieldVoxels * kFieldSpacing)}, kFieldSpacing);
  substances::Medium medium;
  medium.diffusion = c.diffusion;
  medium.decay = c.decay;
  medium.face.fill(c.face);
  std::vector<Vec3> cell = ball_of_cells(22, kTissueRadius);
  const std::vector<substances::Exchange> exchange(cell.size(), c.exchange);
  substances::Solver solver;
  solver.resize(grid.n);
  std::vector<double> field(grid.n_voxel(), c.start), wall, shares_wall;
  double iterations = 0, solves = 0;
  for (int step = 0; step < kFieldWarmUp + kFieldSteps; ++step) {
    for (std::size_t k = 0; k < cell.size(); ++k)  // cells move a little in every step
      cell[k] += 0.05 * Vec3(std::sin(k), std::cos(k), std::sin(2.0 * static_cast<double>(k)));
    const double start = cpu_seconds();
    substances::Shares shares;
    for (const Vec3& x : cell) shares.add(substances::share_sphere(grid, x, kCellRadius));
    const double placed = cpu_seconds();
    const substances::Budget budget = substances::advance(grid, medium, {shares, exchange},
                                                          {kFieldStep, 0, 1e-6}, solver, field, {});
    if (step < kFieldWarmUp) continue;
    wall.push_back(cpu_seconds() - placed);
    shares_wall.push_back(placed - start);
    iterations += static_cast<double>(budget.iterations) / kFieldSteps;
    solves += static_cast<double>(budget.solves) / kFieldSteps;
  }
  std::ranges::sort(wall);
  std::ranges::sort(shares_wall);
  BenchRow row{c.name,
               static_cast<int>(cell.size()),
               {{"cpu_ms_per_step", 1e3 * wall[kFieldSteps / 2]},
                {"shares_ms_per_step", 1e3 * shares_wall[kFieldSteps / 2]},
                {"solves_per_step", solves},
                {"iterations_per_step", iterations}}};
  print_row(row);
  return row;
}

/// Substance that does not pass cells, or only through their membranes.
struct BarrierCase {
  std::string name;
  double permeability;  ///< um/s; 0: kept out
};

/// Cells rest: what they hold need not be carried to new voxels. Their shapes are found anew.
BenchRow measure_barrier(const BarrierCase& c) {
  constexpr double kCellRadius = 12, kTissueRadius = 290, kDiffusion = 100;
  const substances::VoxelGrid grid = substances::make_grid(
      {Vec3::Zero(), Vec3::Constant(kFieldVoxels * kFieldSpacing)}, kFieldSpacing);
  substances::Medium medium;
  medium.diffusion = kDiffusion;
  medium.face.fill({substances::FaceKind::kFixed, 1, 0});
  const std::vector<Vec3> cell = ball_of_cells(22, kTissueRadius);
  const substances::Shares no_shares;
  substances::Solver solver;
  solver.resize(grid.n);
  std::vector<double> field(grid.n_voxel(), 0.0), wall, shapes_wall;
  double iterations = 0;
  for (int step = 0; step < kFieldWarmUp + kFieldSteps; ++step) {
    const double start = cpu_seconds();
    substances::CoveredSpace covered(grid);
    substances::Parts parts;
    for (const Vec3& x : cell) {
      const substances::Cover cover = substances::cover_sphere(grid, x, kCellRadius);
      covered.add(cover);
      if (c.permeability > 0)
        substances::add_body(grid, cover, substances::share_sphere_by_area(grid, x, kCellRadius),
                             4 * kPi * kCellRadius * kCellRadius, parts);
    }
    const substances::OpenSpace space = covered.open(grid);
    field.resize(grid.n_voxel() + parts.n(), 0.0);
    const double placed = cpu_seconds();
    substances::Advance how{kFieldStep, 0, 1e-6};
    how.space = &space;
    how.parts = c.permeability > 0 ? &parts : nullptr;
    how.permeability = c.permeability;
    const substances::Budget budget =
        substances::advance(grid, medium, {no_shares, {}}, how, solver, field, {});
    if (step < kFieldWarmUp) continue;
    wall.push_back(cpu_seconds() - placed);
    shapes_wall.push_back(placed - start);
    iterations += static_cast<double>(budget.iterations) / kFieldSteps;
  }
  std::ranges::sort(wall);
  std::ranges::sort(shapes_wall);
  BenchRow row{c.name,
               static_cast<int>(cell.size()),
               {{"cpu_ms_per_step", 1e3 * wall[kFieldSteps / 2]},
                {"shares_ms_per_step", 1e3 * shapes_wall[kFieldSteps / 2]},
                {"solves_per_step", 1},
                {"iterations_per_step", iterations}}};
  print_row(row);
  return row;
}

}  // namespace

BenchTable bench_fields(const BenchOptions&) {
  using substances::FaceKind;
  BenchTable table;
  substances::Exchange secretes, linear, saturates;
  secretes.secretion = 0.01;
  linear.uptake = 0.17;
  saturates.uptake_max = 20;
  saturates.half_max = 1;
  const substances::FaceCondition closed{}, held{FaceKind::kFixed, 38, 0};
  for (const FieldCase& c :
       {FieldCase{"morphogen, D dt / h^2 = 6", 10, 1e-3, closed, 0, secretes},
        FieldCase{"oxygen, linear uptake, D dt / h^2 = 1200", 2000, 0, held, 38, linear},
        FieldCase{"oxygen, Michaelis-Menten uptake, D dt / h^2 = 1200", 2000, 0, held, 38,
                  saturates},
        FieldCase{"oxygen, linear uptake, closed box, D dt / h^2 = 1200", 2000, 0, closed, 38,
                  linear}})
    table.push_back(measure_field(c));
  for (const BarrierCase& c : {BarrierCase{"kept out of cells, D dt / h^2 = 60", 0},
                               BarrierCase{"membranes of 0.1 um/s, D dt / h^2 = 60", 0.1}})
    table.push_back(measure_barrier(c));
  return table;
}

}  // namespace acinus::bench
