#include "dcm/contact/nucleus_contact.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "contact/closest.hpp"
#include "core/parallel/append_in_order.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/contact_sides.hpp"

namespace acinus::dcm {
namespace {

constexpr auto kProbes = contact::Quadrature::kThreePoint;

/// Scratch of a thread, kept: a warmed-up step allocates nothing.
struct SearchScratch {
  std::vector<int> triangle;    ///< candidates of the block, face by face
  std::vector<float> bound;     ///< um, of the distance of each
  std::vector<double> squared;  ///< um^2, of all triangles from a face
};

/// Search from points of a cortex for the nearest places of a nucleus.
class PointSearch {
 public:
  /// Search within a horizon. @param horizon  um, distance from which on places are ignored
  PointSearch(const contact::SurfaceBody& cortex, const contact::SurfaceBody& nucleus,
              double horizon, SearchScratch& scratch)
      : cortex_(cortex),
        nucleus_(nucleus),
        horizon_(horizon),
        triangle_(scratch.triangle),
        bound_(scratch.bound),
        squared_(scratch.squared) {
    triangle_.clear();
    bound_.clear();
  }

  /// Calls found(point, triangle, weights, normal, gap) for every point of these faces that has a
  /// place within the horizon.
  template <class F>
  void look(std::span<const int> faces, F found) {
    const int kPoints = contact::points_per_site(kProbes);
    for (const int face : faces) {
      const std::size_t begin = triangle_.size();
      list_candidates(face);
      if (triangle_.size() == begin) continue;
      for (int k = 0; k < kPoints; ++k) add(face * kPoints + k, begin);
      if (block_.n + kPoints > contact::PointBlock::kSize) flush(found);
    }
    flush(found);
  }

 private:
  /// Lists the triangles that may be nearest to a point of the face, the likeliest first.
  void list_candidates(int face) {
    const std::size_t triangle = face;
    const Vec3 center = contact::triangle_center(cortex_, triangle);
    // Its points are half as far as its corners.
    const double around = 0.5 * contact::triangle_reach(cortex_, triangle);
    const std::size_t n = nucleus_.triangle->size(), begin = triangle_.size();
    squared_.resize(n);
    for (std::size_t t = 0; t < n; ++t) squared_[t] = (center - nucleus_.center[t]).squaredNorm();
    const double nearest = std::sqrt(*std::ranges::min_element(squared_));
    const double farthest = around + std::min(horizon_, nearest + around);
    std::size_t likeliest = begin;
    for (std::size_t t = 0; t < n; ++t) {
      const double limit = farthest + nucleus_.reach[t];
      if (squared_[t] > limit * limit) continue;
      triangle_.push_back(static_cast<int>(t));
      bound_.push_back(static_cast<float>(std::sqrt(squared_[t]) - nucleus_.reach[t] - around));
      if (bound_.back() < bound_[likeliest]) likeliest = bound_.size() - 1;
    }
    if (triangle_.size() == begin) return;
    std::swap(triangle_[begin], triangle_[likeliest]);
    std::swap(bound_[begin], bound_[likeliest]);
  }

  void add(int point, std::size_t begin) {
    const Vec3 x =
        contact::point_position(cortex_, contact::point_stencil(cortex_, kProbes, point));
    const int n = block_.n++;
    for (int m = 0; m < 3; ++m) block_.x[3 * n + m] = x[m];
    block_.begin[n] = static_cast<std::uint32_t>(begin);
    block_.end[n] = static_cast<std::uint32_t>(triangle_.size());
    point_[n] = point;
  }

  template <class F>
  void flush(F found) {
    if (block_.n > 0) {
      contact::find_closest(nucleus_, {triangle_, bound_}, contact::kRounding, horizon_, block_);
      contact::compute_gaps(nucleus_, contact::Place::kRounded, block_);
    }
    for (int i = 0; i < block_.n; ++i) {
      if (block_.triangle[i] < 0) continue;
      found(point_[i], block_.triangle[i],
            std::array<float, 2>{block_.rounded[0][i], block_.rounded[1][i]},
            Vec3(block_.normal[0][i], block_.normal[1][i], block_.normal[2][i]), block_.gap[i]);
    }
    block_.n = 0;
    triangle_.clear();
    bound_.clear();
  }

  const contact::SurfaceBody& cortex_;
  const contact::SurfaceBody& nucleus_;
  double horizon_;
  contact::PointBlock block_;
  int point_[contact::PointBlock::kSize] = {};
  std::vector<int>& triangle_;
  std::vector<float>& bound_;
  std::vector<double>& squared_;
};

/// Search for the triangles of a surface that are nearer to a point than a distance, um.
void find_near(const contact::SurfaceBody& b, const Vec3& point, double distance,
               std::vector<int>& near) {
  near.clear();
  for (std::size_t t = 0; t < b.triangle->size(); ++t)
    if ((contact::triangle_center(b, t) - point).norm() - contact::triangle_reach(b, t) < distance)
      near.push_back(static_cast<int>(t));
}

/// Search for the contacts of nucleus `number` of `work`.
void find_in_cell(const ContactInput& in, const ContactWorkspace& cortices,
                  const NucleusWorkspace& work, std::size_t number, contact::Contacts& found) {
  const std::size_t body = work.cortex[number], lane = cortices.lane_of_body[body];
  const contact::SurfaceBody &cortex = cortices.body[body], &nucleus = work.body[number];
  const Nucleus& n = *in.params[in.state.group[lane / kLanes].type].nucleus;
  const double range = n.gap + kNucleusSkin, horizon = std::max(range, in.options.max_depth);
  const Vec3 middle = 0.5 * (nucleus.box.low + nucleus.box.high);
  double reach = 0;
  for (const Vec3& x : nucleus.node) reach = std::max(reach, (x - middle).norm());
  thread_local std::vector<int> near;
  thread_local SearchScratch scratch;
  find_near(cortex, middle, reach + range, near);
  if (near.empty()) return;  // most nuclei at most times
  PointSearch(cortex, nucleus, horizon, scratch)
      .look(near, [&](int point, int triangle, const auto& weight, const Vec3& normal, double gap) {
        if (gap > range) return;
        found.push_back({.a = static_cast<int>(body),
                         .point = point,
                         .b = static_cast<int>(number),
                         .triangle = triangle,
                         .partner = contact::Partner::kNucleus,
                         .place = weight,
                         .place_a = contact::Contact::pack(n.repulsion),
                         .normal = normal,
                         .gap = gap - n.gap});
      });
}

}  // namespace

void find_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                           NucleusWorkspace& work, contact::ContactList& contacts) {
  contacts.close(contact::ContactKind::kNucleus);
  work.cortex.clear();
  if (!has_nuclei(in.state)) return;
  for (std::size_t b = 0; b < cortices.lane_of_body.size(); ++b) {
    const std::size_t lane = cortices.lane_of_body[b];
    if (in.state.group[lane / kLanes].nucleus.exists() && in.lanes.active[lane] != 0)
      work.cortex.push_back(b);
  }
  work.body.resize(work.cortex.size());
  const auto find = [&](std::size_t k, contact::Contacts& found) {
    const std::size_t lane = cortices.lane_of_body[work.cortex[k]];
    contact::SurfaceBody& nucleus = work.body[k];
    nucleus.topology = in.state.group[lane / kLanes].nucleus.topology;
    nucleus.triangle = &nucleus.topology->triangle;
    copy_nucleus(in.state, lane, nucleus.node);
    contact::refresh_body(nucleus);
    find_in_cell(in, cortices, work, k, found);
  };
  append_in_order(work.cortex.size(), worth_threads(in.state.n_row()), contacts.all, find);
  contacts.close(contact::ContactKind::kNucleus);
}

void add_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                          contact::ContactList& contacts, solve::Links& links) {
  std::size_t at = links.size(), number = contacts.first(contact::ContactKind::kNucleus);
  const std::span<contact::Contact> nuclei = contacts.of(contact::ContactKind::kNucleus);
  if (nuclei.empty()) return;
  links.resize(at + nuclei.size());
  for (contact::Contact& c : nuclei) {
    const std::size_t lane = cortices.lane_of_body[c.a];
    const Group& g = in.state.group[lane / kLanes];
    const int first = g.topology->n_node;
    const auto& corner = g.nucleus.topology->triangle[c.triangle];
    const double closed_stiffness = c.stiffness() * nucleus_contact_area(in, cortices, c);
    c.slope = c.gap < 0 ? closed_stiffness : 0;
    c.force = -c.slope * c.gap;
    solve::Link& link = links.link[at];
    link.a = side_at(in.state, lane, contact::point_stencil(cortices.body[c.a], kProbes, c.point));
    link.b = side_at(in.state, lane,
                     {3, {first + corner[0], first + corner[1], first + corner[2]}, c.weights()});
    solve::set_law(c.slope, 0, c.gap, c.normal, link);
    links.law[at].close({closed_stiffness, c.gap});
    links.law[at].contact = static_cast<std::uint32_t>(number);
    ++at;
    ++number;
  }
}

double nucleus_contact_area(const ContactInput& in, const ContactWorkspace& cortices,
                            const contact::Contact& c) {
  return point_area(*cortices.body[c.a].topology, kProbes, c.point,
                    in.lanes.radius[cortices.lane_of_body[c.a]]);
}

double nucleus_contact_energy(const contact::Contact& c, double area) {
  const double depth = std::min(c.gap, 0.0);
  return 0.5 * c.stiffness() * area * depth * depth;
}

}  // namespace acinus::dcm
