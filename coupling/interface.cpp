#include "coupling/interface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/box.hpp"

namespace acinus::coupling {
namespace {

/// The law of one contact and the area it acts on.
struct Patch {
  contact::Well well;
  double hardening = 0;  ///< nN/um^3, by how much the contact stiffens as the dent grows
  double area = 0;       ///< um^2
  double touching = 0;   ///< share of the area that rubs
};

Patch make_patch(const InterfaceView& v, const InterfaceContact& k) {
  const auto body = static_cast<std::size_t>(k.body), sphere = static_cast<std::size_t>(k.sphere);
  const std::size_t lane = v.dcm_work.lane_of_body[body];
  const mesh::Topology& t = *v.dcm_work.body[body].topology;
  const dcm::Params& a =
      v.dcm_params[static_cast<std::size_t>(v.dcm_state.group[lane / kLanes].type)];
  const cbm::Params& b = v.cbm_params[static_cast<std::size_t>(v.cbm_state.type[sphere])];
  const Compliance under =
      find_compliance(v.dcm_contact.repulsion,
                      {v.cbm_radius[sphere], v.cbm_state.young[sphere], b.poisson,
                       v.cbm_modulus[sphere], b.correction.corrects() ? &b.correction : nullptr},
                      k.dent);
  Patch p;
  p.well = {v.dcm_contact.adhesion_factor * std::sqrt(a.adhesion * b.adhesion), under.stiffness,
            v.dcm_contact.range_factor * t.mean_rest_length * v.lanes.radius[lane]};
  if (k.gap < 0) p.hardening = under.slope * k.dent;
  p.area = dcm::point_area(t, v.dcm_contact.quadrature, k.point, v.lanes.radius[lane]);
  p.touching = dcm::share_scale(v.dcm_work.share[body][static_cast<std::size_t>(k.point)]) *
               contact::contact_share(k.gap, v.dcm_contact.friction_range);
  return p;
}

}  // namespace

Compliance find_compliance(double repulsion, const SphereSurface& sphere, double dent) {
  const double d = dent / sphere.radius;
  cbm::Modulus modulus{sphere.modulus.value, 0};
  if (sphere.law) {
    const cbm::Modulus here = cbm::corrected_modulus(*sphere.law, sphere.young, d);
    if (here.value > modulus.value) modulus = here;
  }
  const double per_modulus = 4 / (3 * kPi * sphere.radius * (1 - sphere.poisson * sphere.poisson) *
                                  std::sqrt(std::clamp(d, kLeastDent, kMostDent)));
  const double winkler = per_modulus * modulus.value, together = 1 / (1 / repulsion + 1 / winkler);
  // That the contact widens at the same time softens it; the matrix may be too stiff.
  const double yields = together / winkler;
  return {together, yields * yields * per_modulus * modulus.slope / sphere.radius};
}

void find_interface(const dcm::State& dcm_state, const dcm::ContactParams& c,
                    const dcm::LaneData& lanes, const cbm::State& cbm_state,
                    std::span<const double> cbm_radius, dcm::ContactWorkspace& dcm_work,
                    cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work) {
  work.contact.clear();
  work.area.clear();
  if (dcm_work.body.empty() || cbm_state.n_cell() == 0) return;
  std::vector<contact::Box> bodies, sphere_boxes;
  double range = 0;
  for (std::size_t k = 0; k < dcm_work.body.size(); ++k) {
    bodies.push_back(dcm_work.body[k].box);
    range = std::max(range, dcm::contact_range(c, *dcm_work.body[k].topology,
                                               lanes.radius[dcm_work.lane_of_body[k]]));
  }
  for (std::size_t i = 0; i < cbm_state.n_cell(); ++i)
    sphere_boxes.push_back(contact::sphere_box(cbm::center_of(cbm_state, i), cbm_radius[i]));
  const auto pairs = contact::find_pairs_between(bodies, sphere_boxes, range);

  const int per_site = contact::points_per_site(c.quadrature);
  std::vector<std::vector<InterfaceContact>> found(pairs.size());
#pragma omp parallel for schedule(dynamic, 2)
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [body, sphere] = pairs[p];
    const contact::SurfaceBody& b = dcm_work.body[static_cast<std::size_t>(body)];
    const Vec3 center = cbm::center_of(cbm_state, static_cast<std::size_t>(sphere));
    const double radius = cbm_radius[static_cast<std::size_t>(sphere)];
    for (std::size_t site = 0; site < contact::n_sites(b, c.quadrature); ++site) {
      const Vec3 at = contact::site_place(b, c.quadrature, site);
      const double far = radius + range + contact::site_reach(b, c.quadrature, site);
      if ((at - center).squaredNorm() > far * far) continue;
      const Vec3 outward = contact::site_normal(b, c.quadrature, site);
      for (int q = 0; q < per_site; ++q) {
        const int point = static_cast<int>(site) * per_site + q;
        const Vec3 d =
            contact::point_position(b, contact::point_stencil(b, c.quadrature, point)) - center;
        const double distance = d.norm(), gap = distance - radius;
        if (gap < range && distance > 0 && contact::are_facing(outward, d / distance))
          found[p].push_back({body, point, sphere, gap, 0, d / distance});
      }
    }
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [body, sphere] = pairs[p];
    const auto k = static_cast<std::size_t>(body), i = static_cast<std::size_t>(sphere);
    const std::size_t lane = dcm_work.lane_of_body[k];
    double area = 0, dent = 0;
    for (const InterfaceContact& m : found[p]) dent = std::max(dent, -m.gap);
    for (InterfaceContact& m : found[p]) {
      m.dent = dent;
      const double share = contact::contact_share(m.gap, c.friction_range);
      dcm_work.share[k][static_cast<std::size_t>(m.point)] += share;
      area += share * dcm::point_area(*dcm_work.body[k].topology, c.quadrature, m.point,
                                      lanes.radius[lane]);
    }
    if (area > 0) work.area.emplace_back(sphere, area);
    // A deformable neighbour counts in the sphere's overlap with its reference radius, by the
    // distance of the centres alone: whether surfaces touch changes from step to step, and with it
    // the modulus would.
    if (!cbm_work.overlap_sum.empty()) {
      const double reach = lanes.radius[lane] + cbm_radius[i];
      const double relative =
          1 - (dcm::cell_center(dcm_state, lane) - cbm::center_of(cbm_state, i)).norm() / reach;
      cbm_work.overlap_sum[i] += std::max(relative, 0.0);
    }
    work.contact.insert(work.contact.end(), found[p].begin(), found[p].end());
  }
}

void add_interface_areas(const InterfaceWorkspace& work, cbm::ContactWorkspace& cbm_work) {
  for (const auto& [sphere, area] : work.area)
    cbm_work.contact_area[static_cast<std::size_t>(sphere)] += area;
}

void add_interface_loads(const InterfaceView& v, std::size_t cbm_first_row, solve::Links& links) {
  std::size_t at = links.size();
  links.resize(at + v.work.contact.size());
  for (const InterfaceContact& k : v.work.contact) {
    const Patch p = make_patch(v, k);
    const auto body = static_cast<std::size_t>(k.body);
    const contact::PointStencil s =
        contact::point_stencil(v.dcm_work.body[body], v.dcm_contact.quadrature, k.point);
    solve::Link& link = links.link[at];
    link.a = dcm::side_at(v.dcm_state, v.dcm_work.lane_of_body[body], s);
    link.b = solve::Side::at(cbm::cell_point(cbm_first_row, static_cast<std::size_t>(k.sphere)));
    solve::set_law(p.area * (contact::well_stiffness(p.well, k.gap) + p.hardening),
                   v.params.friction_factor * v.params.friction * p.area * p.touching, k.gap,
                   k.normal, link);
    links.load[at++] = {k.normal, -p.area * contact::well_traction(p.well, k.gap),
                        p.area * p.well.repulsion, k.gap};
  }
}

std::vector<InterfaceForce> compute_interface_forces(const InterfaceView& v) {
  std::vector<InterfaceForce> forces;
  int body = -1, sphere = -1;
  for (const InterfaceContact& k : v.work.contact) {
    if (k.body != body || k.sphere != sphere) {
      body = k.body;
      sphere = k.sphere;
      forces.push_back(
          {v.dcm_state.lineage[v.dcm_work.lane_of_body[static_cast<std::size_t>(body)]],
           v.cbm_state.lineage[static_cast<std::size_t>(sphere)], Vec3::Zero(), 0, k.gap});
    }
    const Patch p = make_patch(v, k);
    InterfaceForce& f = forces.back();
    f.force += -p.area * contact::well_traction(p.well, k.gap) * k.normal;
    f.area += p.area * p.touching;
    f.gap = std::min(f.gap, k.gap);
  }
  return forces;
}

}  // namespace acinus::coupling
