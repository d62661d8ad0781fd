#include "dcm/contact/contact_points.hpp"

namespace acinus::dcm {
namespace {

using contact::Contact;

/// Area of a point on the unit rest shape.
///
/// A triangle with points at nodes and edge midpoints gives a quarter of its area to the nodes and
/// three quarters to the midpoints: the node rule on the mesh whose every triangle is cut in four.
/// All points then weigh about the same (S/648 and S/640 with 162 nodes), so a crossing edge is
/// pushed out as hard as a node at the rim, and the error for a traction that is quadratic is a
/// quarter of the node rule's. No share at the nodes would be exact for it, but then they could not
/// push.
double rest_share(const geometry::Topology& t, contact::Quadrature q, int point) {
  constexpr double kNodeShare = 0.25, kMidpointShare = (1 - kNodeShare) / 3;
  const std::size_t p = point, n_node = t.n_node;
  switch (q) {
    case contact::Quadrature::kThreePoint:
      return t.rest_triangle_area[p / 3] / 3;
    case contact::Quadrature::kNodes:
      return t.rest_node_area[p];
    case contact::Quadrature::kNodesAndEdges:
      break;
  }
  if (p < n_node) return kNodeShare * t.rest_node_area[p];
  double area = 0;
  for (int face : t.edge_triangle[p - n_node]) area += kMidpointShare * t.rest_triangle_area[face];
  return area;
}

}  // namespace

double point_area(const geometry::Topology& t, contact::Quadrature q, int point, double radius) {
  return rest_share(t, q, point) * radius * radius;
}

double point_stretch(const contact::SurfaceBody& b, contact::Quadrature q, int point,
                     double radius) {
  const geometry::Topology& t = *b.topology;
  double present = 0, rest = 0;
  const auto count = [&](int triangle) {
    const auto& [i, j, k] = (*b.triangle)[triangle];
    present += 0.5 * (b.node[j] - b.node[i]).cross(b.node[k] - b.node[i]).norm();
    rest += t.rest_triangle_area[triangle];
  };
  if (contact::has_face_sites(q)) {
    count(point / 3);
  } else if (point < t.n_node) {
    for (int f = t.node_triangle_start[point]; f < t.node_triangle_start[point + 1]; ++f)
      count(t.node_triangle[f]);
  } else {
    for (int triangle : t.edge_triangle[point - t.n_node]) count(triangle);
  }
  return present / (rest * radius * radius);
}

contact::PointStencil stencil_of(const ContactParams& c, const contact::SurfaceBody& body,
                                 const Contact& o) {
  if (is_triangle_contact(c, o))
    return {3, (*body.triangle)[o.point], Contact::weights_at(o.place_a)};
  return probe_stencil(c, body, o);
}

contact::PointStencil probe_stencil(const ContactParams& c, const contact::SurfaceBody& body,
                                    const Contact& o) {
  const int n_node = static_cast<int>(body.node.size());
  if (!o.guard) return contact::point_stencil(body, c.quadrature, o.point);
  if (o.point < n_node) return {1, {o.point, 0, 0}, {1, 0, 0}};
  constexpr double kThird = 1.0f / 3;
  return {3, (*body.triangle)[o.point - n_node], {kThird, kThird, 1 - 2 * kThird}};
}

double guard_area(const geometry::Topology& t, int point, double radius) {
  const std::size_t k = point, n_node = t.n_node;
  return kGuardShare * radius * radius *
         (k < n_node ? t.rest_node_area[k] : t.rest_triangle_area[k - n_node]);
}

}  // namespace acinus::dcm
