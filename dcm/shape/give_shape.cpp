#include "dcm/shape/give_shape.hpp"

#include <vector>

#include "dcm/shape/place_nucleus.hpp"

namespace acinus::dcm {

void give_shape(const Params& params, const GivenShape& shape, std::size_t lane, State& s) {
  const Group& group = s.group[lane / kLanes];
  store_nodes(shape.node, lane, s);
  s.birth[lane] =
      make_birth_shape(*group.topology, shape.node, shape.radius, shape.stretch, shape.weight);
  if (!group.nucleus.exists()) return;
  const std::vector<Vec3> nucleus =
      place_nucleus(group, shape.node, group.nucleus.size * shape.radius, params.nucleus->gap);
  store_nucleus(nucleus, lane, s);
  s.birth[lane].link = link_ratios(group, shape.radius, shape.node, nucleus);
}

}  // namespace acinus::dcm
