#include "dcm/tensions.hpp"

#include <cmath>
#include <numeric>

#include "core/parallel/threads.hpp"
#include "dcm/edge_tension.hpp"

namespace acinus::dcm {
namespace {

template <class Work>
void for_each_series_cell(std::span<const Params> params, const State& s, Work work) {
  for_each_index(s.n_lane(), worth_threads(s.n_row()), [&](std::size_t lane) {
    const Params& p = params[s.group[lane / kLanes].type];
    if (s.active(lane) && p.series_friction > 0) work(lane, p);
  });
}

}  // namespace

SeriesStep series_step(double stiffness, double friction, double step) {
  const double q = stiffness * step / friction;
  return {std::exp(-q), q > 0 ? -std::expm1(-q) / q : 1};
}

double edge_length(const State& s, std::size_t lane, std::size_t edge) {
  const auto& [i, j] = s.group[lane / kLanes].topology->edge[edge];
  return (load_point(s.position.data(), node_address(s, lane, j)) -
          load_point(s.position.data(), node_address(s, lane, i)))
      .norm();
}

void begin_tensions(std::span<const Params> params, State& s) {
  for_each_series_cell(params, s, [&](std::size_t lane, const Params&) {
    EdgeTension& t = s.tension[lane];
    if (!t.is_new()) return;
    const std::size_t n = s.group[lane / kLanes].topology->edge.size();
    t.force.assign(n, 0.0);
    t.length.resize(n);
    for (std::size_t e = 0; e < n; ++e) t.length[e] = edge_length(s, lane, e);
  });
}

void advance_tensions(std::span<const Params> params, double step, State& s) {
  for_each_series_cell(params, s, [&](std::size_t lane, const Params& p) {
    EdgeTension& t = s.tension[lane];
    const SeriesStep h = series_step(p.spring_stiffness, p.series_friction, step);
    for (std::size_t e = 0; e < t.force.size(); ++e) {
      const double length = edge_length(s, lane, e);
      t.force[e] = h.kept * t.force[e] + h.share * p.spring_stiffness * (length - t.length[e]);
      t.length[e] = length;
    }
  });
}

double mean_tension(const EdgeTension& t) {
  if (t.is_new()) return 0;
  return std::accumulate(t.force.begin(), t.force.end(), 0.0) / static_cast<double>(t.force.size());
}

EdgeTension make_tension(const geometry::Topology& topology, std::span<const Vec3> node,
                         double force) {
  EdgeTension t;
  t.force.assign(topology.edge.size(), force);
  for (const auto& [i, j] : topology.edge) t.length.push_back((node[j] - node[i]).norm());
  return t;
}

}  // namespace acinus::dcm
