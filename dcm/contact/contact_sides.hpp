#pragma once
/// Sides of contacts on the cells, in the numbering of the solver.

#include <cstddef>

#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/state.hpp"
#include "solve/links.hpp"

namespace acinus::dcm {

/// Side of a link at a stencil of a cell.
solve::Side side_at(const State& state, std::size_t lane, const contact::PointStencil& stencil);

/// Side a of a contact of a surface, and side b of a contact between surfaces.
solve::Side side_a(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& contact);
solve::Side side_b(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& contact);

}  // namespace acinus::dcm
