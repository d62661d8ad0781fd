#include "runs/session/skipped.hpp"

#include <fmt/format.h>

#include "dcm/loads/loads.hpp"

namespace acinus::runs {

std::vector<std::string> list_skipped(const coupling::World& world) {
  const coupling::State& s = world.state;
  std::vector<std::string> list;
  if (s.dcm.group.empty())
    list.emplace_back("deformable cells");
  else
    list = dcm::skipped_terms(world.params.dcm);
  if (s.cbm.n_cell() == 0) list.emplace_back("spheres");
  if (s.dcm.group.empty() || s.cbm.n_cell() == 0)
    list.emplace_back("contact of deformable cells with spheres");
  if (world.params.boundary.empty()) list.emplace_back("walls and vessels");
  if (!world.params.motility.random) list.emplace_back("random motility");
  if (world.params.motility.leader_force <= 0) list.emplace_back("leading cells");
  return list;
}

std::vector<std::string> list_skipped_work(const coupling::World& world,
                                           const coupling::Workspace& work) {
  std::vector<std::string> list;
  auto share = [&](const char* what, std::int64_t done, std::int64_t of) {
    if (of > 0 && done < of)
      list.push_back(fmt::format("{} in {:.0f} % of cases", what,
                                 100 * (1 - static_cast<double>(done) / static_cast<double>(of))));
  };
  share("contact lists of deformable cells", work.dcm.lists.made, work.dcm.lists.checked);
  share("search at listed contact points", work.dcm.points_seen, work.dcm.points_listed);
  if (world.state.cbm.n_cell() > 0)
    share("lists of pairs of spheres", work.cbm.list_builds, work.cbm.searches);
  if (!world.state.dcm.group.empty() && !world.state.clock.coarse)
    list.emplace_back("coarse space of the solver, at the end");
  return list;
}

}  // namespace acinus::runs
