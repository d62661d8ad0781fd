#include "runs/session/make_frame.hpp"

#include <array>
#include <functional>
#include <span>
#include <tuple>
#include <utility>

#include "contact/wall_mesh.hpp"
#include "core/error.hpp"
#include "coupling/generate/pipette_surface.hpp"
#include "coupling/generate/vessel_surface.hpp"
#include "coupling/measure/node_measures.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::runs {
namespace {

using coupling::CellMeasure;

using io::kBoundary, io::kNucleus, io::kShell, io::kSphere;

io::Table cell_table(const std::vector<CellMeasure>& cells) {
  io::Table t;
  io::IdColumn id{"id", {}}, parent{"parent", {}}, kind{"kind", {}}, type{"type", {}},
      leader{"leader", {}}, contacts{"contacts", {}}, phase{"phase", {}};
  io::Column center{"center", "um", 3, {}}, radius{"radius", "um", 1, {}},
      volume{"volume", "um^3", 1, {}}, area{"area", "um^2", 1, {}},
      pressure{"pressure", "kPa", 1, {}}, cytosol{"cytosol_pressure", "kPa", 1, {}},
      stress{"stress", "kPa", 6, {}}, touching{"contact_area", "um^2", 1, {}},
      active{"migration_force", "nN", 1, {}}, pushing{"contact_force", "nN", 1, {}},
      normal{"normal_force", "nN", 1, {}}, progress{"cycle_progress", "1", 1, {}},
      growth{"growth_rate", "um^3/s", 1, {}};
  for (io::IdColumn* c : {&id, &parent, &kind, &type, &leader, &contacts, &phase})
    c->value.reserve(cells.size());
  for (io::Column* c : {&center, &radius, &volume, &area, &pressure, &cytosol, &stress, &touching,
                        &active, &pushing, &normal, &progress, &growth})
    c->value.reserve(cells.size() * static_cast<std::size_t>(c->components));
  for (const CellMeasure& c : cells) {
    id.value.push_back(c.id);
    parent.value.push_back(c.parent);
    kind.value.push_back(c.deformable ? kShell : kSphere);
    type.value.push_back(c.type);
    leader.value.push_back(c.leader ? 1 : 0);
    contacts.value.push_back(c.contacts);
    for (int k = 0; k < 3; ++k) center.value.push_back(c.center[k]);
    radius.value.push_back(c.radius);
    volume.value.push_back(c.volume);
    area.value.push_back(c.area);
    pressure.value.push_back(c.pressure);
    cytosol.value.push_back(c.cytosol_pressure);
    stress.value.insert(stress.value.end(), c.stress.begin(), c.stress.end());
    touching.value.push_back(c.contact_area);
    active.value.push_back(c.migration_force);
    pushing.value.push_back(c.contact_force);
    normal.value.push_back(c.normal_force);
    phase.value.push_back(static_cast<std::int64_t>(c.fate));
    progress.value.push_back(c.progress);
    growth.value.push_back(c.growth_rate);
  }
  for (io::IdColumn* c : {&id, &parent, &kind, &type, &leader, &contacts, &phase})
    t.ids.push_back(std::move(*c));
  for (io::Column* c : {&center, &radius, &volume, &area, &pressure, &cytosol, &stress, &touching,
                        &active, &pushing, &normal, &progress, &growth})
    t.columns.push_back(std::move(*c));
  return t;
}

/// Number of a kind of partner in /contacts: 0 to 2 are those of `kind`.
std::int64_t number_of(contact::Partner partner) {
  switch (partner) {
    case contact::Partner::kSurface:
      return 0;
    case contact::Partner::kSphere:
      return 1;
    case contact::Partner::kVessel:
      return 2;
    case contact::Partner::kPlane:
      return 3;
    case contact::Partner::kCapsule:
      return 4;
    case contact::Partner::kMesh:
      return 5;
    case contact::Partner::kPipette:
      return 6;
    case contact::Partner::kNucleus:
      break;
  }
  throw Error("internal error: a nucleus is no partner of another cell", Exit::kInternal);
}

io::Table interface_table(const std::vector<coupling::InterfaceForce>& forces) {
  io::IdColumn dcm{"dcm_id", {}}, cbm{"cbm_id", {}};
  io::Column force{"force", "nN", 3, {}}, area{"area", "um^2", 1, {}}, gap{"gap", "um", 1, {}};
  for (const coupling::InterfaceForce& f : forces) {
    dcm.value.push_back(f.dcm_id);
    cbm.value.push_back(f.cbm_id);
    for (int k = 0; k < 3; ++k) force.value.push_back(f.force[k]);
    area.value.push_back(f.area);
    gap.value.push_back(f.gap);
  }
  return {{dcm, cbm}, {force, area, gap}};
}

/// Fields of a point, in the order of PointBuffer.
std::vector<io::Field> point_fields() {
  return {{"force", "nN", 3, {}}, {"contact_pressure", "kPa", 1, {}}, {"tension", "nN/um", 1, {}}};
}

/// Fields of a triangle or sphere, in the order of values_of().
std::vector<io::Field> cell_fields() {
  return {{"cell_type", "1", 1, {}},       {"volume", "um^3", 1, {}},
          {"pressure", "kPa", 1, {}},      {"cytosol_pressure", "kPa", 1, {}},
          {"radius", "um", 1, {}},         {"leader", "1", 1, {}},
          {"strength", "1", 1, {}},        {"phase", "1", 1, {}},
          {"growth_rate", "um^3/s", 1, {}}};
}
constexpr std::size_t kCellFields = 9;

/// Values of a cell, or of boundary: null.
std::array<float, kCellFields> values_of(const CellMeasure* c, double sphere_radius) {
  const auto number = [](double v) { return static_cast<float>(v); };
  if (c == nullptr) return {-1, 0, 0, 0, number(sphere_radius), 0, 1, 0, 0};
  return {number(c->type),       number(c->volume),
          number(c->pressure),   number(c->cytosol_pressure),
          number(sphere_radius), c->leader ? 1.0F : 0.0F,
          number(c->strength),   number(static_cast<int>(c->fate)),
          number(c->growth_rate)};
}

/// Points on their way to the file.
class PointBuffer {
 public:
  explicit PointBuffer(const std::function<void(const io::PointRows&)>& take) : take_(take) {}

  void put(const Vec3& x, const Vec3& force, double pressure, double tension) {
    for (int k = 0; k < 3; ++k) point_.push_back(static_cast<float>(x[k]));
    for (int k = 0; k < 3; ++k) force_.push_back(static_cast<float>(force[k]));
    pressure_.push_back(static_cast<float>(pressure));
    tension_.push_back(static_cast<float>(tension));
    if (pressure_.size() == kMost) hand_over();
  }
  void put_bare(const Vec3& x) { put(x, Vec3::Zero(), 0, 0); }

  void hand_over() {
    take_({point_, {force_, pressure_, tension_}});
    for (auto* v : {&point_, &force_, &pressure_, &tension_}) v->clear();
  }

 private:
  static constexpr std::size_t kMost = 10'000;
  const std::function<void(const io::PointRows&)>& take_;
  std::vector<float> point_, force_, pressure_, tension_;
};

/// Triangles of one surface, or spheres, on their way to the file.
class SurfaceBuffer {
 public:
  explicit SurfaceBuffer(const std::function<void(const io::CellRows&)>& take) : take_(take) {}

  /// Hands over the triangles of a surface.
  /// @param n_node  nodes of the surface, which come after those of the surfaces before
  void put_surface(const std::vector<std::array<int, 3>>& triangle, std::size_t n_node,
                   const CellMeasure* cell, std::uint8_t kind) {
    for (const auto& t : triangle) {
      triangle_.push_back({base_ + t[0], base_ + t[1], base_ + t[2]});
      put_cell(cell, kind, 0);
    }
    base_ += static_cast<std::int64_t>(n_node);
    hand_over();
  }
  /// @pre all surfaces are handed over
  void put_sphere(const CellMeasure& cell) {
    constexpr std::size_t kMost = 10'000;
    put_cell(&cell, kSphere, cell.radius);
    if (id_.size() == kMost) hand_over();
  }
  void hand_over() {
    if (id_.empty()) return;
    io::CellRows rows{triangle_, id_, kind_, {}};
    for (const std::vector<float>& v : data_) rows.data.emplace_back(v);
    take_(rows);
    triangle_.clear();
    id_.clear();
    kind_.clear();
    for (std::vector<float>& v : data_) v.clear();
  }

 private:
  void put_cell(const CellMeasure* c, std::uint8_t kind, double sphere_radius) {
    id_.push_back(c != nullptr ? c->id : -1);
    kind_.push_back(kind);
    const std::array<float, kCellFields> value = values_of(c, sphere_radius);
    for (std::size_t k = 0; k < kCellFields; ++k) data_[k].push_back(value[k]);
  }

  const std::function<void(const io::CellRows&)>& take_;
  std::vector<std::array<std::int64_t, 3>> triangle_;
  std::vector<std::int64_t> id_;
  std::vector<std::uint8_t> kind_;
  std::array<std::vector<float>, kCellFields> data_;
  std::int64_t base_ = 0;  ///< number of nodes so far
};

/// Calls f(group, k) for deformable cells, k in the order of measure_cells.
template <class F>
void for_each_shell(const dcm::State& s, const F& f) {
  std::size_t k = 0;
  for (std::size_t lane = 0; lane < s.n_lane(); ++lane)
    if (s.active(lane)) f(s.group[lane / kLanes], k++);
}

/// Calls f(nodes, triangles) for the surfaces of the boundary.
template <class F>
void for_each_wall(const contact::Boundary& boundary, const geometry::Surface& drawn, const F& f) {
  f(drawn.node, drawn.triangle);
  for (const contact::StaticMesh& m : boundary.meshes) f(m.body.node, *m.triangle);
}

}  // namespace

geometry::Surface draw_boundary(const contact::Boundary& boundary) {
  geometry::Surface drawn;
  if (const contact::WallMesh* wall = boundary.vessels.wall.get())
    drawn = {wall->surface.body.node, *wall->surface.triangle};
  else
    drawn = coupling::make_vessel_surface(boundary.vessels.network);
  for (const contact::Pipette& p : boundary.pipettes) coupling::add_pipette_surface(p, drawn);
  return drawn;
}

void add_concentrations(const coupling::World& world, const Snapshot& snapshot, io::Table& cells) {
  const std::vector<std::vector<double>> mean = coupling::cell_concentrations(world);
  if (mean.empty()) return;
  const std::vector<std::vector<double>> rate = coupling::cell_exchange_rates(world);
  const coupling::CellIndex index = coupling::index_cells(world.state);
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::vector<double>& value) {
    io::Column column{name, unit, 1, {}};
    for (const CellMeasure& c : snapshot.cells) column.value.push_back(value[index.at(c.id).index]);
    cells.columns.push_back(std::move(column));
  };
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const auto& [name, unit] = std::tie(world.params.substances.substance[k].name,
                                        world.params.substances.substance[k].unit);
    add("concentration_" + name, unit, mean[k]);
    add("exchange_" + name, (unit == "1" ? "" : unit + " ") + "um^3/s", rate[k]);
  }
}

io::Table contact_table(const std::vector<coupling::CellContact>& contacts,
                        const std::vector<CellMeasure>& cells) {
  io::IdColumn a{"a", {}}, b{"b", {}}, partner{"partner", {}};
  io::Column area_a{"area_a", "um^2", 1, {}}, area_b{"area_b", "um^2", 1, {}},
      force{"force", "nN", 3, {}}, normal{"normal_force", "nN", 1, {}};
  for (const coupling::CellContact& c : contacts) {
    a.value.push_back(cells[c.a].id);
    b.value.push_back(c.b == coupling::kNoCell ? c.index : cells[c.b].id);
    partner.value.push_back(number_of(c.partner));
    area_a.value.push_back(c.area_a);
    area_b.value.push_back(c.area_b);
    for (int k = 0; k < 3; ++k) force.value.push_back(c.force[k]);
    normal.value.push_back(c.normal_force);
  }
  return {{a, b, partner}, {area_a, area_b, force, normal}};
}

io::FrameSource make_frame_source(const coupling::World& world, const coupling::Workspace& w,
                                  const Snapshot& snapshot, const geometry::Surface& drawn) {
  const dcm::State& shells = world.state.dcm;
  const contact::Boundary& boundary = world.params.boundary;
  io::FrameSource source;
  source.time_s = snapshot.time;
  source.point_data = point_fields();
  source.cell_data = cell_fields();
  source.cells = cell_table(snapshot.cells);
  source.interface = interface_table(snapshot.interface);
  source.contacts = contact_table({}, snapshot.cells);
  std::size_t n_shell = 0;
  const auto count = [&source](std::size_t node, std::size_t triangle) {
    source.n_mesh_node += static_cast<std::int64_t>(node);
    source.n_triangle += static_cast<std::int64_t>(triangle);
  };
  for_each_shell(shells, [&](const dcm::Group& g, std::size_t) {
    ++n_shell;
    count(g.topology->n_node, g.topology->triangle.size());
    if (g.nucleus.exists()) count(g.nucleus.n_node(), g.nucleus.topology->triangle.size());
  });
  for_each_wall(boundary, drawn, [&](const auto& node, const auto& triangle) {
    count(node.size(), triangle.size());
  });
  source.n_sphere = std::ssize(snapshot.cells) - static_cast<std::int64_t>(n_shell);
  source.points = [&, n_shell](const auto& take) {
    PointBuffer out(take);
    coupling::visit_nodes(world, w, [&out](std::span<const coupling::NodeValue> nodes) {
      for (const coupling::NodeValue& n : nodes)
        out.put(n.position, n.force, n.pressure, n.tension);
    });
    coupling::visit_nuclei(world, w, [&out](std::span<const Vec3> nodes) {
      for (const Vec3& x : nodes) out.put_bare(x);
    });
    for_each_wall(boundary, drawn, [&](const auto& node, const auto&) {
      for (const Vec3& x : node) out.put_bare(x);
    });
    for (std::size_t k = n_shell; k < snapshot.cells.size(); ++k)
      out.put_bare(snapshot.cells[k].center);
    out.hand_over();
  };
  source.surfaces = [&, n_shell](const auto& take) {
    SurfaceBuffer out(take);
    for_each_shell(shells, [&](const dcm::Group& g, std::size_t k) {
      out.put_surface(g.topology->triangle, g.topology->n_node, &snapshot.cells[k], kShell);
    });
    for_each_shell(shells, [&](const dcm::Group& g, std::size_t k) {
      if (g.nucleus.exists())
        out.put_surface(g.nucleus.topology->triangle, g.nucleus.n_node(), &snapshot.cells[k],
                        kNucleus);
    });
    for_each_wall(boundary, drawn, [&](const auto& node, const auto& triangle) {
      out.put_surface(triangle, node.size(), nullptr, kBoundary);
    });
    for (std::size_t k = n_shell; k < snapshot.cells.size(); ++k) out.put_sphere(snapshot.cells[k]);
    out.hand_over();
  };
  return source;
}

void send_points(const coupling::World& world, const coupling::Workspace& w) {
  coupling::visit_nodes(world, w, {});
  coupling::visit_nuclei(world, w, {});
}

io::Frame make_frame(const coupling::World& world, const coupling::Workspace& w,
                     const Snapshot& snapshot, const geometry::Surface& boundary) {
  return io::collect(make_frame_source(world, w, snapshot, boundary));
}

}  // namespace acinus::runs
