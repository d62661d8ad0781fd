#include "coupling/measure/contact_list.hpp"

#include <algorithm>
#include <tuple>

#include "contact/cohesive.hpp"
#include "coupling/measure/cell_numbers.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_points.hpp"

namespace acinus::coupling {
namespace {

using contact::Contact, contact::Partner;

/// Areas of single contacts, on the same scale as CellMeasure::contact_area. Those of ghost cells
/// are 0: only the owner of a cell knows what else its points touch.
class ContactAreas {
 public:
  ContactAreas(const World& world, const Workspace& w, const std::vector<CellMeasure>& cells)
      : options_(world.params.dcm_contact),
        w_(w),
        cells_(cells),
        numbers_(number_cells(world.state, w)) {
    for (std::size_t k = 0; k < w.dcm.body.size(); ++k) {
      double whole = 0;
      const std::size_t n = contact::n_points(w.dcm.body[k], options_.quadrature);
      for (std::size_t p = 0; p < n; ++p) whole += point_area(k, static_cast<int>(p));
      scale_.push_back(whole > 0 ? cells[numbers_.of_body[k]].area / whole : 0);
    }
  }

  /// um^2 of side a.
  double of_a(const Contact& k) const {
    if (k.point == contact::kWhole) return w_.cbm.is_ghost(k.a) ? 0 : k.touching;
    const auto body = static_cast<std::size_t>(k.a);
    if (w_.dcm.is_ghost_body(body)) return 0;
    if (dcm::is_triangle_contact(options_, k)) return of_triangle(body, k.point, k.touching);
    if (k.partner != Partner::kSurface && k.partner != Partner::kMesh && k.only_pushes()) return 0;
    return share_of(k) * of_point(body, k.point);
  }

  /// um^2 of side b.
  double of_b(const Contact& k) const {
    const bool triangles = dcm::is_triangle_contact(options_, k);
    if (k.partner == Partner::kSphere) {
      if (w_.cbm.is_ghost(k.b)) return 0;
      return triangles || k.point == contact::kWhole ? k.touching
                                                     : share_of(k) * point_area(k.a, k.point);
    }
    if (k.partner != Partner::kSurface || w_.dcm.is_ghost_body(k.b)) return 0;
    // Points of b have contacts of their own.
    return triangles ? of_triangle(k.b, k.triangle, k.touching) : 0;
  }

 private:
  double point_area(std::size_t body, int point) const {
    return dcm::point_area(*w_.dcm.body[body].topology, options_.quadrature, point,
                           cells_[numbers_.of_body[body]].radius);
  }
  double share_of(const Contact& k) const {
    return contact::contact_share(k.gap, options_.friction_range);
  }
  /// Area with which a point that touches several partners counts with all of them.
  double of_point(std::size_t body, int point) const {
    return scale_[body] * dcm::share_scale(w_.dcm.share[body][point]) * point_area(body, point);
  }
  double of_triangle(std::size_t body, int triangle, double touching) const {
    const contact::SurfaceBody& b = w_.dcm.body[body];
    const auto& corner = (*b.triangle)[triangle];
    const Vec3 &x = b.node[corner[0]], &y = b.node[corner[1]], &z = b.node[corner[2]];
    double area = 0;
    for (int q = 0; q < 3; ++q) area += of_point(body, 3 * triangle + q);
    return touching / (0.5 * (y - x).cross(z - x).norm()) * area;
  }

  const dcm::ContactParams& options_;
  const Workspace& w_;
  const std::vector<CellMeasure>& cells_;
  CellNumbers numbers_;
  std::vector<double> scale_;  ///< [body] present area over that of its points
};

}  // namespace

std::vector<CellContact> list_contacts(const World& world, const Workspace& w,
                                       const std::vector<CellMeasure>& cells) {
  const ContactAreas areas(world, w, cells);
  std::vector<CellContact> list = sum_contacts(world, w, [&](const ContactForce& c) {
    using Both = std::array<double, 2>;
    return c.record == nullptr ? Both{} : Both{areas.of_a(*c.record), areas.of_b(*c.record)};
  });
  const solve::Ownership& ownership = w.system.ownership;
  if (ownership.is_whole()) return list;
  // The owners of both cells have the same force, and each the area of its own side.
  std::vector<CellContact> all;
  ownership.ranks.gather<CellContact>(list, all);
  const auto key = [](const CellContact& c) {
    return std::tuple(c.b != kNoCell, c.a, c.b, c.partner, c.index);
  };
  std::ranges::stable_sort(all, {}, key);
  list.clear();
  for (const CellContact& c : all) {
    if (list.empty() || key(list.back()) != key(c)) {
      list.push_back(c);
      continue;
    }
    list.back().area_a += c.area_a;
    list.back().area_b += c.area_b;
  }
  return list;
}

}  // namespace acinus::coupling
