#include "runs/scene/registry.hpp"

#include <utility>

namespace acinus::runs {
namespace {

constexpr Range kPositive{.low = 0, .low_open = true};
constexpr Range kNotNegative{.low = 0};
constexpr Range kFraction{.low = 0, .high = 1};
constexpr Range kAtLeastOne{.low = 1};

template <class Block>
using Describe = void (*)(Visitor&, Block&);

template <class Block>
void block(Visitor& visitor, const Key& key, Block& value, Describe<Block> members) {
  visitor.object(key, [&value, members](Visitor& inner) { members(inner, value); });
}

template <class Block>
void blocks(Visitor& visitor, const Key& key, std::vector<Block>& list, Describe<Block> members) {
  Elements elements;
  elements.size = [&list] { return list.size(); };
  elements.resize = [&list](std::size_t n) { list.resize(n); };
  elements.visit = [&list, members](Visitor& inner, std::size_t i) { members(inner, list[i]); };
  elements.visit_sample = [members](Visitor& inner) {
    Block sample;
    members(inner, sample);
  };
  visitor.list(key, elements);
}

template <class Block>
void named_blocks(Visitor& visitor, const Key& key, std::map<std::string, Block>& map,
                  Describe<Block> members) {
  Elements elements;
  elements.size = [&map] { return map.size(); };
  elements.names = [&map] {
    std::vector<std::string> names;
    for (const auto& [name, value] : map) names.push_back(name);
    return names;
  };
  elements.add = [&map](const std::string& name) { map.try_emplace(name); };
  elements.visit = [&map, members](Visitor& inner, std::size_t i) {
    members(inner, std::next(map.begin(), static_cast<std::ptrdiff_t>(i))->second);
  };
  elements.visit_sample = [members](Visitor& inner) {
    Block sample;
    members(inner, sample);
  };
  visitor.map(key, elements);
}

void describe_time(Visitor& v, TimeBlock& b) {
  v.real({.name = "end",
          .meaning = "simulated time after t = 0",
          .dimension = kTime,
          .unit = "h",
          .range = kPositive,
          .required = true},
         b.end);
  v.real({.name = "step",
          .meaning = "longest time step",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive,
          .symbol = "dt"},
         b.step);
  v.real({.name = "min_step",
          .meaning = "shortest step tried before the run gives up",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive},
         b.min_step);
  v.flag({.name = "adaptive", .meaning = "step-size control; false keeps every step at time.step"},
         b.adaptive);
  v.real({.name = "tolerance",
          .meaning = "position error one step may make",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.tolerance);
  v.real({.name = "max_move",
          .meaning = "farthest a node may move in one step, in mean edge lengths; 0 = no cap",
          .range = {.low = 0, .high = 1}},
         b.max_move);
}

void describe_solver(Visitor& v, SolverBlock& b) {
  v.real({.name = "tolerance",
          .meaning = "residual of the conjugate gradients, relative to the right-hand side",
          .range = {.low = 0, .high = 0.1, .low_open = true}},
         b.tolerance);
  v.integer({.name = "max_iterations",
             .meaning = "conjugate gradient iterations of one solve",
             .range = kAtLeastOne},
            b.max_iterations);
}

void describe_start_up(Visitor& v, StartUpBlock& b) {
  v.flag({.name = "enabled",
          .meaning = "grow the cells from small spheres and let them settle before t = 0"},
         b.enabled);
  v.real({.name = "initial_radius",
          .meaning = "radius the cells grow from",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.initial_radius);
  v.real({.name = "growth_time",
          .meaning = "time of the growth to full radius",
          .dimension = kTime,
          .unit = "h",
          .range = kPositive},
         b.growth_time);
  v.real({.name = "adhesion_ramp",
          .meaning = "time over which adhesion is raised after growth",
          .dimension = kTime,
          .unit = "min",
          .range = kNotNegative},
         b.adhesion_ramp);
  v.real({.name = "max_duration",
          .meaning = "longest settling after growth",
          .dimension = kTime,
          .unit = "h",
          .range = kNotNegative},
         b.max_duration);
  v.real({.name = "speed_tolerance",
          .meaning = "settled when no node is faster",
          .dimension = kSpeed,
          .unit = "um/min",
          .range = kPositive},
         b.speed_tolerance);
  v.real({.name = "pressure_tolerance",
          .meaning = "settled when no cell's pressure changes faster, relative to its value",
          .dimension = kRate,
          .unit = "1/h",
          .range = kPositive},
         b.pressure_tolerance);
}

void describe_dcm(Visitor& v, DcmBlock& b) {
  v.integer({.name = "nodes",
             .meaning = "nodes of the cell's surface mesh",
             .choices = "42|162|642|2562",
             .symbol = "N"},
            b.nodes);
  v.real({.name = "cortex_young",
          .meaning = "Young's modulus of the cortex",
          .dimension = kStress,
          .unit = "kPa",
          .range = kNotNegative,
          .symbol = "E_cor"},
         b.cortex_young);
  v.real({.name = "cortex_thickness",
          .meaning = "thickness of the cortex",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "h_cor"},
         b.cortex_thickness);
  v.real({.name = "cortex_poisson",
          .meaning = "Poisson ratio of the cortex",
          .range = {.low = 0, .high = 0.5},
          .symbol = "nu_cor"},
         b.cortex_poisson);
  v.real({.name = "area_modulus",
          .meaning = "resistance of the whole surface to area change",
          .dimension = kTension,
          .unit = "N/m",
          .range = kNotNegative,
          .symbol = "K_A"},
         b.area_modulus);
  v.real({.name = "local_area_modulus",
          .meaning = "resistance of each triangle to area change; keeps the mesh regular",
          .dimension = kTension,
          .unit = "N/m",
          .range = kNotNegative},
         b.local_area_modulus);
  v.real({.name = "bulk_modulus",
          .meaning = "resistance of the cell to volume change",
          .dimension = kStress,
          .unit = "Pa",
          .range = kNotNegative,
          .symbol = "K_V"},
         b.bulk_modulus);
  v.real({.name = "nodal_friction",
          .meaning = "friction between neighbouring nodes of a cell",
          .dimension = kFriction,
          .unit = "N s/m",
          .range = kNotNegative,
          .symbol = "gamma_int"},
         b.nodal_friction);
  v.text(
      {.name = "nodal_friction_kind",
       .meaning = "isotropic resists any relative motion of two nodes, axial only along the edge",
       .choices = "isotropic|axial"},
      b.nodal_friction_kind);
  v.real({.name = "ecm_friction",
          .meaning = "friction of a DCM cell with the matrix, per area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kPositive,
          .symbol = "gamma_ECM+"},
         b.ecm_friction);
}

void describe_cbm(Visitor& v, CbmBlock& b) {
  v.optional_real({.name = "young",
                   .meaning = "Young's modulus of the sphere",
                   .dimension = kStress,
                   .unit = "Pa",
                   .range = kPositive,
                   .symbol = "E",
                   .automatic = "3 K_V (1 - 2 nu)"},
                  b.young);
  v.real({.name = "young_spread",
          .meaning = "relative standard deviation of the modulus from cell to cell, cut at 3 sigma",
          .range = {.low = 0, .high = 0.3}},
         b.young_spread);
  v.real({.name = "poisson",
          .meaning = "Poisson ratio of the sphere",
          .range = {.low = 0, .high = 0.5, .high_open = true},
          .symbol = "nu"},
         b.poisson);
  v.real({.name = "ecm_friction",
          .meaning = "friction of a CBM cell with the matrix, per area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kPositive,
          .symbol = "gamma_ECM+"},
         b.ecm_friction);
}

void describe_cell_type(Visitor& v, CellType& b) {
  v.real({.name = "radius",
          .meaning = "radius at rest, (3 V0 / 4 pi)^(1/3)",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_c"},
         b.radius);
  v.real({.name = "adhesion",
          .meaning = "adhesion energy per area; a pair of types has the geometric mean",
          .dimension = kTension,
          .unit = "J/m^2",
          .range = kNotNegative,
          .symbol = "W"},
         b.adhesion);
  v.real({.name = "diffusion",
          .meaning = "diffusion coefficient of the random motion",
          .dimension = kDiffusion,
          .unit = "m^2/s",
          .range = kNotNegative,
          .symbol = "D"},
         b.diffusion);
  block(v, {.name = "dcm", .meaning = "the cell as a deformable triangulated surface"}, b.dcm,
        describe_dcm);
  block(v, {.name = "cbm", .meaning = "the cell as an elastic sphere"}, b.cbm, describe_cbm);
}

void describe_cell(Visitor& v, CellEntry& b) {
  v.vector({.name = "position",
            .meaning = "centre of the cell",
            .dimension = kLength,
            .unit = "um",
            .required = true},
           b.position);
  v.text({.name = "type", .meaning = "name of its cell type", .automatic = "the only type"},
         b.type);
  v.optional_real({.name = "radius",
                   .meaning = "radius at rest of this cell",
                   .dimension = kLength,
                   .unit = "um",
                   .range = kPositive,
                   .automatic = "the radius of its type"},
                  b.radius);
  v.text({.name = "model",
          .meaning = "model of this cell",
          .choices = "dcm|cbm",
          .automatic = "as cells.model and zoom say"},
         b.model);
  v.vector({.name = "pull",
            .meaning = "constant force spread over the cell",
            .dimension = kForce,
            .unit = "nN"},
           b.pull);
}

void describe_cells(Visitor& v, CellsBlock& b) {
  v.text({.name = "source",
          .meaning = "where the cells come from",
          .choices = "list|clump|box|lobule"},
         b.source);
  v.text({.name = "model",
          .meaning = "model of the cells; zoom: DCM inside the zoom regions",
          .choices = "dcm|cbm|zoom"},
         b.model);
  blocks(v, {.name = "list", .meaning = "cells one by one (source = list)", .item = "cells.list"},
         b.list, describe_cell);
  v.integer({.name = "count",
             .meaning = "cells of a clump, nearest to its centre first",
             .range = {.low = 1, .high = 1e6}},
            b.count);
  v.text({.name = "lattice", .meaning = "packing of a clump", .choices = "fcc|bcc"}, b.lattice);
  v.real({.name = "spacing",
          .meaning = "centre distance in a clump or box, in cell diameters",
          .range = {.low = 0, .high = 100, .low_open = true}},
         b.spacing);
  v.real({.name = "jitter",
          .meaning = "random displacement in a clump or box, in cell diameters",
          .range = kFraction},
         b.jitter);
  v.counts({.name = "grid",
            .meaning = "cells of a box along x, y and z",
            .range = {.low = 1, .high = 1000}},
           b.grid);
}

void describe_region(Visitor& v, Region& b) {
  v.text({.name = "kind",
          .meaning = "shape of the region; cells with their centre in it are DCM",
          .choices = "sphere|box|half_space|axis_distance|all",
          .required = true},
         b.kind);
  v.when(b.kind == "sphere", "kind = sphere", [&b](Visitor& w) {
    w.vector(
        {.name = "center", .meaning = "centre of the sphere", .dimension = kLength, .unit = "um"},
        b.center);
    w.real({.name = "radius",
            .meaning = "radius of the sphere",
            .dimension = kLength,
            .unit = "um",
            .range = kPositive,
            .required = true},
           b.radius);
  });
  v.when(b.kind == "box", "kind = box", [&b](Visitor& w) {
    w.vector({.name = "low",
              .meaning = "corner with the smallest coordinates",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.low);
    w.vector({.name = "high",
              .meaning = "corner with the largest coordinates",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.high);
  });
  v.when(b.kind == "half_space", "kind = half_space", [&b](Visitor& w) {
    w.vector({.name = "point",
              .meaning = "a point of the bounding plane",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.point);
    w.vector({.name = "normal", .meaning = "direction out of the region", .required = true},
             b.normal);
  });
  v.when(b.kind == "axis_distance", "kind = axis_distance", [&b](Visitor& w) {
    w.real({.name = "min_distance",
            .meaning = "smallest distance from the vein axis",
            .dimension = kLength,
            .unit = "um",
            .range = kNotNegative},
           b.min_distance);
    w.real({.name = "max_distance",
            .meaning = "largest distance from the vein axis",
            .dimension = kLength,
            .unit = "um",
            .range = kPositive,
            .required = true},
           b.max_distance);
  });
}

void describe_contact(Visitor& v, ContactBlock& b) {
  v.text(
      {.name = "quadrature", .meaning = "contact points of a triangle", .choices = "3-point|nodes"},
      b.quadrature);
  v.real({.name = "repulsion",
          .meaning = "stiffness against overlap, pressure per depth",
          .dimension = kStiffnessPerArea,
          .unit = "kPa/um",
          .range = kPositive},
         b.repulsion);
  v.optional_real({.name = "range",
                   .meaning = "range of adhesion in mean reference edge lengths",
                   .range = {.low = 0, .high = 2, .low_open = true},
                   .symbol = "h_0",
                   .automatic = "0.3 for 3-point, 0.5 for nodes"},
                  b.range);
  v.real({.name = "max_depth",
          .meaning = "deepest overlap a contact point looks for",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.max_depth);
  v.real({.name = "skin",
          .meaning = "margin of the neighbour lists",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.skin);
}

void describe_friction(Visitor& v, FrictionBlock& b) {
  v.real({.name = "dcm_dcm",
          .meaning = "friction between two DCM cells, per contact area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kNotNegative,
          .symbol = "gamma_ext+"},
         b.dcm_dcm);
  v.real({.name = "cbm_cbm",
          .meaning = "friction between two CBM cells, per contact area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kNotNegative,
          .symbol = "gamma_ext+"},
         b.cbm_cbm);
  v.optional_real({.name = "dcm_cbm",
                   .meaning = "friction between a DCM and a CBM cell",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "harmonic mean of dcm_dcm and cbm_cbm"},
                  b.dcm_cbm);
  v.optional_real({.name = "dcm_vessel",
                   .meaning = "friction of a DCM cell with a vessel",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "the type's dcm.ecm_friction"},
                  b.dcm_vessel);
  v.optional_real({.name = "cbm_vessel",
                   .meaning = "friction of a CBM cell with a vessel",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "the type's cbm.ecm_friction"},
                  b.cbm_vessel);
  v.real({.name = "range",
          .meaning = "gap over which friction between DCM surfaces fades out",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.range);
  v.text({.name = "medium",
          .meaning = "what surrounds the cells: matrix, or liquid (Stokes drag)",
          .choices = "ecm|liquid"},
         b.medium);
  v.real({.name = "viscosity",
          .meaning = "viscosity of the liquid",
          .dimension = kViscosity,
          .unit = "Pa s",
          .range = kPositive,
          .symbol = "eta"},
         b.viscosity);
}

void describe_motility(Visitor& v, MotilityBlock& b) {
  v.flag({.name = "random", .meaning = "random motion of the cells"}, b.random);
  v.real({.name = "grid",
          .meaning = "time over which a random force stays constant",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive},
         b.grid);
  v.real({.name = "leader_force",
          .meaning = "force of the leading cells toward the vein axis",
          .dimension = kForce,
          .unit = "nN",
          .range = kNotNegative,
          .symbol = "F_mor"},
         b.leader_force);
  v.real({.name = "leader_grid",
          .meaning = "time between two choices of the leading cells",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.leader_grid);
}

void describe_lobule(Visitor& v, LobuleBlock& b) {
  v.text({.name = "shape",
          .meaning = "one of six slices of the hexagon, or all of it",
          .choices = "pie|hexagon"},
         b.shape);
  v.real({.name = "radius",
          .meaning = "distance from the axis to a corner",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_lob"},
         b.radius);
  v.real({.name = "height",
          .meaning = "height along the vein axis",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.height);
  v.real({.name = "lesion_radius",
          .meaning = "radius of the dead zone round the central vein",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_nec"},
         b.lesion_radius);
  v.real({.name = "central_vein_radius",
          .meaning = "radius of the central vein",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_cv"},
         b.central_vein_radius);
  v.real({.name = "portal_vein_radius",
          .meaning = "radius of the portal veins",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_pv"},
         b.portal_vein_radius);
  v.real({.name = "sinusoid_radius",
          .meaning = "radius of the sinusoids",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_sin"},
         b.sinusoid_radius);
  v.real({.name = "vessel_fraction",
          .meaning = "part of the volume taken by sinusoids",
          .range = {.low = 0, .high = 0.5}},
         b.vessel_fraction);
  v.real({.name = "branch_density",
          .meaning = "branch points of the sinusoids per volume",
          .dimension = kNumberDensity,
          .unit = "1/um^3",
          .range = kPositive},
         b.branch_density);
  v.real({.name = "min_distance",
          .meaning = "smallest distance of two cell centres at the start",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.min_distance);
  v.integer({.name = "cells",
             .meaning = "cells wanted outside the dead zone",
             .range = {.low = 1, .high = 1e6}},
            b.cells);
}

void describe_vessels(Visitor& v, VesselBlock& b) {
  v.text(
      {.name = "file",
       .meaning = "network file, relative to the scene's folder; \"\" = none, or the lobule's own",
       .is_file = true},
      b.file);
  v.real({.name = "unit",
          .meaning = "length of one unit of the file",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.unit);
  v.real({.name = "scale", .meaning = "factor on positions and radii", .range = kPositive},
         b.scale);
  v.real({.name = "radius_scale", .meaning = "further factor on radii", .range = kPositive},
         b.radius_scale);
  v.vector({.name = "shift",
            .meaning = "displacement after scaling",
            .dimension = kLength,
            .unit = "um"},
           b.shift);
  v.flag({.name = "center",
          .meaning = "first move the middle of the network's bounding box to the origin"},
         b.center);
  v.optional_object(
      {.name = "crop", .meaning = "keep only segments with a part inside this box; null = all"},
      b.crop.has_value(),
      [&b](bool present) {
        b.crop =
            present ? std::optional(std::array<Vec3, 2>{Vec3::Zero(), Vec3::Zero()}) : std::nullopt;
      },
      [&b](Visitor& w) {
        std::array<Vec3, 2> sample{Vec3::Zero(), Vec3::Zero()};
        std::array<Vec3, 2>& box = b.crop ? *b.crop : sample;
        w.vector({.name = "low",
                  .meaning = "corner with the smallest coordinates",
                  .dimension = kLength,
                  .unit = "um",
                  .required = true},
                 box[0]);
        w.vector({.name = "high",
                  .meaning = "corner with the largest coordinates",
                  .dimension = kLength,
                  .unit = "um",
                  .required = true},
                 box[1]);
      });
  v.real({.name = "young",
          .meaning = "Young's modulus of the vessels",
          .dimension = kStress,
          .unit = "Pa",
          .range = kPositive,
          .symbol = "E_sin"},
         b.young);
  v.real({.name = "poisson",
          .meaning = "Poisson ratio of the vessels",
          .range = {.low = 0, .high = 0.5},
          .symbol = "nu_sin"},
         b.poisson);
  v.real({.name = "adhesion",
          .meaning = "adhesion energy between cell and vessel, per area",
          .dimension = kTension,
          .unit = "J/m^2",
          .range = kNotNegative,
          .symbol = "W"},
         b.adhesion);
}

void describe_wall(Visitor& v, WallEntry& b) {
  v.text({.name = "name",
          .meaning = "name in messages and files",
          .automatic = "wall and a number",
          .is_name = true},
         b.name);
  v.vector({.name = "point", .meaning = "a point of the wall", .dimension = kLength, .unit = "um"},
           b.point);
  v.vector({.name = "normal", .meaning = "direction to the side where the cells are"}, b.normal);
  v.real({.name = "speed",
          .meaning = "speed along the normal from t = 0",
          .dimension = kSpeed,
          .unit = "um/h"},
         b.speed);
  v.real({.name = "travel",
          .meaning = "distance after which the wall stops",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.travel);
}

void describe_capsule(Visitor& v, CapsuleEntry& b) {
  v.vector(
      {.name = "center", .meaning = "centre of the capsule", .dimension = kLength, .unit = "um"},
      b.center);
  v.real({.name = "radius",
          .meaning = "inner radius at t = 0",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .required = true},
         b.radius);
  v.real({.name = "speed",
          .meaning = "rate at which the radius shrinks from t = 0",
          .dimension = kSpeed,
          .unit = "um/h",
          .range = kNotNegative},
         b.speed);
  v.real({.name = "min_radius",
          .meaning = "radius at which shrinking stops",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.min_radius);
}

void describe_static_mesh(Visitor& v, StaticMeshEntry& b) {
  v.text({.name = "name",
          .meaning = "name in messages and files",
          .automatic = "mesh and a number",
          .is_name = true},
         b.name);
  v.text({.name = "file",
          .meaning = "surface file, relative to the scene's folder",
          .required = true,
          .is_file = true},
         b.file);
  v.real({.name = "unit",
          .meaning = "length of one unit of the file",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.unit);
  v.real({.name = "scale", .meaning = "factor on positions", .range = kPositive}, b.scale);
  v.vector({.name = "shift",
            .meaning = "displacement after scaling",
            .dimension = kLength,
            .unit = "um"},
           b.shift);
  v.flag({.name = "inside", .meaning = "true: the cells live inside the surface"}, b.inside);
}

void describe_output(Visitor& v, OutputBlock& b) {
  v.real({.name = "every",
          .meaning = "time between two frames",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.every);
  v.text({.name = "compression", .meaning = "compression of the run file", .choices = "none|fast"},
         b.compression);
  v.flag({.name = "start_up", .meaning = "also write frames at t < 0"}, b.start_up);
}

}  // namespace

void describe(Visitor& v, Scene& s) {
  v.text({.name = "name",
          .meaning = "name of the scene and of its run folder",
          .automatic = "the scene file's name",
          .is_name = true},
         s.name);
  v.text({.name = "description", .meaning = "what the scene shows, in a sentence"}, s.description);
  v.seed({.name = "seed", .meaning = "seed of all random numbers"}, s.seed);
  v.text({.name = "experiment", .meaning = "what is measured", .choices = "free|lobule|patch"},
         s.experiment);
  block(v, {.name = "time", .meaning = "duration and steps"}, s.time, describe_time);
  block(v, {.name = "solver", .meaning = "linear solver"}, s.solver, describe_solver);
  block(v, {.name = "start_up", .meaning = "growth and settling before t = 0"}, s.start_up,
        describe_start_up);
  named_blocks(v,
               {.name = "cell_types",
                .meaning = "kinds of cells by name; at least one",
                .required = true,
                .item = "cell"},
               s.cell_types, describe_cell_type);
  block(v, {.name = "cells", .meaning = "which cells there are at the start"}, s.cells,
        describe_cells);
  blocks(v,
         {.name = "zoom",
          .meaning = "regions whose cells are DCM at t = 0 (their union)",
          .item = "zoom"},
         s.zoom, describe_region);
  v.vector({.name = "axis_point",
            .meaning = "the vein axis is vertical (z) through this point",
            .dimension = kLength,
            .unit = "um"},
           s.axis_point);
  block(v, {.name = "contact", .meaning = "contact of surfaces"}, s.contact, describe_contact);
  block(v, {.name = "friction", .meaning = "friction per area"}, s.friction, describe_friction);
  block(v, {.name = "motility", .meaning = "active forces"}, s.motility, describe_motility);
  v.optional_object(
      {.name = "lobule", .meaning = "generated liver lobule; null = none"}, s.lobule.has_value(),
      [&s](bool present) { s.lobule = present ? std::optional(LobuleBlock{}) : std::nullopt; },
      [&s](Visitor& w) {
        LobuleBlock sample;
        describe_lobule(w, s.lobule ? *s.lobule : sample);
      });
  block(v, {.name = "vessels", .meaning = "blood vessels: network file and mechanics"}, s.vessels,
        describe_vessels);
  blocks(v, {.name = "walls", .meaning = "plane mirror walls", .item = "wall"}, s.walls,
         describe_wall);
  v.optional_object(
      {.name = "capsule", .meaning = "rigid sphere round the cells; null = none"},
      s.capsule.enabled,
      [&s](bool present) {
        s.capsule = CapsuleEntry{};
        s.capsule.enabled = present;
      },
      [&s](Visitor& w) { describe_capsule(w, s.capsule); });
  blocks(v,
         {.name = "static_meshes", .meaning = "rigid surfaces from files", .item = "static_mesh"},
         s.static_meshes, describe_static_mesh);
  block(v, {.name = "output", .meaning = "what is written"}, s.output, describe_output);
}

}  // namespace acinus::runs
