#include "bench/stress/inspect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/numbers/time_grid.hpp"
#include "core/sphere.hpp"
#include "coupling/measure/audit.hpp"
#include "coupling/world/cell.hpp"
#include "geometry/measures.hpp"
#include "runs/session/soundness.hpp"

namespace acinus::bench {
namespace {

struct Mesh {
  std::int64_t id = 0;
  std::vector<Vec3> node;
  std::vector<std::array<int, 3>> triangle;
};

Vec3 point_of(const io::Frame& f, std::int64_t k) {
  const std::size_t i = 3 * k;
  return {f.point[i], f.point[i + 1], f.point[i + 2]};
}

bool all_finite(const io::Frame& f) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::isfinite(f.time_s) || !std::ranges::all_of(f.point, finite)) return false;
  const auto fields_are = [&](const std::vector<io::Field>& fields) {
    return std::ranges::all_of(
        fields, [&](const io::Field& x) { return std::ranges::all_of(x.value, finite); });
  };
  if (!fields_are(f.point_data) || !fields_are(f.cell_data)) return false;
  return std::ranges::all_of(
      f.cells.columns, [&](const io::Column& c) { return std::ranges::all_of(c.value, finite); });
}

/// Meshes of the deformable cells of a frame, whose nodes are stored contiguously.
std::vector<Mesh> meshes_of(const io::Frame& f) {
  std::vector<Mesh> meshes;
  std::size_t t = 0;
  while (t < f.triangle.size() && f.kind[t] == io::kShell) {
    const std::size_t first = t;
    std::int64_t low = std::numeric_limits<std::int64_t>::max(), high = -1;
    for (; t < f.triangle.size() && f.kind[t] == io::kShell && f.cell_id[t] == f.cell_id[first];
         ++t)
      for (const std::int64_t n : f.triangle[t]) low = std::min(low, n), high = std::max(high, n);
    Mesh mesh{f.cell_id[first], {}, {}};
    for (std::int64_t n = low; n <= high; ++n) mesh.node.push_back(point_of(f, n));
    for (std::size_t k = first; k < t; ++k) {
      std::array<int, 3> corner{};
      for (std::size_t m = 0; m < 3; ++m) corner[m] = static_cast<int>(f.triangle[k][m] - low);
      mesh.triangle.push_back(corner);
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

std::vector<coupling::AuditSphere> spheres_of(const io::Frame& f) {
  const auto radius = std::ranges::find(f.cell_data, "radius", &io::Field::name);
  const auto strength = std::ranges::find(f.cell_data, "strength", &io::Field::name);
  std::vector<coupling::AuditSphere> spheres;
  for (std::int64_t k = 0; k < f.n_sphere; ++k) {
    const auto row = f.triangle.size() + k;
    spheres.push_back(
        {f.cell_id[row], point_of(f, f.n_mesh_node + k), radius->value[row], strength->value[row]});
  }
  return spheres;
}

/// Starting position of a founder cell, and bounds of its mobility.
struct StartOfCell {
  Vec3 center = Vec3::Zero();
  double friction = 0;  ///< least friction with the medium, nN s/um
  double pull = 0;      ///< nN
};

/// Start of every founder cell by lineage.
/// @param moves  cells may change their model
std::map<std::int64_t, StartOfCell> origins(const coupling::World& start, const Pedigree& pedigree,
                                            bool moves) {
  std::map<std::int64_t, StartOfCell> all;
  const auto medium = [](double per_area, double viscosity, double volume) {
    const double radius = sphere_radius(volume);
    return viscosity > 0 ? 6 * kPi * viscosity * radius : 4 * kPi * radius * radius * per_area;
  };
  coupling::for_each_cell(start.state, [&](const coupling::Cell& c) {
    const Relative& r = pedigree.all().at(coupling::lineage_of(start.state, c));
    const coupling::DeathParams& death = start.params.life.type[r.type].death;
    const double smallest = r.unit * (death.lysis ? death.final_volume : 1);
    StartOfCell& o = all[r.founder];
    o.center = coupling::center_of(start.state, c);
    o.pull = (c.deformable ? start.state.dcm.pull[c.at] : start.state.cbm.pull[c.at]).norm();
    // Cells may change their model; neighbours may cover a sphere but for the least share that is
    // always free.
    const dcm::Params& shell = start.params.dcm[r.type];
    const cbm::Params& sphere = start.params.cbm[r.type];
    const double rubs[] = {
        medium(shell.medium_friction, shell.viscosity, smallest),
        cbm::kLeastFree * medium(sphere.medium_friction, sphere.viscosity, smallest)};
    o.friction = moves ? std::min(rubs[0], rubs[1]) : rubs[c.deformable ? 0 : 1];
  });
  return all;
}

/// Largest mean rest edge of the meshes on a unit sphere, including meshes that spheres may take; 0
/// without meshes.
double unit_edge(const coupling::World& start) {
  double edge = 0;
  for (const geometry::Topology* t : start.params.zoom.mesh)
    if (t != nullptr) edge = std::max(edge, t->mean_rest_length);
  for (const dcm::Group& g : start.state.dcm.group)
    edge = std::max(edge, g.topology->mean_rest_length);
  return edge;
}

/// Inspection of one frame.
class Inspection {
 public:
  Inspection(const io::Frame& frame, const runs::Scene& scene, const coupling::World& start,
             const Pedigree& pedigree)
      : frame_(frame),
        scene_(scene),
        start_(start),
        boundary_(start.params.boundary),
        pedigree_(pedigree),
        rest_(rest_volumes(frame)),
        meshes_(meshes_of(frame)),
        spheres_(spheres_of(frame)),
        findings_(pedigree.compare(frame)) {
    const auto unknown = [&](const auto& cell) {
      return !pedigree_.all().contains(cell.id) || !rest_.contains(cell.id);
    };
    std::erase_if(meshes_, unknown);  // already a finding
    std::erase_if(spheres_, unknown);
    for (coupling::AuditSphere& s : spheres_) s.mother = pedigree_.all().at(s.id).parent;
  }
  std::vector<Finding> go() {
    inspect_shapes();
    inspect_overlaps();
    inspect_spheres();
    inspect_places();
    return std::move(findings_);
  }

 private:
  void add(Defect defect, std::string what) {
    findings_.push_back({defect, frame_.time_s, std::move(what)});
  }
  void inspect_shapes();
  void inspect_overlaps();
  void inspect_spheres();
  void inspect_places();
  double deepest_overlap() const;
  double time() const { return std::max(0.0, frame_.time_s); }

  const io::Frame& frame_;
  const runs::Scene& scene_;
  const coupling::World& start_;
  const contact::Boundary& boundary_;
  const Pedigree& pedigree_;
  std::map<std::int64_t, double> rest_;  ///< um^3, by lineage
  std::vector<Mesh> meshes_;
  std::vector<coupling::AuditSphere> spheres_;
  std::vector<Finding> findings_;
};

void Inspection::inspect_shapes() {
  for (const Mesh& m : meshes_) {
    const double volume = geometry::compute_volume(m.node, m.triangle);
    const double share = volume / rest_.at(m.id);
    if (volume <= 0)
      add(Defect::kInverted, fmt::format("cell {} has a volume of {:.3g} um^3", m.id, volume));
    else if (share < kLeastVolume || share > kMostVolume)
      add(Defect::kVolume, fmt::format("cell {} has {:.3g} of its rest volume", m.id, share));
  }
}

/// Largest overlap that contact can resolve, um, as in runs/session/soundness.hpp.
double Inspection::deepest_overlap() const {
  double radius = 0;
  for (const Mesh& m : meshes_) radius = std::max(radius, sphere_radius(rest_.at(m.id)));
  return start_.params.dcm_contact.max_depth +
         runs::kOverlapBetweenPoints * unit_edge(start_) * radius;
}

void Inspection::inspect_overlaps() {
  const double deepest = deepest_overlap();
  std::vector<coupling::AuditMesh> meshes;
  for (const Mesh& m : meshes_) meshes.push_back({m.id, m.node, m.triangle});
  const std::vector<coupling::AuditWall> walls = coupling::make_audit_walls(boundary_, time());
  coupling::AuditFrame seen;
  seen.meshes = meshes;
  seen.spheres = spheres_;
  seen.vessels = &boundary_.vessels.network;
  seen.walls = walls;
  const coupling::AuditResult audit = coupling::audit(seen);
  if (audit.n_self_intersecting > 0)
    add(Defect::kCrossed, fmt::format("{} cells cross themselves", audit.n_self_intersecting));
  const auto look = [&](const char* what, const coupling::WorstPair& worst, double limit) {
    if (worst.depth_um > limit)
      add(Defect::kTunnelled, fmt::format("{} {} overlap by {:.3g} um", what,
                                          fmt::join(worst.ids, " and "), worst.depth_um));
  };
  look("cells", audit.dcm_dcm, deepest);
  look("cell and wall", audit.dcm_wall, deepest);
  look("cell and vessel segment", audit.dcm_vessel, deepest);
  const auto radius_of = [&](std::int64_t id) {
    return std::ranges::find(spheres_, id, &coupling::AuditSphere::id)->radius;
  };
  if (!audit.dcm_cbm.ids.empty())
    look("cell and sphere", audit.dcm_cbm, radius_of(audit.dcm_cbm.ids[1]));
  if (!audit.cbm_cbm.ids.empty())
    look("spheres", audit.cbm_cbm,
         std::max(radius_of(audit.cbm_cbm.ids[0]), radius_of(audit.cbm_cbm.ids[1])));
}

/// Checks the overlap of spheres with the boundary, which the audit does not cover.
void Inspection::inspect_spheres() {
  for (const coupling::AuditSphere& s : spheres_) {
    double gap = std::numeric_limits<double>::infinity();
    contact::for_each_wall(boundary_, [&](auto, auto, const auto& wall) {
      gap = std::min(gap, contact::gap_to_wall(wall, s.center, time()).gap);
    });
    for (std::size_t k = 0; k < boundary_.vessels.network.segment.size(); ++k)
      gap = std::min(
          gap,
          contact::gap_to_segment(boundary_.vessels.network, static_cast<int>(k), s.center).gap);
    if (gap < 0)
      add(Defect::kTunnelled,
          fmt::format("sphere {} has its centre {:.3g} um inside an obstacle", s.id, -gap));
  }
}

void Inspection::inspect_places() {
  const std::map<std::int64_t, StartOfCell> origin =
      origins(start_, pedigree_, scene_.moving_zoom.has_value());
  double force = 0, friction = std::numeric_limits<double>::infinity(), size = 0, diffusion = 0;
  for (const auto& [id, o] : origin) friction = std::min(friction, o.friction);
  for (const auto& [id, r] : pedigree_.all()) {
    size += 2 * sphere_radius(pedigree_.rest_volume(r, time()).high);
    force += scene_.motility.leader_force + origin.at(r.founder).pull;
    for (const coupling::SignalRule& rule : scene_.rules) force += std::abs(rule.force);
  }
  for (const auto& [name, type] : scene_.cell_types)
    if (scene_.motility.random) diffusion = std::max(diffusion, type.diffusion);
  // Contacts may push a cell as far as all cells in a row; six sigma of random motion.
  const double time = this->time();
  const double limit = size + force / friction * time + 6 * std::sqrt(6 * diffusion * time);
  const auto look = [&](std::int64_t id, const Vec3& center) {
    const std::int64_t founder = pedigree_.all().at(id).founder;
    const double way = (center - origin.at(founder).center).norm();
    if (way > limit)
      add(Defect::kLost, fmt::format("cell {} is {:.3g} um from where cell {} started; {:.3g} um "
                                     "are possible",
                                     id, way, founder, limit));
  };
  for (const Mesh& m : meshes_) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& x : m.node) mean += x;
    look(m.id, mean / static_cast<double>(m.node.size()));
  }
  for (const coupling::AuditSphere& s : spheres_) look(s.id, s.center);
}

/// Volume and rest volume of a deformable cell, um^3.
struct VolumeOfCell {
  double volume = 0, rest = 0;
};

std::map<std::int64_t, VolumeOfCell> loads_of(const io::Frame& f) {
  const std::map<std::int64_t, double> rest = rest_volumes(f);
  std::map<std::int64_t, VolumeOfCell> all;
  for (const Mesh& m : meshes_of(f))
    if (rest.contains(m.id))
      all[m.id] = {geometry::compute_volume(m.node, m.triangle), rest.at(m.id)};
  return all;
}

/// Median change of the relative volume over the cells of both frames, the common effect of walls;
/// 1 without such cells.
double typical_change(const std::map<std::int64_t, VolumeOfCell>& before,
                      const std::map<std::int64_t, VolumeOfCell>& now) {
  std::vector<double> change;
  for (const auto& [id, load] : now)
    if (const auto it = before.find(id); it != before.end())
      change.push_back(load.volume / load.rest / (it->second.volume / it->second.rest));
  if (change.empty()) return 1;
  const auto middle = change.begin() + static_cast<std::ptrdiff_t>(change.size() / 2);
  std::ranges::nth_element(change, middle);
  return *middle;
}

/// Compares the relative volume of daughters with that of their mother in the frame before,
/// relative to typical_change().
std::vector<Finding> compare_volumes(const std::map<std::int64_t, VolumeOfCell>& before,
                                     const std::map<std::int64_t, VolumeOfCell>& now,
                                     const Pedigree& pedigree, double time) {
  std::map<std::int64_t, std::vector<VolumeOfCell>> born;
  for (const auto& [id, load] : now)
    if (const auto it = pedigree.all().find(id); it != pedigree.all().end())
      if (before.contains(it->second.parent)) born[it->second.parent].push_back(load);
  const double typical = typical_change(before, now);
  std::vector<Finding> wrong;
  for (const auto& [mother, pair] : born) {
    if (pair.size() != 2) continue;  // one has died or divided since
    const double had = before.at(mother).volume / before.at(mother).rest;
    const double have = (pair[0].volume + pair[1].volume) / (pair[0].rest + pair[1].rest);
    const double change = have / had / typical;
    const double left = std::log(have) / std::log(had);  // of what her volume was off its rest
    if (left >= 0 && left <= 1) continue;  // was compressed more than the others, and recovers
    if (!(change < kMostDivisionChange && change > 1 / kMostDivisionChange))
      wrong.push_back({Defect::kVolume, time,
                       fmt::format("the daughters of cell {} have {:.3g} of their rest volume, she "
                                   "had {:.3g} of hers",
                                   mother, have, had)});
  }
  return wrong;
}

}  // namespace

const char* name_of(Defect defect) {
  switch (defect) {
    case Defect::kNotFinite:
      return "not finite";
    case Defect::kInverted:
      return "inverted";
    case Defect::kCrossed:
      return "crossed";
    case Defect::kTunnelled:
      return "tunnelled";
    case Defect::kVolume:
      return "volume";
    case Defect::kLost:
      return "lost";
    case Defect::kUnborn:
      return "unborn";
    case Defect::kVanished:
      return "vanished";
    case Defect::kUntimely:
      break;
  }
  return "untimely";
}

std::vector<Finding> inspect_frame(const io::Frame& frame, const runs::Scene& scene,
                                   const coupling::World& start, const Pedigree& pedigree) {
  if (!all_finite(frame))
    return {{Defect::kNotFinite, frame.time_s, "a number of the frame is not finite"}};
  return Inspection(frame, scene, start, pedigree).go();
}

std::vector<Finding> inspect_frames(std::span<const io::Frame> frames,
                                    std::span<const io::Event> events, const runs::Scene& scene,
                                    const coupling::World& start) {
  std::vector<Finding> all;
  const auto keep = [&](const std::vector<Finding>& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  Pedigree pedigree(start);
  std::size_t told = 0;
  const auto tell_until = [&](double time) {
    for (; told < events.size() && events[told].time_s <= time; ++told)
      keep(pedigree.add(events[told]));
  };
  std::map<std::int64_t, VolumeOfCell> before;
  for (const io::Frame& frame : frames) {
    tell_until(frame.time_s + kSameTime);
    keep(inspect_frame(frame, scene, start, pedigree));
    if (!all.empty() && all.back().defect == Defect::kNotFinite) return all;
    const std::map<std::int64_t, VolumeOfCell> now = loads_of(frame);
    keep(compare_volumes(before, now, pedigree, frame.time_s));
    before = now;
  }
  if (!frames.empty()) keep(pedigree.find_overdue(frames.back().time_s));
  tell_until(std::numeric_limits<double>::infinity());
  return all;
}

std::vector<Finding> inspect_run(const io::RunReader& run, const runs::Scene& scene,
                                 const coupling::World& start) {
  std::vector<io::Frame> frames;
  for (int k = 0; k < run.n_frame(); ++k) frames.push_back(run.frame(k));
  return inspect_frames(frames, run.events(), scene, start);
}

}  // namespace acinus::bench
