#include "dcm/nucleus_contact.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "core/contact/closest.hpp"
#include "core/threads.hpp"

namespace acinus::dcm {
namespace {

/// Lists of triangles of one thread, so that a warmed-up step allocates nothing.
struct Scratch {
  std::vector<int> near;      ///< triangles of the cortex that come into question
  std::vector<int> nucleus;   ///< all triangles of the nucleus
  std::vector<int> triangle;  ///< of a block of points, point by point
  std::vector<float> bound;   ///< um, of each
};

/// Looks from the nodes of one surface for the nearest places of another.
class NodeSearch {
 public:
  /// @param near     numbers of the triangles that come into question
  /// @param horizon  um: places as far are not looked for
  NodeSearch(const contact::SurfaceBody& surface, std::span<const int> near, double horizon,
             Scratch& scratch)
      : surface_(surface),
        near_(near),
        horizon_(horizon),
        triangle_(scratch.triangle),
        bound_(scratch.bound) {
    triangle_.clear();
    bound_.clear();
  }

  /// Calls found(node, triangle, weights, normal, gap) for every node within the horizon.
  template <class F>
  void look(const std::vector<Vec3>& node, F found) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      add(static_cast<int>(i), node[i]);
      if (block_.n == contact::PointBlock::kSize) flush(found);
    }
    flush(found);
  }

 private:
  void add(int node, const Vec3& x) {
    const std::size_t begin = triangle_.size();
    for (const int t : near_) {
      const double bound = (x - surface_.center[t]).norm() - surface_.reach[t];
      if (bound > horizon_) continue;
      triangle_.push_back(t);
      bound_.push_back(static_cast<float>(bound));
    }
    if (triangle_.size() == begin) return;
    const auto likeliest = std::ranges::min_element(std::span(bound_).subspan(begin));
    const auto at = static_cast<std::size_t>(&*likeliest - bound_.data());
    std::swap(triangle_[begin], triangle_[at]);
    std::swap(bound_[begin], bound_[at]);
    const int n = block_.n++;
    for (int m = 0; m < 3; ++m) block_.x[3 * n + m] = x[m];
    block_.begin[n] = static_cast<std::uint32_t>(begin);
    block_.end[n] = static_cast<std::uint32_t>(triangle_.size());
    node_[n] = node;
  }

  template <class F>
  void flush(F found) {
    if (block_.n > 0) {
      contact::find_closest(surface_, {triangle_, bound_}, contact::kRounding, horizon_, block_);
      contact::find_gaps(surface_, contact::Place::kRounded, block_);
    }
    for (int i = 0; i < block_.n; ++i) {
      if (block_.triangle[i] < 0) continue;
      found(node_[i], block_.triangle[i],
            std::array<float, 2>{block_.rounded[0][i], block_.rounded[1][i]},
            Vec3(block_.normal[0][i], block_.normal[1][i], block_.normal[2][i]), block_.gap[i]);
    }
    block_.n = 0;
    triangle_.clear();
    bound_.clear();
  }

  const contact::SurfaceBody& surface_;
  std::span<const int> near_;
  double horizon_;
  contact::PointBlock block_;
  int node_[contact::PointBlock::kSize] = {};
  std::vector<int>& triangle_;
  std::vector<float>& bound_;
};

/// Triangles of a surface that come nearer to a point than a distance, um.
void find_near(const contact::SurfaceBody& b, const Vec3& point, double distance,
               std::vector<int>& near) {
  near.clear();
  for (std::size_t t = 0; t < b.triangle->size(); ++t)
    if ((b.center[t] - point).norm() - b.reach[t] < distance) near.push_back(static_cast<int>(t));
}

/// Finds the contacts of one cell.
void find_in_cell(const ContactInput& in, const contact::SurfaceBody& cortex,
                  const contact::SurfaceBody& nucleus, std::size_t lane,
                  std::vector<NucleusContact>& out) {
  const Nucleus& n = *in.params[in.state.group[lane / kLanes].type].nucleus;
  const double range = n.gap + kNucleusAhead, horizon = std::max(range, in.options.max_depth);
  const double outer = in.lanes.radius[lane], inner = in.lanes.nucleus.radius[lane];
  const Vec3 middle = 0.5 * (nucleus.box.low + nucleus.box.high);
  double reach = 0;
  for (const Vec3& x : nucleus.node) reach = std::max(reach, (x - middle).norm());
  thread_local Scratch scratch;
  find_near(cortex, middle, reach + horizon, scratch.near);
  if (scratch.near.empty()) return;  // most nuclei at most times

  const auto keep = [&](NucleusContact c, double between) {
    c.lane = lane;
    c.gap = between - n.gap;
    if (between <= range) out.push_back(c);
  };
  NodeSearch(cortex, scratch.near, horizon, scratch)
      .look(nucleus.node, [&](int i, int triangle, auto weight, const Vec3& normal, double gap) {
        const double area = nucleus.topology->rest_node_area[i] * inner * inner;
        keep({0, true, i, triangle, weight, -normal, 0, 0.5 * area}, -gap);
      });
  scratch.nucleus.resize(nucleus.triangle->size());
  std::iota(scratch.nucleus.begin(), scratch.nucleus.end(), 0);
  NodeSearch(nucleus, scratch.nucleus, horizon, scratch)
      .look(cortex.node, [&](int i, int triangle, auto weight, const Vec3& normal, double gap) {
        const double area = cortex.topology->rest_node_area[i] * outer * outer;
        keep({0, false, i, triangle, weight, normal, 0, 0.5 * area}, gap);
      });
}

}  // namespace

void find_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                           NucleusWorkspace& work) {
  work.cortex.clear();
  if (!has_nuclei(in.state)) return;
  for (std::size_t b = 0; b < cortices.lane_of_body.size(); ++b) {
    const std::size_t lane = cortices.lane_of_body[b];
    if (in.state.group[lane / kLanes].nucleus.exists() && in.lanes.active[lane] != 0)
      work.cortex.push_back(b);
  }
  work.body.resize(work.cortex.size());
  work.found.resize(work.cortex.size());
  for_each_index(work.cortex.size(), worth_threads(in.state.n_row()), [&](std::size_t k) {
    const std::size_t lane = cortices.lane_of_body[work.cortex[k]];
    contact::SurfaceBody& nucleus = work.body[k];
    nucleus.topology = in.state.group[lane / kLanes].nucleus.topology;
    nucleus.triangle = &nucleus.topology->triangle;
    copy_nucleus(in.state, lane, nucleus.node);
    contact::refresh_body(nucleus);
    work.found[k].clear();
    find_in_cell(in, cortices.body[work.cortex[k]], nucleus, lane, work.found[k]);
  });
}

void add_nucleus_contacts(const ContactInput& in, const NucleusWorkspace& work,
                          solve::Links& links) {
  std::size_t at = links.size(), n = at;
  for (std::size_t k = 0; k < work.cortex.size(); ++k) n += work.found[k].size();
  if (n == at) return;
  links.resize(n);
  for (std::size_t k = 0; k < work.cortex.size(); ++k)
    for (const NucleusContact& c : work.found[k]) {
      const Group& g = in.state.group[c.lane / kLanes];
      const int n_node = g.topology->n_node;
      const int from = c.probes_cortex ? n_node : 0, to = c.probes_cortex ? 0 : n_node;
      const auto& corner =
          (c.probes_cortex ? *g.topology : *g.nucleus.topology).triangle[c.triangle];
      const double w0 = static_cast<double>(c.weight[0]), w1 = static_cast<double>(c.weight[1]);
      solve::Link& link = links.link[at];
      link.a = side_at(in.state, c.lane, {1, {from + c.node, 0, 0}, {1, 0, 0}});
      link.b =
          side_at(in.state, c.lane,
                  {3, {to + corner[0], to + corner[1], to + corner[2]}, {w0, w1, 1 - w0 - w1}});
      const double k_closed = in.params[g.type].nucleus->repulsion * c.area;
      const double stiffness = c.gap < 0 ? k_closed : 0;
      solve::set_law(stiffness, 0, c.gap, c.normal, link);
      links.load[at] = {c.normal, -stiffness * c.gap, k_closed, c.gap};
      ++at;
    }
}

double nucleus_contact_energy(const Nucleus& n, const NucleusContact& c) {
  const double depth = std::min(c.gap, 0.0);
  return 0.5 * n.repulsion * c.area * depth * depth;
}

}  // namespace acinus::dcm
