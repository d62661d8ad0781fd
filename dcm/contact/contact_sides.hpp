#pragma once
/// Places of contacts on the cells, as the solver names them.

#include <cstddef>

#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/state.hpp"
#include "solve/links.hpp"

namespace acinus::dcm {

/// A place on a cell as the solver names it.
solve::Side side_at(const State& state, std::size_t lane, const contact::PointStencil& stencil);

/// Side a of a contact of a surface, and side b of one between surfaces.
solve::Side side_a(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& contact);
solve::Side side_b(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& contact);

}  // namespace acinus::dcm
