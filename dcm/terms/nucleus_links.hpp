#pragma once
/// What is between nucleus and cortex while they do not touch: cytoskeleton and cytosol.

#include <vector>

#include "dcm/group_view.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Which nodes of the cortex the nodes of a nucleus are linked to: the nearest in direction.
/// [n_node of the nucleus]. Kept for the life of the program.
const std::vector<int>& shared_link_ends(const geometry::Topology& cortex,
                                         const geometry::Topology& nucleus);

/// One link of a cell.
struct NucleusLink {
  int nucleus = 0, cortex = 0;  ///< nodes
  double rest_length = 0;       ///< um
  double stiffness = 0;         ///< nN/um
  double friction = 0;          ///< nN s/um, the same in all directions
};

/// The link of a node of the nucleus. A strut that fills the solid angle w of the node from the
/// nucleus (radius r) to the cortex (R) is as stiff as a spring k = E w R r / (R - r); beside it a
/// dashpot of the same form with link_friction for E (Kelvin and Voigt), and the friction of the
/// node's area with the cytosol. At rest in a sphere: as long as there. Not in
/// [VanLiedekerke2020], whose cells have no inside (Fig. 1b shows it, the model leaves it out).
NucleusLink nucleus_link(const Nucleus& n, const GroupView& cortex, const GroupView& nuclei,
                         const std::vector<double>& ratio, int node, int lane);

/// Adds the links of all cells: E = 1/2 k (l - l0)^2, force = -dE/dx. To the matrix k along the
/// link and friction/h in all directions, and where it is tense T/l across: as
/// solve::System::point_links, which come after those of contacts.
void add_nucleus_links(const State& state, std::span<const Params> params, const LaneData& lanes,
                       solve::System& system);

/// Energy of one lane, fJ.
double nucleus_link_energy(const State& state, std::span<const Params> params,
                           const LaneData& lanes, std::size_t lane);

}  // namespace acinus::dcm
