#include "substances/membrane.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "substances/graph_solve.hpp"

namespace acinus::substances {
namespace {

/// Numbers of the unknowns among voxels and parts; -1: closed voxels that no membrane faces.
std::vector<int> number_unknowns(const VoxelGrid& grid, const Parts& parts,
                                 const StepSystem& system, int& n) {
  std::vector<int> number(system.own.size(), -1);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (system.own[v] > 0 || v >= grid.n_voxel()) number[v] = 0;
  for (const Parts::Membrane& m : parts.membrane) number[m.voxel] = 0;
  n = 0;
  for (int& at : number)
    if (at == 0) at = n++;
  return number;
}

/// Flow through a membrane per difference of concentrations, um^3. A part and the space around it
/// that lie in different voxels have the way between these in series, others a layer of a share of
/// a voxel: it bounds the contrast of the matrix where a membrane hardly resists.
double passage(const VoxelGrid& grid, const Parts& parts, const MembraneStep& how,
               const Parts::Membrane& m) {
  constexpr double kLayer = 1e-3;
  double resistance = 1 / how.permeability;
  if (how.diffusion > 0) {
    const auto [i, j, k] = grid.place(parts.voxel[m.part]);
    const auto [x, y, z] = grid.place(m.voxel);
    const double way = grid.spacing.cwiseProduct(Vec3(i - x, j - y, k - z)).norm();
    resistance += std::max(way, kLayer * grid.spacing.minCoeff()) / how.diffusion;
  }
  return how.step * m.area / resistance;
}

/// Open faces between voxels, faces inside bodies, membranes.
std::vector<GraphLink> list_links(const VoxelGrid& grid, const Parts& parts,
                                  const MembraneStep& how, const StepSystem& system,
                                  const std::vector<int>& number) {
  std::vector<GraphLink> links;
  const auto add = [&](std::size_t a, std::size_t b, double value) {
    if (value > 0 && number[a] >= 0 && number[b] >= 0)
      links.push_back({number[a], number[b], value});
  };
  std::size_t v = 0;
  for (int k = 0; k < grid.n[2]; ++k)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i, ++v)
        for (int axis = 0; axis < 3; ++axis) {
          std::array<int, 3> above{i, j, k};
          if (++above[axis] == grid.n[axis]) continue;
          const std::size_t face = grid.face_index(axis, above[0], above[1], above[2]);
          add(v, grid.index(above[0], above[1], above[2]),
              system.conductance[axis] * (*system.open)[axis][face]);
        }
  const std::size_t first = grid.n_voxel();
  for (const Parts::InnerFace& f : parts.inner)
    add(first + f.a, first + f.b, system.conductance[f.axis] * f.fraction);
  for (const Parts::Membrane& m : parts.membrane)
    add(first + m.part, m.voxel, passage(grid, parts, how, m) / grid.voxel_volume());
  return links;
}

}  // namespace

SolveResult solve_parts(const VoxelGrid& grid, const Parts& parts, const MembraneStep& how,
                        const StepSystem& system, double tolerance, std::span<double> c) {
  GraphSystem graph;
  int n = 0;
  const std::vector<int> number = number_unknowns(grid, parts, system, n);
  set_links(static_cast<std::size_t>(n), list_links(grid, parts, how, system, number), graph);
  graph.own.assign(static_cast<std::size_t>(n), 0.0);
  graph.rhs.assign(graph.own.size(), 0.0);
  std::vector<double> x(graph.own.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    const auto at = static_cast<std::size_t>(number[v]);
    graph.own[at] = system.own[v];
    graph.rhs[at] = system.rhs[v];
    x[at] = c[v];
  }
  GraphSolver solver;
  const SolveResult result = solver.solve(graph, tolerance, x);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] >= 0) c[v] = x[static_cast<std::size_t>(number[v])];
  return result;
}

}  // namespace acinus::substances
