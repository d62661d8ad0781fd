#include "coupling/step/workspace_size.hpp"

#include <span>
#include <utility>
#include <vector>

#include "core/parallel/memory.hpp"
#include "coupling/step/ghost_cells.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/sharing.hpp"
#include "dcm/loads/loads.hpp"

namespace acinus::coupling {
namespace {

/// Rows of anchored tree nodes and of their rotations.
std::vector<std::size_t> anchored_rows(const World& world) {
  std::vector<std::size_t> rows;
  if (world.state.tree.node.empty()) return rows;
  const VesselTree& tree = world.params.tree;
  for (std::size_t i = 0; i < 2 * tree.n_node(); ++i)
    if (tree.anchored[i % tree.n_node()] != 0) rows.push_back(tree_first_row(world.state) + i);
  return rows;
}

}  // namespace

void size_workspace(const World& world, Workspace& w) {
  const State& s = world.state;
  std::span<const std::uint8_t> constrained = w.constraint.cell;
  if (w.constraint.applies()) constrained = constrained.first(s.dcm.n_lane());
  solve::Blocks blocks = dcm::make_blocks(s.dcm, world.params.dcm, constrained);
  cbm::append_blocks(s.cbm, blocks);
  w.tree_block = blocks.size();
  if (!s.tree.node.empty()) blocks.append({.pattern = &world.params.tree.pattern});
  w.constraint.anchored_row = anchored_rows(world);
  w.boundary.reset();
  dcm::size_rank_one(s.dcm, world.params.dcm, w.system, world.params.apparatus.count_rank_one());
  w.system.ownership = share_blocks(world, blocks, w.cost);
  if (!w.system.ownership.is_whole()) for_each_row_array(w, [](auto& v) { release_rows(v); });
  solve::set_blocks(w.system, std::move(blocks));
  mark_ghost_cells(world, w);
  w.active = active_lanes(s);
  for (auto* v : {&w.rhs, &w.move}) {
    set_size(*v, w.system.n_dof());
    solve::clear_own_rows(w.system, kPointStride, *v);
  }
  ++w.sized;
  begin_contacts(world, w);
}

void begin_contacts(const World& world, Workspace& w) {
  w.dcm.lane_of_body.clear();
  w.cbm.list_position.clear();
  w.dcm.fixed.clear();
  for (const contact::StaticMesh& m : world.params.boundary.meshes) w.dcm.fixed.push_back(m.body);
  if (world.params.boundary.vessels.wall)
    w.dcm.fixed.push_back(world.params.boundary.vessels.wall->surface.body);
}

void release_solve(Workspace& w) {
  w.cg = {};
  w.rigid.mode = RowVector<double>();  // assigning {} would keep the memory
  w.linearisation = {};
  return_freed_memory();
}

void release_scratch(Workspace& w) {
  w.op.release();
  release_solve(w);
}

void size_workspace(World& world, Workspace& w) {
  size_workspace(std::as_const(world), w);
  hand_over_contacts(world.ranks, w, world.state);
  hand_over_cells(world, w);
}

}  // namespace acinus::coupling
