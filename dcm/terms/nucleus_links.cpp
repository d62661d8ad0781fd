#include "dcm/terms/nucleus_links.hpp"

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace acinus::dcm {
namespace {

std::vector<int> find_link_ends(const geometry::Topology& cortex,
                                const geometry::Topology& nucleus) {
  std::vector<int> end;
  for (const Vec3& x : nucleus.rest) {
    int nearest = 0;
    double most = -1;
    for (int j = 0; j < cortex.n_node; ++j) {
      const double cosine = x.normalized().dot(cortex.rest[j].normalized());
      if (cosine <= most) continue;
      most = cosine;
      nearest = j;
    }
    end.push_back(nearest);
  }
  return end;
}

/// Link at the present positions.
struct PlacedLink {
  NucleusLink link;
  Address nucleus = 0, cortex = 0;
  Vec3 direction = Vec3::UnitZ();  ///< from the nucleus to the cortex
  double length = 0;               ///< um

  double pull() const { return link.stiffness * (length - link.rest_length); }
};

/// Calls f(link) for the links of one cell, in the order of the nodes of its nucleus.
template <class F>
void for_each_link(const State& s, std::span<const Params> params, const LaneData& lanes,
                   std::size_t lane, F f) {
  const std::size_t k = lane / kLanes;
  const Group& group = s.group[k];
  const solve::System none;
  const GroupView cortex = view_group(s, lanes, none, k), nuclei = view_nuclei(s, lanes, none, k);
  for (int i = 0; i < group.nucleus.n_node(); ++i) {
    PlacedLink p;
    p.link = nucleus_link(*params[group.type].nucleus, cortex, nuclei, lanes.nucleus.link[k], i,
                          static_cast<int>(lane % kLanes));
    p.nucleus = node_address(s, lane, group.topology->n_node + i);
    p.cortex = node_address(s, lane, p.link.cortex);
    const Vec3 d =
        load_point(s.position.data(), p.cortex) - load_point(s.position.data(), p.nucleus);
    p.length = d.norm();
    if (p.length > 0) p.direction = d / p.length;
    f(p);
  }
}

solve::PointLink point_link(const PlacedLink& p, const Vec3& normal, double stiffness,
                            double friction) {
  solve::PointLink link{solve::point_at(p.nucleus),
                        solve::point_at(p.cortex),
                        {},
                        static_cast<float>(stiffness),
                        static_cast<float>(friction)};
  for (int m = 0; m < 3; ++m) link.normal[m] = static_cast<float>(normal[m]);
  return link;
}

void add_link(const PlacedLink& p, solve::System& s) {
  const double pull = p.pull();
  add_point(s.force.data(), p.nucleus, pull * p.direction);
  add_point(s.force.data(), p.cortex, -pull * p.direction);
  s.point_links.push_back(point_link(p, p.direction, p.link.stiffness, p.link.friction));
  if (!(pull > 0)) return;  // compression across a link is indefinite, so it is left out
  const Vec3 across = p.direction.unitOrthogonal();
  for (const Vec3& n : {across, Vec3(p.direction.cross(across))})
    s.point_links.push_back(point_link(p, n, pull / p.length, 0));
}

}  // namespace

const std::vector<int>& shared_link_ends(const geometry::Topology& cortex,
                                         const geometry::Topology& nucleus) {
  static std::mutex mutex;
  static std::map<std::pair<const geometry::Topology*, const geometry::Topology*>,
                  std::unique_ptr<std::vector<int>>>
      kept;
  const std::scoped_lock lock(mutex);
  auto& entry = kept[{&cortex, &nucleus}];
  if (!entry) entry = std::make_unique<std::vector<int>>(find_link_ends(cortex, nucleus));
  return *entry;
}

NucleusLink nucleus_link(const Nucleus& n, const GroupView& cortex, const GroupView& nuclei,
                         const std::vector<double>& ratio, int node, int lane) {
  const geometry::Topology& t = *nuclei.topology;
  const double outer = cortex.radius[lane], inner = nuclei.radius[lane];
  const double share = t.rest_node_area[node] / t.rest_area;
  const double form = 4 * kPi * share * outer * inner / (outer - inner);
  NucleusLink link;
  link.nucleus = node;
  link.cortex = shared_link_ends(*cortex.topology, t)[node];
  link.rest_length = (outer * cortex.topology->rest[link.cortex] - inner * t.rest[node]).norm();
  if (!ratio.empty()) link.rest_length *= ratio[node * kLanes + lane];
  link.stiffness = n.link_young * form;
  link.friction = n.link_friction * form + n.friction * t.rest_node_area[node] * inner * inner;
  return link;
}

void add_nucleus_links(const State& s, std::span<const Params> params, const LaneData& lanes,
                       solve::System& system) {
  for (std::size_t l = 0; l < s.n_lane(); ++l)
    if (s.group[l / kLanes].nucleus.exists() && lanes.active[l] != 0)
      for_each_link(s, params, lanes, l, [&](const PlacedLink& p) { add_link(p, system); });
}

double nucleus_link_energy(const State& s, std::span<const Params> params, const LaneData& lanes,
                           std::size_t lane) {
  double energy = 0;
  for_each_link(s, params, lanes, lane, [&](const PlacedLink& p) {
    energy += 0.5 * p.pull() * (p.length - p.link.rest_length);
  });
  return lanes.active[lane] * energy;
}

}  // namespace acinus::dcm
