#include "dcm/birth_shape.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/measures.hpp"

namespace acinus::dcm {

void drop_forgotten(double time, std::span<BirthShape> shapes) {
  for (BirthShape& b : shapes)
    if (b.is_forgotten(time)) b = {};
}

BirthShape make_birth_shape(const geometry::Topology& t, std::span<const Vec3> node, double radius,
                            double stretch, const Ramp& weight) {
  BirthShape shape;
  shape.weight = weight;
  std::vector<double> edge, triangle;
  edge.reserve(t.edge.size());
  triangle.reserve(t.triangle.size());
  const auto at = [&](int i) -> const Vec3& { return node[i]; };
  for (std::size_t e = 0; e < t.edge.size(); ++e)
    edge.push_back((at(t.edge[e][1]) - at(t.edge[e][0])).norm() /
                   (t.rest_length[e] * radius * std::sqrt(stretch)));
  double area = 0;
  for (std::size_t f = 0; f < t.triangle.size(); ++f) {
    const auto& [i, j, k] = t.triangle[f];
    const double own = 0.5 * (at(j) - at(i)).cross(at(k) - at(i)).norm();
    triangle.push_back(own / (t.rest_triangle_area[f] * radius * radius * stretch));
    area += own;
  }
  shape.edge = std::move(edge);
  shape.triangle = std::move(triangle);
  shape.area = area / (t.rest_area * radius * radius * stretch);
  return shape;
}

double measure_stretch(const BirthShape& shape, const geometry::Topology& topology,
                       std::span<const Vec3> node, double radius, double time) {
  const double rest = shape.is_forgotten(time) ? 1 : 1 + shape.weight.at(time) * (shape.area - 1);
  return geometry::compute_area(node, topology.triangle) /
         (topology.rest_area * radius * radius * rest);
}

}  // namespace acinus::dcm
