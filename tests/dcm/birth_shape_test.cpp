/// Shape of birth: a daughter is at rest in it, but for the stretch of her mother, and forgets
/// that shape in time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dcm/birth_shape.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/shape/split.hpp"
#include "geometry/measures.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;

constexpr double kDaughterRadius = 12;           ///< um, of a daughter
constexpr std::size_t kDaughters[] = {0, 2, 5};  ///< lanes with a shape of birth
const std::vector<const char*> kReshaped{"cortex", "area", "local_area"};

bool is_daughter(std::size_t lane) {
  return std::ranges::find(kDaughters, lane) != std::end(kDaughters);
}
const Term& term_of(const std::string& name) {
  return *std::ranges::find(all_terms(), name, [](const Term& t) { return std::string(t.name); });
}

/// Half of a sphere of twice the volume: a flat cap and a round shell.
std::vector<Vec3> half_sphere(const geometry::Topology& t) {
  std::vector<Vec3> mother;
  for (const Vec3& x : t.rest) mother.push_back(kDaughterRadius * std::cbrt(2.0) * x);
  return split_cell(t, mother, Vec3(1, 2, 2) / 3).daughters.value().node[0];
}

/// Half spheres in some lanes of a group, round cells in the others.
Cells make_half_spheres(double stretch, const Ramp& weight) {
  const geometry::Topology& t = geometry::shared_icosphere(162);
  Cells c = make_rest_cells(t, std::vector<double>(kLanes, kDaughterRadius));
  const std::vector<Vec3> half = half_sphere(t);
  for (std::size_t lane : kDaughters) {
    for (int i = 0; i < t.n_node; ++i) c.move(lane, i, half[i]);
    c.state.birth[lane] = make_birth_shape(t, half, kDaughterRadius, stretch, weight);
  }
  c.reset();
  return c;
}

TEST(BirthShape, StretchIsOverTheAreaAtRest) {
  const geometry::Topology& t = geometry::shared_icosphere(162);
  const std::vector<Vec3> half = half_sphere(t);
  const BirthShape shape = make_birth_shape(t, half, kDaughterRadius, 1.3, {1, 0, 0, 3600});
  EXPECT_NEAR(measure_stretch(shape, t, half, kDaughterRadius, 0), 1.3, 1e-12);
  const double area = geometry::compute_area(half, t.triangle),
               round = t.rest_area * kDaughterRadius * kDaughterRadius;
  EXPECT_NEAR(measure_stretch(shape, t, half, kDaughterRadius, 3600), area / round, 1e-12)
      << "forgotten";
}

/// Deformed cells of which some have a half-forgotten shape of birth with ratios from 0.7 to 1.4.
Cells make_mixed_cells(int n_node, const Ramp& weight) {
  Cells c = make_deformed_cells(n_node);
  auto random = reference::stream(60);
  const geometry::Topology& t = *c.state.group[0].topology;
  for (std::size_t lane : kDaughters) {
    BirthShape& b = c.state.birth[lane];
    b.weight = weight;
    b.area = random.uniform(1.1, 1.4);
    const auto ratios = [&](int n) {
      std::vector<double> ratio;
      for (int k = 0; k < n; ++k) ratio.push_back(random.uniform(0.7, 1.4));
      return ratio;
    };
    b.edge = ratios(t.n_edge);
    b.triangle = ratios(t.n_triangle);
  }
  c.reset();
  return c;
}

/// Tension k (1 - 1/sqrt(s)) times the length of every edge: a spring net stretched alike
/// everywhere.
std::vector<Vec3> plain_cortex_force(const Cells& c, std::size_t lane, double stretch) {
  std::vector<Vec3> force(c.n_node(), Vec3::Zero());
  for (const auto& [i, j] : c.state.group[0].topology->edge) {
    const Vec3 f = table_one().spring_stiffness * (1 - 1 / std::sqrt(stretch)) *
                   (c.node(lane, j) - c.node(lane, i));
    force[i] += f;
    force[j] -= f;
  }
  return force;
}
/// K_A (s - 1) against the gradient of the area, for the whole surface and for every triangle
/// alike.
std::vector<Vec3> plain_area_force(const Cells& c, std::size_t lane, double stretch) {
  std::vector<Vec3> force(c.n_node(), Vec3::Zero());
  for (const auto& t : c.state.group[0].topology->triangle) {
    const Vec3 x[3] = {c.node(lane, t[0]), c.node(lane, t[1]), c.node(lane, t[2])};
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    for (std::size_t m = 0; m < 3; ++m)
      force[t[m]] -= table_one().area_modulus * (stretch - 1) * 0.5 *
                     normal.cross(x[(m + 2) % 3] - x[(m + 1) % 3]);
  }
  return force;
}

TEST(BirthShape, CortexAndAreaAreAtRestInIt) {
  for (const char* name : kReshaped) {
    Cells c = make_half_spheres(1, {1, 0, 0, 3600});
    const Term& term = term_of(name);
    term.add(table_one(), c.view(), c.system);
    double worst = 0, energy = 0;
    for (std::size_t lane : kDaughters)
      for (int i = 0; i < c.n_node(); ++i) {
        worst = std::max(worst, c.force(lane, i).norm());
        energy = std::max(energy, term.energy(table_one(), c.view(), static_cast<int>(lane)));
      }
    std::printf("%s: largest force %.1e nN, energy %.1e fJ at birth\n", name, worst, energy);
    // Round-off in the references: some 10 kEps of stiffness times length per edge, six edges a
    // node; the sum of 320 areas is off by 320 kEps at most. Stiffness < 1 nN/um, edges < 6 um.
    EXPECT_LT(worst, 320 * kEps * 6);
    EXPECT_LT(energy, 1e-20);
    // Without it the half sphere is far from rest.
    Cells bare = make_half_spheres(1, Ramp::constant(0));
    term.add(table_one(), bare.view(), bare.system);
    double pull = 0;
    for (int i = 0; i < bare.n_node(); ++i) pull = std::max(pull, bare.force(0, i).norm());
    EXPECT_GT(pull, 0.01);
  }
}

TEST(BirthShape, AStretchIsFeltAsOnASphereStretchedByIt) {
  const double stretch = 1.3;
  for (const char* name : kReshaped) {
    Cells c = make_half_spheres(stretch, {1, 0, 0, 3600});
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (!is_daughter(lane))
        for (int i = 0; i < c.n_node(); ++i) c.move(lane, i, std::sqrt(stretch) * c.node(lane, i));
    term_of(name).add(table_one(), c.view(), c.system);
    double worst = 0, size = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::vector<Vec3> expected = std::string(name) == "cortex"
                                             ? plain_cortex_force(c, lane, stretch)
                                             : plain_area_force(c, lane, stretch);
      for (int i = 0; i < c.n_node(); ++i) {
        const Vec3& f = expected[i];
        worst = std::max(worst, (c.force(lane, i) - f).norm());
        size = std::max(size, f.norm());
      }
    }
    std::printf("%s: force of stretch %.1f off by %.1e of %.2f nN\n", name, stretch, worst, size);
    EXPECT_GT(size, 0.05);
    EXPECT_LT(worst, 320 * kEps * 6);  // as above
  }
}

TEST(BirthShape, ForceIsMinusEnergyGradientInLanesWithAndWithout) {
  for (const Term& term : all_terms()) {
    Cells c = make_mixed_cells(42, Ramp::constant(0.6));
    term.add(table_one(), c.view(), c.system);
    double worst = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (lane == kNoCell) continue;
      const auto energy = [&] {
        return term.energy(table_one(), c.view(), static_cast<int>(lane));
      };
      worst = std::max(worst, worst_slope_error(c, lane, energy) / c.largest_force(lane));
    }
    std::printf("%s: force against differences %.1e of the largest\n", term.name, worst);
    EXPECT_LT(worst, 1e-6) << term.name;
  }
}

TEST(BirthShape, NetForceAndTorqueVanish) {
  for (const Term& term : all_terms()) {
    Cells c = make_mixed_cells(162, Ramp::constant(0.6));
    term.add(table_one(), c.view(), c.system);
    for (std::size_t lane : kDaughters) {
      const reference::NetForce net = c.net_force(lane);
      EXPECT_LT(net.force_share(), 64 * kEps) << term.name;
      EXPECT_LT(net.torque_share(), 64 * kEps) << term.name;
    }
  }
}

TEST(BirthShape, OfNoWeightIsNoneToTheBitAndChangesNoOtherLane) {
  for (const Term& term : all_terms()) {
    Cells none = make_deformed_cells(), forgotten = make_mixed_cells(162, {1, 0, -3600, 0}),
          mixed = make_mixed_cells(162, Ramp::constant(0.6));
    for (Cells* c : {&none, &forgotten, &mixed}) term.add(table_one(), c->view(), c->system);
    EXPECT_EQ(forgotten.system.force, none.system.force) << term.name;
    EXPECT_EQ(forgotten.system.spring, none.system.spring) << term.name;
    EXPECT_EQ(forgotten.system.face, none.system.face) << term.name;
    const bool reshaped = std::ranges::find(kReshaped, std::string(term.name)) != kReshaped.end();
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (int i = 0; i < none.n_node(); ++i) {
        if (is_daughter(lane) && reshaped)
          EXPECT_NE(mixed.force(lane, i), none.force(lane, i)) << term.name;
        else
          EXPECT_EQ(mixed.force(lane, i), none.force(lane, i)) << term.name << " " << lane;
      }
  }
}

TEST(BirthShape, IsForgottenInAStraightLine) {
  const Cells c = make_half_spheres(1.2, {1, 0, 100, 500});
  const BirthShape& b = c.state.birth[kDaughters[0]];
  EXPECT_FALSE(b.is_forgotten(100));
  EXPECT_TRUE(b.is_forgotten(500));
  const std::size_t edge = 17, triangle = 33, lane = kDaughters[1];
  for (double time : {0.0, 200.0, 400.0}) {
    const double weight = time < 100 ? 1 : 1 - (time - 100) / 400;
    const LaneData data = make_lane_data(c.state, time);
    EXPECT_EQ(data.area[lane], 1 + weight * (b.area - 1));
    EXPECT_EQ(data.edge[0][edge * kLanes + lane], 1 + weight * (b.edge[edge] - 1));
    EXPECT_EQ(data.triangle[0][triangle * kLanes + lane], 1 + weight * (b.triangle[triangle] - 1));
    EXPECT_EQ(data.edge[0][edge * kLanes + 1], 1) << "a lane without";
  }
  EXPECT_TRUE(make_lane_data(c.state, 500).edge[0].empty());
}

TEST(BirthShape, IsFreedOnceItIsForgotten) {
  Cells c = make_half_spheres(1.2, {1, 0, 100, 500});
  c.state.birth[kDaughters[1]].weight = {1, 0, 100, 600};
  drop_forgotten(499, c.state.birth);
  for (const std::size_t lane : kDaughters) EXPECT_FALSE(c.state.birth[lane].edge.empty());
  drop_forgotten(500, c.state.birth);
  EXPECT_EQ(c.state.birth[kDaughters[0]].edge.memory(), 0u);
  EXPECT_EQ(c.state.birth[kDaughters[0]].triangle.memory(), 0u);
  EXPECT_FALSE(c.state.birth[kDaughters[1]].edge.empty()) << "still remembered";
}

}  // namespace
}  // namespace acinus::dcm
