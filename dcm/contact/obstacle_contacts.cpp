#include "dcm/contact/obstacle_contacts.hpp"

#include <algorithm>
#include <utility>

#include "contact/wall_mesh.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/vessel_wall.hpp"

namespace acinus::dcm {
namespace {

using contact::Contact, contact::Partner;

/// Contact of a point with a vessel, before the indentation of the wall is known.
struct VesselContact {
  Contact contact;
  double radius = 0;  ///< um, of the vessel at the closest point
};

/// Scratch of the search around one body.
struct VesselScratch {
  std::vector<VesselContact> found;
  std::vector<VesselContact> guard;             ///< [guard]
  std::vector<int> list_of_node;                ///< -1: none
  std::vector<std::pair<int, double>> deepest;  ///< segment, um
};

/// Sets the wall stiffness of a body's contacts with vessels, which follows from the deepest
/// contact with the same segment, and adds the contacts that act beyond the indentation limit.
void set_wall_stiffness(const ContactParams& c, const contact::Material& wall,
                        VesselScratch& scratch) {
  std::vector<VesselContact>& found = scratch.found;
  std::vector<std::pair<int, double>>& deepest = scratch.deepest;
  deepest.clear();
  const auto depth_at = [&](int segment) -> double& {
    auto at = std::ranges::find(deepest, segment, &std::pair<int, double>::first);
    if (at == deepest.end()) at = deepest.insert(at, {segment, 0.0});
    return at->second;
  };
  for (const VesselContact& v : found) {
    double& depth = depth_at(v.contact.b);
    depth = std::max(depth, -v.contact.gap);
  }
  for (std::size_t k = 0, n = found.size(); k < n; ++k) {
    Contact& o = found[k].contact;
    // At most half the search depth, so that contacts beyond the limit are still found.
    const double limit = std::min(contact::yield_limit(wall, found[k].radius), c.max_depth / 2);
    const double k_bed = wall_stiffness(c.repulsion, wall, found[k].radius, depth_at(o.b));
    if (o.guard) {
      o.place_a = Contact::pack(c.repulsion);
      o.place = Contact::pack(kGuardGap + (1 - k_bed / c.repulsion) * limit);
      continue;
    }
    o.place_a = Contact::pack(k_bed);
    // Listed before it pushes, as a step may bring the point there.
    if (limit == 0 || -o.gap < limit / 2) continue;
    VesselContact stop = found[k];
    stop.contact.place_a = Contact::pack(c.repulsion - k_bed);
    stop.contact.place = Contact::pack(limit);
    found.push_back(stop);
  }
}

/// Body and the vessels that its points may touch.
struct BodyAtVessels {
  const contact::SurfaceBody& body;
  int number;
  double range;  ///< um, of the search
  const SegmentCandidates& list;
  std::span<const Contact> wall;  ///< contacts with the surface about the vessels, if they have one
};

/// Search for the contacts of one body with vessels.
class VesselSearch {
 public:
  VesselSearch(const BodyAtVessels& at, const ContactParams& c, const contact::Vessels& vessels,
               VesselScratch& scratch)
      : b_(at.body),
        number_(at.number),
        c_(c),
        range_(at.range),
        list_(at.list),
        vessels_(vessels),
        wall_(at.wall),
        scratch_(scratch) {}

  /// Search for one contact per point, with the nearest segment of the network or with the surface
  /// about it, then for those of the guards, with segments.
  void find() {
    scratch_.found.clear();
    if (vessels_.wall)
      take_points_at_wall();
    else
      find_points();
    scratch_.guard.assign(n_guards(b_), {});
    if (contact::has_face_sites(c_.quadrature))
      find_guards_of_faces();
    else
      find_guards_between_nodes();
    for (const VesselContact& v : scratch_.guard)
      if (v.contact.guard) scratch_.found.push_back(v);
    set_wall_stiffness(c_, vessels_.material, scratch_);
  }

 private:
  VesselContact nearest(std::size_t site, int point, const Vec3& x) const {
    VesselContact best{{.a = number_, .point = point, .b = -1, .partner = Partner::kVessel}, 0};
    best.contact.gap = range_;
    for (std::uint32_t e = list_.start[site]; e < list_.start[site + 1]; ++e) {
      const contact::Gap g = contact::gap_to_segment(vessels_.network, list_.segment[e], x);
      if (g.gap >= best.contact.gap) continue;
      best.contact.b = list_.segment[e];
      best.contact.gap = g.gap;
      best.contact.normal = g.normal;
      best.radius = g.radius;
    }
    return best;
  }

  void take_points_at_wall() {
    for (const Contact& k : wall_) {
      const Vec3 x =
          contact::point_position(b_, contact::point_stencil(b_, c_.quadrature, k.point));
      scratch_.found.push_back({k, contact::gap_to_segment(vessels_.network, k.b, x).radius});
    }
  }

  void find_points() {
    const int per_site = contact::points_per_site(c_.quadrature);
    for (std::size_t s = 0; s < list_.site.size(); ++s)
      for (int q = 0; q < per_site; ++q) {
        const int p = list_.site[s] * per_site + q;
        const VesselContact best = nearest(
            s, p, contact::point_position(b_, contact::point_stencil(b_, c_.quadrature, p)));
        if (best.contact.b >= 0) scratch_.found.push_back(best);
      }
  }

  /// Updates a guard. A node belongs to several faces; its deepest contact counts, once.
  void update_guard(std::size_t site, int number) {
    const std::size_t i = number;
    const Vec3 x =
        i < b_.node.size() ? b_.node[i] : contact::triangle_center(b_, i - b_.node.size());
    const VesselContact best = nearest(site, number, x);
    VesselContact& guard = scratch_.guard[i];
    if (best.contact.b < 0 || best.contact.gap >= std::min(guard.contact.gap, -kGuardGap)) return;
    guard = best;
    guard.contact.guard = true;
  }

  void find_guards_of_faces() {
    const int n_node = static_cast<int>(b_.node.size());
    for (std::size_t s = 0; s < list_.site.size(); ++s) {
      for (int p : (*b_.triangle)[list_.site[s]]) update_guard(s, p);
      update_guard(s, n_node + list_.site[s]);
    }
  }

  /// Search for the guards of faces where the nodes are points themselves: a thin vessel could pass
  /// between the points.
  void find_guards_between_nodes() {
    const int n_node = static_cast<int>(b_.node.size());
    std::vector<int>& list_of_node = scratch_.list_of_node;
    list_of_node.assign(b_.node.size(), -1);
    for (std::size_t s = 0; s < list_.site.size() && list_.site[s] < n_node; ++s)
      list_of_node[list_.site[s]] = static_cast<int>(s);
    for (std::size_t f = 0; f < b_.triangle->size(); ++f)
      for (int corner : (*b_.triangle)[f])
        if (const int s = list_of_node[corner]; s >= 0)
          update_guard(s, n_node + static_cast<int>(f));
  }

  const contact::SurfaceBody& b_;
  int number_;
  const ContactParams& c_;
  double range_;
  const SegmentCandidates& list_;
  const contact::Vessels& vessels_;
  std::span<const Contact> wall_;
  VesselScratch& scratch_;
};

}  // namespace

void find_obstacle_contacts(const ContactInput& in, const ContactWorkspace& work, int number,
                            double range, contact::Contacts& out) {
  const contact::SurfaceBody& b = work.body[number];
  const SegmentCandidates& list = work.lists.segment[number];
  const ContactParams& c = in.options;
  const contact::Boundary& boundary = in.boundary;
  const int n_point = static_cast<int>(contact::n_points(b, c.quadrature));
  const Vec3 middle = 0.5 * (b.box.low + b.box.high);
  const double half = 0.5 * (b.box.high - b.box.low).norm();
  auto probe = [&](Partner kind, int index, auto gap_of) {
    if (gap_of(middle).gap - half >= range) return;
    for (int p = 0; p < n_point; ++p) {
      const contact::Gap g =
          gap_of(contact::point_position(b, contact::point_stencil(b, c.quadrature, p)));
      if (g.gap < range)
        out.push_back({.a = number,
                       .point = p,
                       .b = index,
                       .partner = kind,
                       .place_a = Contact::pack(c.repulsion),
                       .normal = g.normal,
                       .gap = g.gap});
    }
  };
  contact::for_each_wall(boundary, [&](Partner kind, int index, const auto& wall) {
    probe(kind, index, [&](const Vec3& x) { return contact::gap_to_wall(wall, x, in.time); });
  });
  std::span<const Contact> wall;
  if (!work.wall.empty()) wall = work.wall[number];
  if (list.site.empty() && wall.empty()) return;
  thread_local VesselScratch scratch;
  VesselSearch({b, number, range, list, wall}, c, boundary.vessels, scratch).find();
  for (const VesselContact& v : scratch.found) out.push_back(v.contact);
}

void take_wall_contacts(const ContactInput& in, ContactWorkspace& work, contact::Contacts& all) {
  work.wall.clear();
  if (!in.boundary.vessels.wall) return;
  const contact::WallMesh& mesh = *in.boundary.vessels.wall;
  const int number = static_cast<int>(in.boundary.meshes.size());  // they come before it
  work.wall.resize(work.body.size());
  const auto is_at_wall = [number](const Contact& k) {
    return k.partner == Partner::kMesh && k.b == number;
  };
  for (const Contact& k : all) {
    if (!is_at_wall(k)) continue;
    Contact at_vessel = k;
    at_vessel.b = mesh.segment[k.triangle];
    at_vessel.partner = Partner::kVessel;
    at_vessel.triangle = -1;
    at_vessel.place = {};
    work.wall[k.a].push_back(at_vessel);
  }
  std::erase_if(all, is_at_wall);
}

}  // namespace acinus::dcm
