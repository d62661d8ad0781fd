#include "coupling/apparatus/stretcher/stretch_load.hpp"

#include <cmath>
#include <vector>

namespace acinus::coupling {
namespace {

/// Area vectors of all nodes of a lane, 6 dV/dx.
void compute_gradients(const geometry::Topology& t, const std::vector<Vec3>& arm,
                       std::vector<Vec3>& gradient) {
  gradient.assign(arm.size(), Vec3::Zero());
  for (const auto& [a, b, c] : t.triangle) {
    gradient[a] += arm[b].cross(arm[c]);
    gradient[b] += arm[c].cross(arm[a]);
    gradient[c] += arm[a].cross(arm[b]);
  }
}

}  // namespace

void add_stretch_load(const dcm::GroupView& g, const StretchLoad& load, solve::System& s) {
  const geometry::Topology& t = *g.topology;
  thread_local std::vector<Vec3> arm, force;  // a warmed-up step allocates nothing
  arm.resize(t.n_node);
  for (int l = 0; l < kLanes; ++l) {
    if (g.active[l] == 0) continue;
    Vec3 center = Vec3::Zero();
    for (int i = 0; i < t.n_node; ++i) {
      arm[i] = load_point(g.position, make_address(i, l));
      center += t.rest_node_area[i] / t.rest_area * arm[i];
    }
    for (Vec3& a : arm) a -= center;
    compute_gradients(t, arm, force);
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < t.n_node; ++i) {
      const double cosine = std::abs(arm[i].dot(load.axis)) / arm[i].norm();
      force[i] *= load.stress / 6 * std::pow(cosine, load.exponent);
      sum += force[i];
    }
    for (int i = 0; i < t.n_node; ++i)
      add_point(s.external_force.data(), make_address(g.first_row + i, l),
                force[i] - t.rest_node_area[i] / t.rest_area * sum);
  }
}

}  // namespace acinus::coupling
