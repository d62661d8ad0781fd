#include "coupling/measure/memory_use.hpp"

#include "core/parallel/row_vector.hpp"

namespace acinus::coupling {
namespace {

template <class List>
std::size_t memory_of_all(const std::vector<List>& lists) {
  std::size_t bytes = memory_of(lists);
  for (const List& list : lists) bytes += memory_of(list);
  return bytes;
}

std::size_t measure_positions(const State& s) {
  return memory_of(s.dcm.position) + memory_of(s.cbm.position) + memory_of(s.near);
}

/// Shapes of birth, tensions of edges, and all that a state has of single cells.
std::size_t measure_cell_data(const State& s) {
  std::size_t bytes = memory_of(s.dcm.lineage) + memory_of(s.dcm.volume) + memory_of(s.dcm.pull) +
                      memory_of(s.cbm.lineage) + s.cbm.type.memory() + memory_of(s.cbm.volume) +
                      s.cbm.strength.memory() + s.cbm.young.memory() + s.cbm.pull.memory() +
                      memory_of(s.leader) + memory_of(s.asleep) + memory_of(s.cycle) +
                      s.holder.memory() + s.cell_holder.memory();
  for (const dcm::BirthShape& b : s.dcm.birth)
    bytes += sizeof b + b.edge.memory() + b.triangle.memory() + b.link.memory();
  for (const dcm::EdgeTension& t : s.dcm.tension)
    bytes += sizeof t + memory_of(t.force) + memory_of(t.length);
  return bytes;
}

std::size_t measure_lanes(const dcm::LaneData& d) {
  return memory_of(d.radius) + memory_of(d.area) + memory_of(d.active) + memory_of_all(d.edge) +
         memory_of_all(d.triangle) + memory_of_all(d.tension) + memory_of_all(d.length) +
         memory_of(d.nucleus.radius) + memory_of(d.nucleus.unit) + memory_of_all(d.nucleus.link);
}

std::size_t measure_bodies(const dcm::ContactWorkspace& w) {
  std::size_t bytes = memory_of(w.lane_of_body) + memory_of(w.is_complete) + memory_of(w.body);
  for (const contact::SurfaceBody& b : w.body)
    bytes += memory_of(b.node) + memory_of(b.node_normal) + memory_of(b.normal) +
             memory_of(b.center) + memory_of(b.reach);
  return bytes + memory_of_all(w.share);
}

std::size_t measure_lists(const dcm::ContactLists& lists) {
  std::size_t bytes = memory_of(lists.body) + memory_of(lists.pair) + memory_of(lists.age);
  for (const contact::Candidates& c : lists.pair) bytes += c.list.memory();
  for (const dcm::SegmentCandidates& c : lists.segment)
    bytes += sizeof c + memory_of(c.site) + memory_of(c.start) + memory_of(c.segment);
  for (const dcm::ListedBody& b : lists.body) bytes += memory_of(b.latest.node) + memory_of(b.time);
  return bytes;
}

std::size_t measure_contacts(const Workspace& w) {
  return memory_of(w.contacts.all) + memory_of_all(w.dcm.wall) + memory_of(w.interface.near);
}

std::size_t measure_links(const Workspace& w) {
  return memory_of(w.system.links.link) + memory_of(w.system.links.law) +
         memory_of(w.system.point_links);
}

std::size_t measure_sphere_lists(const cbm::ContactWorkspace& w) {
  return memory_of(w.pair) + memory_of(w.segment) + memory_of(w.overlap_sum) +
         memory_of(w.coupling) + memory_of(w.scratch) + memory_of(w.ghost);
}

std::size_t measure_touching(const State& s, const cbm::ContactWorkspace& w) {
  return memory_of(s.cbm.touching) + memory_of(w.touching) + memory_of_all(w.touching_part);
}

/// Sizes, leaders and costs of cells.
std::size_t measure_cell_work(const Workspace& w) {
  return memory_of(w.leader) + memory_of(w.forces.dcm) + memory_of(w.medium_friction.dcm) +
         memory_of(w.cost.of_cell);
}

std::size_t measure_numbering(const Workspace& w) {
  return w.system.block.memory() + memory_of(w.system.ownership.owner) + memory_of(w.active) +
         memory_of(w.rigid.cells.of_cell) + memory_of(w.near.box) + memory_of(w.near.send) +
         memory_of(w.near.receive);
}

}  // namespace

std::vector<MemoryUse> measure_memory(const State& s, Workspace& w) {
  std::size_t rows = 0;
  for_each_row_array(w, [&](const auto& v) { rows += memory_of(v); });
  return {{"positions", measure_positions(s)},
          {"last_move", memory_of(s.last_move)},
          {"cell_data", measure_cell_data(s)},
          {"linearisation_state", measure_positions(w.linearisation.state) +
                                      memory_of(w.linearisation.state.last_move) +
                                      measure_cell_data(w.linearisation.state)},
          {"lanes", measure_lanes(w.lanes)},
          {"bodies", measure_bodies(w.dcm)},
          {"lists", measure_lists(w.dcm.lists)},
          {"contacts", measure_contacts(w)},
          {"links", measure_links(w)},
          {"shares_of_links", w.op.memory()},
          {"rows", rows},
          {"sphere_lists", measure_sphere_lists(w.cbm)},
          {"touching", measure_touching(s, w.cbm)},
          {"coarse", w.coarse.memory()},
          {"cell_work", measure_cell_work(w)},
          {"numbering", measure_numbering(w)}};
}

}  // namespace acinus::coupling
