#pragma once
/// Friction between deformable cells from node to node [VanLiedekerke2020].
///
/// In a contact with the area A the nodes of the one triangle have friction with those of the
/// other, isotropic in their relative velocity: "each node associated with this triangle acquires a
/// contact area A/3" [VanLiedekerke2020, Eq. (1) term 2, and below Eq. (17)]. Each of the three
/// nodes shares its third among the three opposite ones, so that all nine pairs have A/9: a sum
/// that does not jump when another node becomes the nearest one. With the means v, w of the nodes'
/// velocities
///
///     sum_ij A/9 |v_i - w_j|^2 = A (|v - w|^2 + mean |v_i - v|^2 + mean |w_j - w|^2)
///
/// The first part is the friction between facing places; the others resist the stretch and rotation
/// of a triangle even if its partner follows. They shrink with the square of the edges, and they do
/// not vanish under rotation (decision 26).

#include <vector>

#include "dcm/contact/contact_workspace.hpp"
#include "solve/links.hpp"

namespace acinus::dcm {

/// Appends the friction between the cells' nodes, one link for every pair of nodes. A contact point
/// that is a node stands for itself, one in the middle of an edge for the two nodes of the edge, a
/// contact of a triangle for its three.
/// @pre all shares are known
void add_node_friction(const ContactInput& in, const ContactWorkspace& work,
                       const contact::ContactList& contacts, solve::PointLinks& links);

}  // namespace acinus::dcm
