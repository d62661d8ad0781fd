#include "dcm/contact/contact_sides.hpp"

#include "contact/vessel_side.hpp"
#include "dcm/contact/contact_points.hpp"

namespace acinus::dcm {

solve::Side side_at(const State& state, std::size_t lane, const contact::PointStencil& s) {
  auto point = [&](int m) {
    return static_cast<solve::Point>(
        (state.group[lane / kLanes].first_row + static_cast<std::size_t>(s.node[m])) * kLanes +
        lane % kLanes);
  };
  if (s.n == 1) return solve::Side::at(point(0));
  return {{point(0), point(1), point(2)},
          {static_cast<float>(s.weight[0]), static_cast<float>(s.weight[1])}};
}

solve::Side side_a(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& k) {
  const std::size_t body = k.a;
  return side_at(in.state, work.lane_of_body[body], stencil_of(in.options, work.body[body], k));
}

solve::Side side_b(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& k) {
  if (k.partner == contact::Partner::kVessel) {
    const contact::SurfaceBody& a = work.body[k.a];
    return contact::vessel_side(in.boundary.vessels, in.vessel_row, k.b,
                                contact::point_position(a, stencil_of(in.options, a, k)));
  }
  if (k.partner != contact::Partner::kSurface) return solve::Side::nowhere();
  const std::size_t body = k.b;
  return side_at(in.state, work.lane_of_body[body],
                 {3, (*work.body[body].triangle)[k.triangle], k.weights()});
}

}  // namespace acinus::dcm
