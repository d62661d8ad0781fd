#include "runs/bench/inspect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/mesh/measures.hpp"
#include "coupling/audit.hpp"
#include "runs/soundness.hpp"

namespace acinus::runs {
namespace {

constexpr std::uint8_t kShell = 0;

struct Mesh {
  std::int64_t id = 0;
  std::vector<Vec3> node;
  std::vector<std::array<int, 3>> triangle;
};

Vec3 point_of(const io::Frame& f, std::int64_t k) {
  const auto i = static_cast<std::size_t>(3 * k);
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

/// The deformable cells of a frame; a cell's nodes follow each other.
std::vector<Mesh> meshes_of(const io::Frame& f) {
  std::vector<Mesh> meshes;
  std::size_t t = 0;
  while (t < f.triangle.size() && f.kind[t] == kShell) {
    const std::size_t first = t;
    std::int64_t low = std::numeric_limits<std::int64_t>::max(), high = -1;
    for (; t < f.triangle.size() && f.kind[t] == kShell && f.cell_id[t] == f.cell_id[first]; ++t)
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
    const auto row = f.triangle.size() + static_cast<std::size_t>(k);
    spheres.push_back(
        {f.cell_id[row], point_of(f, f.n_mesh_node + k), radius->value[row], strength->value[row]});
  }
  return spheres;
}

/// Where every cell starts and how large it is at rest.
struct Origin {
  Vec3 center = Vec3::Zero();
  double volume = 0;    ///< um^3
  double friction = 0;  ///< nN s/um with the medium, at least
};
std::map<std::int64_t, Origin> origins(const coupling::World& start) {
  std::map<std::int64_t, Origin> all;
  const dcm::State& d = start.state.dcm;
  const auto medium = [](double per_area, double viscosity, double volume) {
    const double radius = std::cbrt(3 * volume / (4 * kPi));
    return viscosity > 0 ? 6 * kPi * viscosity * radius : 4 * kPi * radius * radius * per_area;
  };
  for (std::size_t l = 0; l < d.n_lane(); ++l) {
    if (!d.active(l)) continue;
    const dcm::Params& p = start.params.dcm[static_cast<std::size_t>(d.group[l / kLanes].type)];
    const double volume = d.volume[l].to;
    all[d.lineage[l]] = {dcm::cell_center(d, l), volume,
                         medium(p.medium_friction, p.viscosity, volume)};
  }
  const cbm::State& c = start.state.cbm;
  for (std::size_t k = 0; k < c.n_cell(); ++k) {
    const cbm::Params& p = start.params.cbm[static_cast<std::size_t>(c.type[k])];
    const double volume = c.volume[k].to;
    // Neighbours may cover a sphere but for the least share that is always free.
    all[c.lineage[k]] = {cbm::center_of(c, k), volume,
                         cbm::kLeastFree * medium(p.medium_friction, p.viscosity, volume)};
  }
  return all;
}

/// Collects what is wrong with one frame.
class Inspection {
 public:
  Inspection(const io::Frame& frame, const Scene& scene, const coupling::World& start)
      : frame_(frame),
        scene_(scene),
        around_(start.params.around),
        deepest_(deepest_overlap(start)),
        origins_(origins(start)),
        meshes_(meshes_of(frame)),
        spheres_(spheres_of(frame)) {}
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
  double time() const { return std::max(0.0, frame_.time_s); }

  const io::Frame& frame_;
  const Scene& scene_;
  const contact::Surroundings& around_;
  double deepest_;  ///< um
  std::map<std::int64_t, Origin> origins_;
  std::vector<Mesh> meshes_;
  std::vector<coupling::AuditSphere> spheres_;
  std::vector<Finding> findings_;
};

void Inspection::inspect_shapes() {
  for (const Mesh& m : meshes_) {
    const double volume = mesh::compute_volume(m.node, m.triangle);
    const double share = volume / origins_.at(m.id).volume;
    if (volume <= 0)
      add(Defect::kInverted, fmt::format("cell {} has a volume of {:.3g} um^3", m.id, volume));
    else if (share < kLeastVolume || share > kMostVolume)
      add(Defect::kVolume, fmt::format("cell {} has {:.3g} of its rest volume", m.id, share));
  }
}

void Inspection::inspect_overlaps() {
  std::vector<coupling::AuditMesh> meshes;
  for (const Mesh& m : meshes_) meshes.push_back({m.id, m.node, m.triangle});
  std::vector<coupling::AuditPlane> planes;
  for (const contact::Plane& p : around_.planes) planes.push_back({p.point_at(time()), p.normal});
  std::vector<coupling::AuditCapsule> capsules;
  for (const contact::Capsule& c : around_.capsules)
    capsules.push_back({c.center, c.radius_at(time())});
  coupling::AuditFrame seen;
  seen.meshes = meshes;
  seen.spheres = spheres_;
  seen.vessels = &around_.vessels.network;
  seen.planes = planes;
  seen.capsules = capsules;
  const coupling::AuditResult audit = coupling::audit(seen);
  if (audit.n_self_intersecting > 0)
    add(Defect::kCrossed, fmt::format("{} cells cross themselves", audit.n_self_intersecting));
  const auto look = [&](const char* what, const coupling::WorstPair& worst, double limit) {
    if (worst.depth_um > limit)
      add(Defect::kTunnelled, fmt::format("{} {} overlap by {:.3g} um", what,
                                          fmt::join(worst.ids, " and "), worst.depth_um));
  };
  look("cells", audit.dcm_dcm, deepest_);
  look("cell and wall", audit.dcm_wall, deepest_);
  look("cell and vessel segment", audit.dcm_vessel, deepest_);
  const auto radius_of = [&](std::int64_t id) {
    return std::ranges::find(spheres_, id, &coupling::AuditSphere::id)->radius;
  };
  if (!audit.dcm_cbm.ids.empty())
    look("cell and sphere", audit.dcm_cbm, radius_of(audit.dcm_cbm.ids[1]));
  if (!audit.cbm_cbm.ids.empty())
    look("spheres", audit.cbm_cbm,
         std::max(radius_of(audit.cbm_cbm.ids[0]), radius_of(audit.cbm_cbm.ids[1])));
}

/// The audit leaves spheres and surroundings alone.
void Inspection::inspect_spheres() {
  for (const coupling::AuditSphere& s : spheres_) {
    double gap = std::numeric_limits<double>::infinity();
    for (const contact::Plane& p : around_.planes)
      gap = std::min(gap, contact::gap_to_plane(p, s.center, time()).gap);
    for (const contact::Capsule& c : around_.capsules)
      gap = std::min(gap, contact::gap_to_capsule(c, s.center, time()).gap);
    for (std::size_t k = 0; k < around_.vessels.network.segment.size(); ++k)
      gap = std::min(
          gap, contact::gap_to_segment(around_.vessels.network, static_cast<int>(k), s.center).gap);
    if (gap < 0)
      add(Defect::kTunnelled,
          fmt::format("sphere {} has its centre {:.3g} um inside an obstacle", s.id, -gap));
  }
}

void Inspection::inspect_places() {
  double force = 0, friction = std::numeric_limits<double>::infinity(), size = 0, diffusion = 0;
  for (const auto& [id, o] : origins_) {
    friction = std::min(friction, o.friction);
    size += 2 * std::cbrt(3 * o.volume / (4 * kPi));
    force += scene_.motility.leader_force;
  }
  for (const CellEntry& c : scene_.cells.list) force += c.pull.norm();
  for (const auto& [name, type] : scene_.cell_types)
    if (scene_.motility.random) diffusion = std::max(diffusion, type.diffusion);
  // Contacts may push a cell as far as all cells in a row; six sigma of random motion.
  const double time = this->time();
  const double limit = size + force / friction * time + 6 * std::sqrt(6 * diffusion * time);
  const auto look = [&](std::int64_t id, const Vec3& center) {
    const double way = (center - origins_.at(id).center).norm();
    if (way > limit)
      add(Defect::kLost, fmt::format("cell {} is {:.3g} um from its start; {:.3g} um are possible",
                                     id, way, limit));
  };
  for (const Mesh& m : meshes_) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& x : m.node) mean += x;
    look(m.id, mean / static_cast<double>(m.node.size()));
  }
  for (const coupling::AuditSphere& s : spheres_) look(s.id, s.center);
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
      break;
  }
  return "lost";
}

std::vector<Finding> inspect_frame(const io::Frame& frame, const Scene& scene,
                                   const coupling::World& start) {
  if (!all_finite(frame))
    return {{Defect::kNotFinite, frame.time_s, "a number of the frame is not finite"}};
  return Inspection(frame, scene, start).go();
}

std::vector<Finding> inspect_run(const io::RunReader& run, const Scene& scene,
                                 const coupling::World& start) {
  std::vector<Finding> all;
  for (int k = 0; k < run.n_frame(); ++k) {
    const std::vector<Finding> some = inspect_frame(run.frame(k), scene, start);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace acinus::runs
