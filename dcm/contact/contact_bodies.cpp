#include "dcm/contact/contact_bodies.hpp"

#include "core/parallel/threads.hpp"
#include "core/sort_unique.hpp"

namespace acinus::dcm {
namespace {

void complete_body(const State& state, std::size_t k, ContactWorkspace& work) {
  copy_nodes(state, work.lane_of_body[k], work.body[k].node);
  contact::refresh_nodes(work.body[k]);
  work.is_complete[k] = 1;
}

/// Returns the memory of a body of which only the box is needed.
void release_body(contact::SurfaceBody& b) {
  for (auto* v : {&b.node, &b.node_normal}) *v = std::vector<Vec3>();
}

}  // namespace

void refresh_bodies(const State& state, ContactWorkspace& work) {
  std::size_t n = 0;
  const auto is_body = [&](std::size_t l) { return state.active(l) && !work.is_absent(l); };
  for (std::size_t l = 0; l < state.n_lane(); ++l) n += is_body(l) ? 1 : 0;
  if (work.lane_of_body.size() != n) {
    work.lane_of_body.clear();
    for (std::size_t l = 0; l < state.n_lane(); ++l)
      if (is_body(l)) work.lane_of_body.push_back(l);
  }
  work.body.resize(n);
  if (work.is_complete.size() != n) work.is_complete.assign(n, 0);
  for_each_index(n, worth_threads(state.n_row()), [&](std::size_t k) {
    contact::SurfaceBody& b = work.body[k];
    const bool was_complete = work.is_complete[k] != 0;
    work.is_complete[k] = 0;
    b.topology = state.group[work.lane_of_body[k] / kLanes].topology;
    b.triangle = &b.topology->triangle;
    if (!work.is_ghost_body(k)) return complete_body(state, k, work);
    if (!was_complete) release_body(b);
    b.box = Box{};
    for (int i = 0; i < b.topology->n_node; ++i)
      b.box.include(
          load_point(state.position.data(), node_address(state, work.lane_of_body[k], i)));
  });
}

void complete_bodies(const State& state, std::span<const int> bodies, ContactWorkspace& work) {
  std::vector<int> missing;
  for (const int b : bodies)
    if (work.is_complete[b] == 0) missing.push_back(b);
  if (missing.empty()) return;
  sort_unique(missing);
  for_each_index(missing.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    complete_body(state, static_cast<std::size_t>(missing[k]), work);
  });
}

void copy_all_nodes(const State& state, ContactWorkspace& work) {
  for (std::size_t b = 0; b < work.body.size(); ++b)
    if (work.is_complete[b] == 0) copy_nodes(state, work.lane_of_body[b], work.body[b].node);
}

}  // namespace acinus::dcm
