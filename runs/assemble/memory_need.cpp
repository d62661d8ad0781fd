#include "runs/assemble/memory_need.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/parallel/memory.hpp"
#include "coupling/generate/domain.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/assemble/build_substances.hpp"
#include "runs/assemble/place_cells.hpp"

namespace acinus::runs {
namespace {

// Measured where cells touch all around (docs/developers/benchmarks.md: bytes_per_cell); with few
// contacts a third of it.
constexpr double kBytesPerNode = 450, kBytesPerSphere = 900;
/// Part of it that every process has of all cells, by `acinus-bench rank-memory`: the state.
constexpr double kBytesPerNodeEverywhere = 90, kBytesPerSphereEverywhere = 270;
/// Memory of a branch point, bytes: its nodes, segments, wall and search grids.
constexpr double kBytesPerBranch = 2000;

/// Least memory of a cell, bytes, in a process that owns one of n_process cells: with the smallest
/// mesh among the cell types, since types are not drawn yet.
double bytes_per_cell(const Scene& scene, int n_process) {
  const auto per_process = [&](double all, double everywhere) {
    return everywhere + (all - everywhere) / n_process;
  };
  if (model_of(scene) != CellModel::kDcm)
    return per_process(kBytesPerSphere, kBytesPerSphereEverywhere);
  int nodes = std::numeric_limits<int>::max();
  for (const auto& [name, type] : scene.cell_types) nodes = std::min(nodes, type.dcm.nodes);
  return per_process(kBytesPerNode, kBytesPerNodeEverywhere) * nodes;
}

double count_branches(const Scene& scene) {
  if (!scene.lobule) return 0;
  return scene.lobule->branch_density * coupling::make_domain(lobule_parameters(scene)).volume;
}

/// Memory of fields in a box that the scene gives, bytes; others are checked when cells are placed.
double bytes_of_fields(const Scene& scene) {
  const SubstanceGridBlock& g = scene.substance_grid;
  if (scene.substances.empty() || !g.box) return 0;
  double spacing = g.spacing;
  if (spacing == 0) {
    spacing = std::numeric_limits<double>::infinity();
    for (const auto& [name, type] : scene.cell_types) spacing = std::min(spacing, type.radius);
  }
  return substance_memory(substances::count_voxels({(*g.box)[0], (*g.box)[1]}, spacing),
                          scene.substances);
}

std::string in_gigabytes(double bytes) { return fmt::format("{:.3g} GB", 1e-9 * bytes); }

}  // namespace

double share_of_memory(int n_process) {
  constexpr double kMostMemoryShare = 0.95;
  return kMostMemoryShare * machine_memory() / n_process;
}

double estimate_memory(const Scene& scene, int n_process) {
  return count_wanted_cells(scene) * bytes_per_cell(scene, n_process) +
         count_branches(scene) * kBytesPerBranch + bytes_of_fields(scene);
}

void check_memory(const Scene& scene, double limit, int n_process) {
  const double needed = estimate_memory(scene, n_process);
  if (needed <= limit) return;
  const double vessels = count_branches(scene) * kBytesPerBranch;
  const std::string what =
      2 * bytes_of_fields(scene) > needed
          ? std::string(
                "fields of substances. Take a larger substance_grid.spacing or a smaller "
                "substance_grid.box")
      : 2 * vessels > needed
          ? fmt::format(
                "{:.3g} branch points of vessels. Take a smaller lobule.height or radius, "
                "or a smaller lobule.branch_density",
                count_branches(scene))
          : fmt::format(
                "{:.3g} cells. Take fewer (cells, lobule.cells), coarser meshes "
                "(dcm.nodes), spheres (model cbm), or more processes (mpirun)",
                count_wanted_cells(scene));
  throw Error(
      fmt::format("{}: needs at least {} of memory{} where {} are allowed, most of it for "
                  "{}; or allow more with --max-memory.",
                  scene.file, in_gigabytes(needed), n_process > 1 ? " in every process" : "",
                  in_gigabytes(limit), what));
}

}  // namespace acinus::runs
