#pragma once
/// Cells among boundary of every kind, and what their contacts are.

#include <array>
#include <cstdint>
#include <vector>

#include "contact/boundary.hpp"
#include "tests/dcm/clump.hpp"

namespace acinus::dcm {

/// All kinds of boundary, each in reach of some cell of make_clump.
inline contact::Boundary make_boundary() {
  contact::Boundary s;
  contact::Plane floor;
  floor.point = {0, 0, -23.9};
  floor.material = {.adhesion = 0.02};
  contact::Plane mirror;
  mirror.point = {-3.3, 0, 0};
  mirror.normal = Vec3::UnitX();
  mirror.material.mirror = true;
  s.planes = {floor, mirror};
  contact::Capsule shell;
  shell.center = {17, 0, 3};
  shell.radius = 26.8;  // its lowest point lies where the floor is touched
  shell.material.adhesion = 0.01;
  s.capsules = {shell};
  contact::Pipette tube;
  tube.mouth = {16.8, 0.6, 27};  // its lip meets the top of a cell
  tube.radius = 5;
  tube.thickness = 3;
  tube.lip = 1;
  tube.length = 20;
  tube.material.adhesion = 0.01;
  s.pipettes = {tube};
  geometry::Network n;
  n.node = {{36.6, -20, 0}, {41, 1, 6}, {38, 12, 4}, {45, 30, 10}};
  n.segment = {{0, 1}, {1, 2}, {2, 3}};
  n.radius = {{4, 5}, {5, 4}, {4, 4}};
  contact::set_network(s.vessels, n);
  s.vessels.material = {.adhesion = 0.01};
  geometry::Surface block;
  block.node = {{-60, 20.6, -60}, {90, 20.6, -60}, {90, 20.6, 90}, {-60, 20.6, 90},
                {-60, 40, -60},   {90, 40, -60},   {90, 40, 90},   {-60, 40, 90}};
  block.triangle = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {0, 4, 5}, {0, 5, 1},
                    {1, 5, 6}, {1, 6, 2}, {2, 6, 7}, {2, 7, 3}, {3, 7, 4}, {3, 4, 0}};
  s.meshes.push_back(contact::make_static_mesh("block", block, false));
  s.meshes.back().material.adhesion = 0.01;
  return s;
}

inline Clump make_bounded_clump(std::uint64_t seed) {
  Clump c = make_clump(seed);
  c.boundary = make_boundary();
  c.params[0].vessel_friction = 0.1;
  return c;
}

inline std::vector<double> gaps_of(const Clump& c) {
  std::vector<double> g;
  for (const contact::Contact& k : c.contacts.all) g.push_back(k.gap);
  return g;
}

/// Distance of the numbers of partners of different kinds.
inline constexpr int kPartner = 1000000;

/// Closest features of all contacts, to compare before and after a small move.
inline std::vector<std::array<int, 4>> features_of(const Clump& c) {
  std::vector<std::array<int, 4>> f;
  for (const contact::Contact& k : c.contacts.all)
    f.push_back({k.a, k.guard ? -1 - k.point : k.point,
                 static_cast<int>(k.partner) * kPartner + k.b, k.triangle});
  return f;
}

}  // namespace acinus::dcm
