#include "dcm/loads/stress.hpp"

#include <cmath>

#include "dcm/terms/area.hpp"
#include "dcm/terms/cortex_tension.hpp"

namespace acinus::dcm {

namespace {

double edge_force(const Params& p, const GroupView& g, std::size_t edge, int lane, double length) {
  if (p.series_friction > 0) return g.tension ? g.tension[edge * kLanes + lane] : 0;
  return p.spring_stiffness * (length - rest_length(g, edge, lane));
}

}  // namespace

std::vector<double> compute_node_tension(const Params& p, const GroupView& g, int lane) {
  const geometry::Topology& t = *g.topology;
  std::vector<double> tension(t.n_node, 0.0);
  for (std::size_t e = 0; e < t.edge.size(); ++e) {
    const std::size_t i = t.edge[e][0], j = t.edge[e][1];
    const double length = (load_point(g.position, make_address(j, lane)) -
                           load_point(g.position, make_address(i, lane)))
                              .norm();
    const double pull = edge_force(p, g, e, lane, length) / length;
    tension[i] += pull;
    tension[j] += pull;
  }
  double membrane = 0;
  if (p.area_modulus > 0) {
    const double a0 = rest_area(g, lane);
    membrane = p.area_modulus * (compute_areas(g)[lane] - a0) / a0;
  }
  for (std::size_t i = 0; i < tension.size(); ++i) {
    const int neighbours = t.ring_start[i + 1] - t.ring_start[i];
    tension[i] = std::sqrt(3.0) / neighbours * tension[i] + membrane;
  }
  if (p.cortex_tension > 0) add_active_tension(p, g, lane, tension);
  return tension;
}

}  // namespace acinus::dcm
