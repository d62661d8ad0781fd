#pragma once
/// Links of nucleus and cortex, the cytoskeleton and cytosol between them.

#include <vector>

#include "dcm/group_view.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Node of the cortex linked to each node of a nucleus, [n_node of the nucleus]: the nearest in
/// direction. Kept for the life of the program.
const std::vector<int>& shared_link_ends(const geometry::Topology& cortex,
                                         const geometry::Topology& nucleus);

/// One link of a cell.
struct NucleusLink {
  int nucleus = 0, cortex = 0;  ///< nodes
  double rest_length = 0;       ///< um
  double stiffness = 0;         ///< nN/um
  double friction = 0;          ///< nN s/um, the same in all directions
};

/// Link of a node of the nucleus. A strut that fills the solid angle w of the node from the nucleus
/// (radius r) to the cortex (R) is as stiff as a spring k = E w R r / (R - r); parallel to it are a
/// dashpot of the same form with link_friction for E (Kelvin and Voigt), and the friction of the
/// node's area with the cytosol. The rest length is that in a sphere. Not in [VanLiedekerke2020],
/// whose cells have no inside (Fig. 1b shows it, the model leaves it out).
NucleusLink nucleus_link(const Nucleus& n, const GroupView& cortex, const GroupView& nuclei,
                         const std::vector<double>& ratio, int node, int lane);

/// Adds the links of all cells: E = 1/2 k (l - l0)^2, force = -dE/dx. The matrix gets k along the
/// link, friction/h in all directions and, under a tension T, T/l across, stored as
/// solve::System::point_links after those of contacts.
void add_nucleus_links(const State& state, std::span<const Params> params, const LaneData& lanes,
                       solve::System& system);

/// Energy of one lane, fJ.
double nucleus_link_energy(const State& state, std::span<const Params> params,
                           const LaneData& lanes, std::size_t lane);

}  // namespace acinus::dcm
