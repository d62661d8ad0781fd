#include "dcm/terms/nucleus_shell.hpp"

#include "dcm/terms/area.hpp"
#include "dcm/terms/bending.hpp"
#include "dcm/terms/cortex.hpp"
#include "dcm/terms/matrix_shape.hpp"
#include "dcm/terms/volume.hpp"

namespace acinus::dcm {

Params nucleus_shell(const Params& p) {
  const Nucleus& n = *p.nucleus;
  Params shell = params_without_terms();
  shell.spring_stiffness = cortex_spring_stiffness(n.young, n.thickness);
  shell.bending_stiffness = cortex_bending_stiffness(n.young, n.thickness, n.poisson);
  shell.fold_repulsion = p.fold_repulsion;
  shell.area_modulus = n.area_modulus;
  shell.bulk_modulus = n.bulk_modulus;
  shell.nodal_friction = p.nodal_friction;
  shell.friction_across = p.friction_across;
  return shell;
}

void add_nucleus_shell(const Params& shell, const GroupView& g, solve::RankOne* volume,
                       solve::RankOne* area, solve::System& s) {
  write_shape(g, s);
  if (shell.spring_stiffness > 0 || shell.nodal_friction > 0) add_cortex(shell, g, s);
  if (shell.bending_stiffness > 0) add_bending(shell, g, s);
  if (volume != nullptr) add_volume(shell, g, s, *volume);
  if (area != nullptr) add_area(shell, g, s, *area);
  const Lane idle = 1.0 - load(g.active);
  for (int i = 0; i < g.topology->n_node; ++i)
    add_to(s.medium.data() + (g.first_row + i) * kLanes, idle);
}

double nucleus_shell_energy(const Params& shell, const GroupView& g, int lane) {
  return cortex_energy(shell, g, lane) + bending_energy(shell, g, lane) +
         volume_energy(shell, g, lane) + area_energy(shell, g, lane);
}

}  // namespace acinus::dcm
