/// Equal defaults for a user of the library and a user of a scene who give nothing.

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "coupling/apparatus/pull/pull.hpp"
#include "coupling/apparatus/stretcher/stretcher.hpp"
#include "coupling/apparatus/suction/suction.hpp"
#include "coupling/apparatus/temperature/temperature.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/assemble/build_life.hpp"
#include "runs/assemble/build_params.hpp"
#include "runs/experiments/read_scene.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

/// @param set  PATH=VALUE each
coupling::Params params_of(const std::vector<std::string>& set = {}) {
  const Scene scene = parse_scene(kMinimal, "scene.json", ".", set);
  coupling::Params p;
  for (const auto& [name, type] : scene.cell_types) {
    p.dcm.push_back(make_dcm_params(scene, type));
    p.cbm.push_back(make_cbm_params(scene, type));
  }
  std::vector<std::string> names;
  build_life(scene, p, names);
  set_params(scene, p);
  return p;
}

// Bindings name every member: these functions do not compile when a struct has got another one.

auto fields(const dcm::Params& p) {
  const auto& [spring, bending, fold, area, local_area, tension, contraction, bulk, nodal, across,
               series, medium, viscosity, diffusion, adhesion, with, vessel, thickness, nucleus] =
      p;
  return std::tuple(spring, bending, fold, area, local_area, tension, contraction.has_value(), bulk,
                    nodal, across, series, medium, viscosity, diffusion, adhesion, with, vessel,
                    thickness, nucleus.has_value());
}

auto fields(const cbm::Params& p) {
  const auto& [young, spread, poisson, friction, medium, viscosity, whole, diffusion, adhesion,
               with, vessel, correction] = p;
  return std::tuple(young, spread, poisson, friction, medium, viscosity, whole, diffusion, adhesion,
                    with, vessel, correction.corrects());
}

auto fields(const dcm::ContactParams& p) {
  const auto& [law, quadrature, repulsion, range, friction_range, depth, skin, friction, form,
               adhesion_factor, friction_factor, whole, cohesive_range, modulus, radius] = p;
  return std::tuple(law, quadrature, repulsion, range, friction_range, depth, skin, friction, form,
                    adhesion_factor, friction_factor, whole, cohesive_range, modulus, radius);
}

auto fields(const cbm::ContactParams& p) {
  const auto& [skin, adhesion_factor, friction_factor] = p;
  return std::tuple(skin, adhesion_factor, friction_factor);
}

auto fields(const coupling::InterfaceParams& p) {
  const auto& [friction, friction_factor] = p;
  return std::tuple(friction, friction_factor);
}

auto fields(const coupling::StartUp& p) {
  const auto& [enabled, growth, ramp, settle, speed, pressure] = p;
  return std::tuple(enabled, growth, ramp, settle, speed, pressure);
}

auto fields(const coupling::Motility& p) {
  const auto& [seed, random, in_plane, grid, force, leader_grid, leaders, count, slice, axis,
               radius] = p;
  return std::tuple(seed, random, in_plane, grid, force, leader_grid, leaders, count, slice,
                    axis.norm(), radius);
}

auto fields(const coupling::Sleep& p) {
  const auto& [enabled, grid, traction] = p;
  return std::tuple(enabled, grid, traction);
}

auto fields(const coupling::Proliferation& p) {
  const auto& [rate, thickness, at_start, start_edge, cells, axis] = p;
  return std::tuple(rate.size(), thickness, at_start, start_edge, cells, axis.norm());
}

auto fields(const coupling::LifeParams& p) {
  const auto& [type, rule, proliferation, grid, seed, remesh] = p;
  return std::tuple(rule.size(), proliferation.has_value(), grid, seed, remesh);
}

auto fields(const coupling::ZoomParams& p) {
  const auto& [grid, margin, stay, fade, at_once, most, region, axis, mesh, seed] = p;
  return std::tuple(margin, stay, fade, at_once, most, region.size(), axis.norm(), seed);
}

auto fields(const coupling::Numerics& p) {
  const auto& [step, min_step, adaptive, tolerance, move, cg, integrator, extrapolate] = p;
  const auto& [cg_tolerance, iterations, precision] = cg;
  return std::tuple(step, min_step, adaptive, tolerance, move, cg_tolerance, iterations, precision,
                    integrator, extrapolate);
}

auto fields(const contact::Material& m) {
  const auto& [adhesion, young, poisson, mirror] = m;
  return std::tuple(adhesion, young, poisson, mirror);
}

auto fields(const contact::Plane& p) {
  const auto& [name, point, normal, speed, travel, material, opens] = p;
  return std::tuple(point, normal, speed, travel, fields(material), opens);
}

auto fields(const contact::Capsule& c) {
  const auto& [name, center, radius, speed, min_radius, opens, material] = c;
  return std::tuple(center, radius, speed, min_radius, opens, fields(material));
}

auto fields(const contact::Pipette& p) {
  const auto& [name, mouth, axis, radius, thickness, lip, length, opens, material] = p;
  return std::tuple(mouth, axis, radius, thickness, lip, length, opens, fields(material));
}

auto fields(const coupling::TubeMaterial& m) {
  const auto& [young, poisson, wall, pressure, friction] = m;
  return std::tuple(young, poisson, wall, pressure, friction);
}

/// @param set  PATH=VALUE each
contact::Boundary boundary_of(const std::vector<std::string>& set) {
  contact::Boundary boundary;
  Notes notes;
  add_boundary(parse_scene(kMinimal, "scene.json", ".", set), nullptr, boundary, notes);
  return boundary;
}

TEST(Defaults, OfTheLibraryAreThoseOfScenes) {
  const coupling::Params scene = params_of(), library;
  const auto& [dcm, cbm, dcm_contact, cbm_contact, interface, start_up, motility, life, sleep, zoom,
               numerics, boundary, tree, apparatus, substances, rules] = scene;
  ASSERT_EQ(dcm.size(), 1u);
  EXPECT_EQ(fields(dcm[0]), fields(dcm::Params{}));
  EXPECT_EQ(fields(cbm[0]), fields(cbm::Params{}));
  EXPECT_EQ(fields(dcm_contact), fields(library.dcm_contact));
  EXPECT_EQ(fields(cbm_contact), fields(library.cbm_contact));
  EXPECT_EQ(fields(interface), fields(library.interface));
  EXPECT_EQ(fields(start_up), fields(library.start_up));
  EXPECT_EQ(fields(motility), fields(library.motility));
  EXPECT_EQ(fields(life), fields(library.life));
  EXPECT_EQ(fields(sleep), fields(library.sleep));
  EXPECT_EQ(fields(zoom), fields(library.zoom));
  EXPECT_EQ(zoom.moves(), library.zoom.moves());
  EXPECT_EQ(fields(numerics), fields(library.numerics));
  EXPECT_TRUE(boundary.planes.empty() && !tree.exists() && !substances.exists());
  EXPECT_TRUE(rules.rule.empty());
  EXPECT_TRUE(apparatus.get<coupling::Pulls>().pull.empty());
  EXPECT_TRUE(apparatus.get<coupling::Temperature>().course.entry.empty());
  EXPECT_TRUE(apparatus.get<coupling::Suction>().pressure.entry.empty());
  EXPECT_TRUE(apparatus.get<coupling::Stretcher>().pulse.empty());
}

TEST(Defaults, OfBlocksThatMayBeAbsentAreThoseOfTheLibrary) {
  const coupling::Params p =
      params_of({"life.proliferation={}", "cell_types.hepatocyte.cycle.time=24 h", "moving_zoom={}",
                 "cells.model=zoom", "zoom=[{\"kind\": \"all\"}]",
                 "temperature.course=[{\"time\": \"0 s\", \"value\": \"310 K\"}]"});
  EXPECT_EQ(fields(p.life.proliferation.value()), fields(coupling::Proliferation{}));
  coupling::ZoomParams zoom;
  zoom.region.resize(1);
  EXPECT_EQ(fields(p.zoom), fields(zoom));
  const coupling::Temperature& temperature = p.apparatus.get<coupling::Temperature>();
  ASSERT_EQ(temperature.course.entry.size(), 1u);
  EXPECT_EQ(temperature.reference, coupling::Temperature{}.reference);
  EXPECT_EQ(temperature.activation, coupling::Temperature{}.activation);
}

TEST(Defaults, OfObstaclesAreThoseOfTheLibrary) {
  const contact::Boundary boundary =
      boundary_of({"walls=[{\"mirror\": true}]", "capsule={\"radius\": \"40 um\"}",
                   "pipette={\"radius\": \"5 um\"}"});
  ASSERT_EQ(boundary.planes.size(), 1u);
  EXPECT_EQ(fields(boundary.planes[0]), fields(contact::Plane{}));
  EXPECT_TRUE(boundary.planes[0].material.mirror);
  contact::Capsule capsule;
  capsule.radius = 40;
  ASSERT_EQ(boundary.capsules.size(), 1u);
  EXPECT_EQ(fields(boundary.capsules[0]), fields(capsule));
  contact::Pipette pipette;
  pipette.radius = 5;
  ASSERT_EQ(boundary.pipettes.size(), 1u);
  EXPECT_EQ(fields(boundary.pipettes[0]), fields(pipette));
  EXPECT_EQ(fields(boundary.vessels.material), fields(contact::Vessels{}.material));
}

// But for the mirror: a wall with a surface of its own has an obstacle's plain material.
TEST(Defaults, OfAWallThatIsNoMirrorAreThoseOfAMaterial) {
  const contact::Boundary boundary = boundary_of({"walls=[{\"mirror\": false}]"});
  EXPECT_EQ(fields(boundary.planes.at(0).material), fields(contact::Material{}));
}

TEST(Defaults, OfVesselsAreThoseOfTheLibrary) {
  Scene scene = parse_scene(kMinimal, "scene.json");
  EXPECT_EQ(scene.vessels.adhesion, contact::Vessels{}.material.adhesion);
  scene.vessels.flexible = true;
  geometry::Network network;
  network.node = {Vec3::Zero(), Vec3(20, 0, 0)};
  network.segment = {{0, 1}};
  network.radius = {{4, 4}};
  EXPECT_EQ(fields(build_tree(scene, network).material), fields(coupling::TubeMaterial{}));
  // Table 1 of the paper, in kPa; a default changed in passing must not go unseen.
  EXPECT_EQ(fields(coupling::TubeMaterial{}), std::tuple(0.6, 0.4, 1.0, 0.0, 0.1));
  const contact::Pipette pipette;
  EXPECT_EQ(std::tuple(pipette.thickness, pipette.lip, pipette.length),
            std::tuple(3.0, 1.0, 100.0));
}

TEST(Defaults, OfALobuleAreThoseOfTheGenerator) {
  const Scene scene = parse_scene(kMinimal, "scene.json", ".", {"lobule={}"});
  const coupling::LobuleParameters made = lobule_parameters(scene), library;
  EXPECT_EQ(made.radius, library.radius);
  EXPECT_EQ(made.branch_density, library.branch_density);
  EXPECT_EQ(made.cells, library.cells);
  EXPECT_EQ(made.initial_radius, 12) << "without start-up that of the cells";
}

TEST(Defaults, ACellWithoutTermsHasNone) {
  const dcm::Params p = dcm::params_without_terms();
  EXPECT_EQ(fields(p), std::tuple(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, false, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0,
                                  0.0, 0.0, std::vector<double>{}, 0.0, 0.0, false));
}

}  // namespace
}  // namespace acinus::runs
