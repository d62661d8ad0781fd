#include "dcm/loads/loads.hpp"

#include <algorithm>

#include "core/parallel/make_room.hpp"
#include "dcm/group_view.hpp"
#include "dcm/terms/area.hpp"
#include "dcm/terms/bending.hpp"
#include "dcm/terms/body_load.hpp"
#include "dcm/terms/cortex.hpp"
#include "dcm/terms/cortex_tension.hpp"
#include "dcm/terms/local_area.hpp"
#include "dcm/terms/matrix_shape.hpp"
#include "dcm/terms/medium.hpp"
#include "dcm/terms/nucleus_shell.hpp"
#include "dcm/terms/series_spring.hpp"
#include "dcm/terms/volume.hpp"

namespace acinus::dcm {
namespace {

bool any_volume(std::span<const Params> params) {
  return std::ranges::any_of(params, [](const Params& p) { return p.bulk_modulus > 0; });
}
bool any_area(std::span<const Params> params) {
  return std::ranges::any_of(params, [](const Params& p) { return p.area_modulus > 0; });
}
bool any_nucleus(std::span<const Params> params, double Nucleus::*modulus) {
  return std::ranges::any_of(
      params, [&](const Params& p) { return p.nucleus && (*p.nucleus).*modulus > 0; });
}

/// Rank-one families in their order in the system; null: no type needs it.
struct Families {
  solve::RankOne *volume = nullptr, *area = nullptr;
  solve::RankOne *nucleus_volume = nullptr, *nucleus_area = nullptr;
};
Families find_families(std::span<const Params> params, solve::System& s) {
  auto next = s.rank_one.begin();
  const auto take = [&](bool used) { return used ? &*next++ : nullptr; };
  Families f;
  f.volume = take(any_volume(params));
  f.area = take(any_area(params));
  f.nucleus_volume = take(any_nucleus(params, &Nucleus::bulk_modulus));
  f.nucleus_area = take(any_nucleus(params, &Nucleus::area_modulus));
  return f;
}

}  // namespace

void size_rank_one(const State& state, std::span<const Params> params, solve::System& s,
                   std::size_t n_further) {
  s.rank_one.resize(n_further + (any_volume(params) ? 1 : 0) + (any_area(params) ? 1 : 0) +
                    (any_nucleus(params, &Nucleus::bulk_modulus) ? 1 : 0) +
                    (any_nucleus(params, &Nucleus::area_modulus) ? 1 : 0));
  for (solve::RankOne& family : s.rank_one) {
    set_size(family.vector, state.position.size());
    set_size(family.coefficient, state.n_lane());
  }
}

void add_loads(const State& state, std::span<const Params> params, const LaneData& lanes,
               std::span<const double> medium_area, std::span<const Vec3> cell_force,
               solve::System& s) {
  const Families families = find_families(params, s);
  for_each_loaded_group(state, lanes, s, [&](const GroupView& g) {
    const std::size_t k = g.index;
    const Params& p = params[state.group[k].type];
    write_shape(g, s);
    if (p.series_friction > 0)
      add_series_springs(p, g, s);
    else if (p.spring_stiffness > 0 || p.nodal_friction > 0)
      add_cortex(p, g, s);
    if (p.bending_stiffness > 0) add_bending(p, g, s);
    if (p.cortex_tension > 0) add_cortex_tension(p, g, s);
    if (p.local_area_modulus > 0) add_local_area(p, g, s);
    if (families.volume) add_volume(p, g, s, *families.volume);
    if (families.area) add_area(p, g, s, *families.area);
    add_medium(p, g, medium_area.data() + g.first_row * kLanes, s);
    add_body_load(g, cell_force.subspan(k * kLanes, kLanes), s);
    if (state.group[k].nucleus.exists())
      add_nucleus_shell(nucleus_shell(p), view_nuclei(state, lanes, s, k), families.nucleus_volume,
                        families.nucleus_area, s);
  });
}

std::vector<std::string> skipped_terms(std::span<const Params> params) {
  std::vector<std::string> skipped;
  auto unless = [&](const char* name, auto used) {
    if (std::ranges::none_of(params, used)) skipped.emplace_back(name);
  };
  unless("springs of the cortex", [](const Params& p) { return p.spring_stiffness > 0; });
  unless("viscosity of the cortex", [](const Params& p) { return p.nodal_friction > 0; });
  unless("dashpots in series with the cortex",
         [](const Params& p) { return p.series_friction > 0; });
  unless("bending of the cortex", [](const Params& p) { return p.bending_stiffness > 0; });
  unless("active tension of the cortex", [](const Params& p) { return p.cortex_tension > 0; });
  unless("volume of deformable cells", [](const Params& p) { return p.bulk_modulus > 0; });
  unless("surface area of deformable cells", [](const Params& p) { return p.area_modulus > 0; });
  unless("area of single triangles", [](const Params& p) { return p.local_area_modulus > 0; });
  unless("nuclei", [](const Params& p) { return p.nucleus.has_value(); });
  return skipped;
}

}  // namespace acinus::dcm
