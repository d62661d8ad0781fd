/// Contacts of deformable cells as loads: balance, gradient, invariance, areas.

#include "dcm/contact/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/cohesive.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_points.hpp"
#include "tests/dcm/bounded_clump.hpp"
#include "tests/dcm/quadratures.hpp"
#include "tests/reference/dense_system.hpp"

namespace acinus::dcm {
namespace {

TEST(ContactLoads, PairsBalanceForceAndTorque) {
  double worst = 0;
  std::size_t n = 0;
  for (std::uint64_t seed = 70; seed < 76; ++seed) {
    Clump c = make_clump(seed);
    c.options.quadrature = kAll[seed % 3];
    c.find();
    n += c.links.size();
    const reference::NetForce net = c.net_force(c.node_force());
    EXPECT_GT(net.force_sizes, 0);
    worst = std::max({worst, net.force_share(), net.torque_share()});
    for (std::size_t l = 0; l < c.links.size(); ++l) {
      EXPECT_TRUE(c.links.link[l].b.exists());
      const solve::Stencil stencil = solve::stencil_of(c.links.link[l]);
      double weights = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.n); ++k)
        weights += stencil.weight[k];
      EXPECT_NEAR(weights, 0, 1e-15);
    }
  }
  std::printf("pair contacts: %zu links, net force and torque %.1e of the sum\n", n, worst);
  EXPECT_LT(worst, 1e-12);
}

/// Energy of one contact, fJ.
double contact_energy(const Clump& c, std::size_t link, double gap) {
  const contact::Contact& k = c.contacts.all[link];
  const int body = k.a, point = k.point;
  const std::size_t lane = c.work.lane_of_body[body];
  const geometry::Topology& t = *c.state.group[lane / kLanes].topology;
  const double radius = c.lanes.radius[lane];
  if (k.guard) {
    // A node or face centre more than 0.05 um inside: a quarter of its area, repulsion alone.
    const std::size_t n_node = t.n_node, p = point;
    const double rest = p < n_node ? t.rest_node_area[p] : t.rest_triangle_area[p - n_node];
    const double depth = std::max(0.0, -gap - 0.05);
    return 0.25 * rest * radius * radius * 0.5 * c.options.repulsion * depth * depth;
  }
  double adhesion = c.params[0].adhesion, weight = 1;
  if (k.partner == contact::Partner::kSurface) {
    weight = 0.5;  // the other side probes as well
  } else {
    adhesion = contact::material_of(c.boundary, k.partner, k.b).adhesion;
  }
  const double area = rest_share(t, c.options.quadrature, point);
  return weight * area * radius * radius *
         contact::cohesive_energy(
             {adhesion, c.options.repulsion, c.options.range_factor * t.mean_rest_length * radius},
             gap);
}

// One contact at a time and all nodes moved at once: -F . dx = E(x + dx) - E(x - dx).
TEST(ContactLoads, ForceIsMinusEnergyGradient) {
  constexpr std::size_t kKinds = static_cast<std::size_t>(contact::Partner::kSurface) + 1;
  std::array<double, kKinds> worst{};
  std::size_t tried = 0;
  std::array<int, kKinds> kinds{};
  for (std::uint64_t seed = 80; seed < 86; ++seed) {
    Clump c = make_bounded_clump(seed);
    c.options.quadrature = kAll[seed < 84 ? seed % 2 : 2];
    c.find();
    auto random = reference::stream(seed + 10);
    std::vector<double> direction(c.state.position.size());
    for (double& d : direction) d = random.uniform(-1, 1);
    const solve::Links links = c.links;
    const auto before = features_of(c);
    const auto gap = gaps_of(c);
    const auto contacts = c.contacts.all;
    ASSERT_EQ(links.size(), before.size());
    const double h = 1e-6;
    c.shift(direction, h);
    c.find();
    const auto after = features_of(c);
    const auto more = gaps_of(c);
    c.shift(direction, -2 * h);
    c.find();
    const auto less = gaps_of(c);
    double scale = 0;
    for (const contact::Contact& f : contacts) scale = std::max(scale, std::abs(f.force));
    for (std::size_t l = 0; l < links.size(); ++l) {
      // match by feature: a contact may have appeared or gone
      const auto find = [&](const std::vector<std::array<int, 4>>& in) {
        return static_cast<std::size_t>(std::ranges::find(in, before[l]) - in.begin());
      };
      const std::size_t up = find(after), down = find(features_of(c));
      if (up >= more.size() || down >= less.size()) continue;
      const solve::Stencil stencil = solve::stencil_of(links.link[l]);
      double work = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.n); ++k)
        work += stencil.weight[k] * contacts[l].force *
                contacts[l].normal.dot(load_point(direction.data(), stencil.address[k]));
      const double slope =
          (contact_energy(c, down, more[up]) - contact_energy(c, down, less[down])) / (2 * h);
      EXPECT_EQ(links.link[l].gap, static_cast<float>(gap[l]));
      ++tried;
      const std::size_t kind = before[l][2] / kPartner;
      ++kinds[kind];
      // h^2 times the third derivative of the gap, 1/um^2 a thousandfold near an edge; kEps E / h
      // is 1e-10. Weights that are floats move the closest point within its triangle by 3e-8 of
      // an edge, and the normal of a shallow contact turns by that over its gap.
      const double edge = kind == 3 ? 150 : 4;
      const double rounding = 3e-8 * edge;
      // Across an edge the gap changes by as much; only the edge of the first two corners, whose
      // weights are both rounded, moves by that.
      const bool off_edge = kind >= 3 && std::abs(contacts[l].weights()[2]) < 1e-7;
      const double turn = rounding / (off_edge ? h : std::abs(gap[l]));
      const double bound = 1e-6 * scale + turn * std::abs(contacts[l].force);
      worst[kind] = std::max(worst[kind], std::abs(work + slope) / scale);
      EXPECT_LT(std::abs(work + slope), bound) << kind << " gap " << gap[l];
    }
  }
  const std::array<const char*, kKinds> names{"planes", "capsule", "vessel",
                                              "mesh",   "pipette", "cells"};
  std::printf("contact gradient: %zu links\n", tried);
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    if (static_cast<contact::Partner>(kind) == contact::Partner::kPipette)
      continue;  // pipette_test
    std::printf("  %s: %d, worst %.1e of the largest force\n", names[kind], kinds[kind],
                worst[kind]);
    EXPECT_GT(kinds[kind], 20) << names[kind];
    EXPECT_LT(worst[kind], 1e-5) << names[kind];
  }
}

TEST(ContactLoads, StiffnessIsTheProjectedSecondDerivative) {
  Clump c = make_bounded_clump(85);
  c.find();
  const auto gap = gaps_of(c);
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const solve::Link& link = c.links.link[l];
    const double h = 1e-4;
    const double curvature = (contact_energy(c, l, gap[l] + h) - 2 * contact_energy(c, l, gap[l]) +
                              contact_energy(c, l, gap[l] - h)) /
                             (h * h);
    const auto along = static_cast<double>(link.stiffness);
    EXPECT_GE(along, 0);
    if (std::abs(gap[l]) > 2 * h) {
      EXPECT_NEAR(along, std::max(0.0, curvature), 1e-3 * (along + 0.1)) << gap[l];
    }
    // The load is along the exact normal; the matrix keeps it in floats, 6e-8 a component.
    const Vec3& exact = c.contacts.all[l].normal;
    EXPECT_NEAR(exact.norm(), 1, 1e-14);
    EXPECT_LT((reference::normal_of(link.normal) - exact).cwiseAbs().maxCoeff(), 1e-7);
  }
}

// The solver pulls at the very places between which gap and normal were measured: that is what
// keeps the torque of rounded weights at zero.
TEST(ContactLoads, SidesNameThePlacesOfTheContact) {
  for (const auto q : kAll) {
    Clump c = make_bounded_clump(94);
    c.options.quadrature = q;
    c.find();
    const auto gap = gaps_of(c);
    double worst = 0;
    std::size_t pairs = 0;
    for (std::size_t l = 0; l < c.links.size(); ++l) {
      const solve::Stencil stencil = solve::stencil_of(c.links.link[l]);
      Vec3 r = Vec3::Zero();
      for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.n); ++k)
        r += stencil.weight[k] * load_point(c.state.position.data(), stencil.address[k]);
      if (c.links.link[l].b.exists()) {
        worst = std::max(worst, (r - gap[l] * c.contacts.all[l].normal).norm());
        ++pairs;
        continue;
      }
      const contact::Contact& k = c.contacts.all[l];
      const auto& body = c.work.body[k.a];
      const contact::PointStencil point = stencil_of(c.options, body, k);
      worst = std::max(worst, (r - contact::point_position(body, point)).norm());
    }
    std::printf("sides of %zu pairs against their gaps %.1e um\n", pairs, worst);
    EXPECT_GT(pairs, 20u);
    EXPECT_LT(worst, 1e-13);  // round-off of coordinates near 40 um
  }
}

void expect_turning(contact::Quadrature quadrature) {
  Clump c = make_clump(86), turned = make_clump(86);
  auto random = reference::stream(87);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 15);
  c.options.quadrature = turned.options.quadrature = quadrature;
  turned.for_each_node([&](Address a) {
    store_point(turned.state.position.data(), a,
                q * load_point(turned.state.position.data(), a) + shift);
  });
  c.find();
  turned.find();
  ASSERT_EQ(c.links.size(), turned.links.size());
  const auto node_force = c.node_force();
  double worst = 0, worst_tie = 0, scale = 0;
  int ties = 0;
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const double change = (turned.force(l) - q * c.force(l)).norm();
    if (c.surface()[l].triangle != turned.surface()[l].triangle) {
      worst_tie = std::max(worst_tie, change);
      ++ties;
      continue;
    }
    worst = std::max(worst, change);
    EXPECT_EQ(c.links.link[l].a.point, turned.links.link[l].a.point);
    EXPECT_EQ(c.links.link[l].b.point, turned.links.link[l].b.point);
  }
  c.for_each_node(
      [&](Address a) { scale = std::max(scale, load_point(node_force.data(), a).norm()); });
  std::printf("contact forces turn with the cells: %.1e; %d edges taken from the other side %.1e\n",
              worst / scale, ties, worst_tie / scale);
  EXPECT_LT(worst, 1e-11 * scale);  // gaps carry 1e-14 um, k_rep turns that into 1e-13 nN
  // On an edge round-off picks the triangle, whose order of corners decides how weights are
  // rounded.
  EXPECT_LT(worst_tie, 1e-7 * scale);
  EXPECT_LT(ties, static_cast<int>(c.links.size()) / 10);
}

TEST(ContactLoads, TurnWithTheCells) {
  for (const auto q : kAll) expect_turning(q);
}

TEST(Contacts, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  std::vector<std::vector<double>> force;
  for (int threads : {1, 2, 3}) {
    set_threads(threads);
    Clump c = make_bounded_clump(91);
    c.find();
    force.push_back(c.node_force());
  }
  set_threads(before);
  EXPECT_EQ(force[0], force[1]);
  EXPECT_EQ(force[0], force[2]);
}

// With the medium everywhere neighbours take nothing off: the areas make the reference surface.
TEST(ContactAreas, WholeMediumAreaIsTheReferenceSurface) {
  for (const auto q : kAll) {
    Clump c = make_bounded_clump(92);
    c.options.quadrature = q;
    c.options.whole_medium_area = true;
    c.find();
    RowVector<double> medium_area;
    compute_medium_areas(c.input(), c.work, medium_area);
    for (std::size_t lane : c.work.lane_of_body) {
      const dcm::Group& g = c.state.group[lane / kLanes];
      double sum = 0;
      for (int i = 0; i < g.topology->n_node; ++i)
        sum += medium_area[(g.first_row + static_cast<std::size_t>(i)) * kLanes + lane % kLanes];
      const double surface = g.topology->rest_area * c.lanes.radius[lane] * c.lanes.radius[lane];
      EXPECT_NEAR(sum, surface, 1e-12 * surface);
    }
  }
}

// A point's weight goes chi to its contacts and 1 - chi to the medium.
TEST(ContactAreas, ContactAndFreeAreaMakeTheSurface) {
  for (const auto q : kAll) {
    Clump c = make_bounded_clump(92);
    c.options.quadrature = q;
    c.find();
    RowVector<double> medium_area;
    compute_medium_areas(c.input(), c.work, medium_area);
    std::vector<double> touching(c.work.body.size());
    double most = 0;
    for (std::size_t k = 0; k < c.work.share.size(); ++k)
      for (double s : c.work.share[k]) most = std::max(most, s);
    const auto count = [&](int body, int point, double gap) {
      const std::size_t k = body;
      const double total = c.work.share[k][point];
      touching[k] +=
          point_area(*c.work.body[k].topology, q, point, c.lanes.radius[c.work.lane_of_body[k]]) *
          share_scale(total) * contact::contact_share(gap, c.options.friction_range);
    };
    for (const auto& s : c.surface())
      if (!s.is_fold()) count(s.a, s.point, s.gap);
    for (const auto& o : c.obstacle())
      if (!o.only_pushes()) count(o.a, o.point, o.gap);
    double worst = 0;
    for (std::size_t k = 0; k < touching.size(); ++k) {
      const std::size_t lane = c.work.lane_of_body[k];
      const geometry::Topology& t = *c.work.body[k].topology;
      double free = 0;
      for (int i = 0; i < t.n_node; ++i) {
        const double a =
            medium_area[(c.state.group[lane / kLanes].first_row + static_cast<std::size_t>(i)) *
                            kLanes +
                        lane % kLanes];
        EXPECT_GE(a, 0);
        free += a;
      }
      EXPECT_GT(touching[k], 0);
      const double surface = t.rest_area * c.lanes.radius[lane] * c.lanes.radius[lane];
      worst = std::max(worst, std::abs(free + touching[k] - surface) / surface);
    }
    std::printf(
        "contact + free area against the surface %.1e; a point touches at most %.2f times\n", worst,
        most);
    EXPECT_LT(worst, 1e-12);
    EXPECT_GT(most, 1) << "some point must meet two partners, or the scale is not tried";
  }
}

TEST(ContactLoads, FrictionIsAreaTimesShare) {
  Clump c = make_bounded_clump(93);
  c.options.friction_factor = 0.5;
  c.find();
  const auto gap = gaps_of(c);
  double most = 0;
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const contact::Contact& contact = c.contacts.all[l];
    const std::size_t k = contact.a;
    const int point = contact.point;
    const solve::Link& link = c.links.link[l];
    if (contact.guard) {
      EXPECT_EQ(link.friction, 0);
      EXPECT_FALSE(link.b.exists());
      continue;
    }
    const bool pair = contact.partner == contact::Partner::kSurface;
    const bool mirror = contact.partner == contact::Partner::kPlane && contact.b == 1;
    const double total = c.work.share[k][point];
    const double touching = point_area(*c.work.body[k].topology, c.options.quadrature, point,
                                       c.lanes.radius[c.work.lane_of_body[k]]) *
                            contact::contact_share(gap[l], 0.3) / std::max(1.0, total);
    const double expected = mirror ? 0 : pair ? touching / 2 * 50 * 0.5 : touching * 0.1;
    // kept as a float
    EXPECT_NEAR(static_cast<double>(link.friction), expected, 1e-7 * expected + 1e-15);
    EXPECT_EQ(link.b.exists(), pair);
    most = std::max(most, expected);
  }
  EXPECT_GT(most, 1);
}

TEST(ContactLoads, AdhesionIsTheGeometricMeanAndRamps) {
  Clump c;
  const Mat3 one = Mat3::Identity();
  std::vector<NewCell> cells{new_cell(0, {0, 0, 0}, 10, one), new_cell(1, {20.5, 0, 0}, 10, one)};
  cells[1].type = 1;
  c.add_cells(cells);
  c.params.assign(2, c.params[0]);
  c.params[0].adhesion = 0.01;
  c.params[1].adhesion = 0.04;
  c.find();
  const auto mixed = c.node_force();
  c.params[0].adhesion = c.params[1].adhesion = 0.02;
  c.find();
  EXPECT_EQ(mixed, c.node_force());
  c.options.adhesion_factor = 0;
  c.find();
  for (std::size_t l = 0; l < c.links.size(); ++l)
    EXPECT_LE(c.force(l).norm(), c.links.link[l].gap < 0 ? 1e9 : 0.0);
}

}  // namespace
}  // namespace acinus::dcm
