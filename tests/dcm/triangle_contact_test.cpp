/// Maugis-Dugdale between triangles as loads: balance, the law, invariance, matrix, areas.

#include "dcm/contact/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "contact/maugis_overlap.hpp"
#include "contact/maugis_triangles.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_params.hpp"
#include "tests/dcm/clump.hpp"
#include "tests/reference/dense_system.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;

Clump make_triangle_clump(std::uint64_t seed) {
  Clump c = make_clump(seed);
  c.options.law = ContactLaw::kMaugisDugdale;
  return c;
}

/// [n_dof] nN, links and what their rounded places leave out.
std::vector<double> exact_node_force(const Clump& c) {
  std::vector<double> force = c.node_force();
  add_place_remainders(c.input(), c.work, c.contacts, force);
  return force;
}

// Forces balance whatever weights are rounded to; moments to the rounding of the places, 6e-8 of an
// edge, which is a third of an arm, and with the remainders to that of double precision.
TEST(TriangleContacts, ForceAndTorqueAreInBalance) {
  double links_force = 0, links_torque = 0, exact_force = 0, exact_torque = 0;
  std::size_t n = 0;
  for (std::uint64_t seed = 70; seed < 73; ++seed) {
    Clump c = make_triangle_clump(seed);
    c.find();
    n += c.links.size();
    const reference::NetForce links = c.net_force(c.node_force()),
                              exact = c.net_force(exact_node_force(c));
    EXPECT_GT(exact.force_sizes, 1);
    links_force = std::max(links_force, links.force_share());
    links_torque = std::max(links_torque, links.torque_share());
    exact_force = std::max(exact_force, exact.force_share());
    exact_torque = std::max(exact_torque, exact.torque_share());
  }
  std::printf("%zu contacts of triangles: force %.1e, torque %.1e, links alone %.1e and %.1e\n", n,
              exact_force, exact_torque, links_force, links_torque);
  EXPECT_LT(std::max(links_force, exact_force), 1e-13);  // hundreds of round-offs, kEps each
  EXPECT_LT(links_torque, 6e-8);
  EXPECT_LT(exact_torque, 1e-13);
}

// The record carries the forces of the library, but for the rounding of the places.
TEST(TriangleContacts, ForcesAreThoseBetweenSurfaces) {
  Clump c = make_triangle_clump(74);
  c.find();
  const double adhesion = 0.01;
  const contact::MaugisLaw law{c.options.modulus, adhesion, adhesion / c.options.cohesive_range,
                               c.options.max_radius};
  std::vector<double> expected(c.state.position.size());
  double area = 0;
  const auto surface = [&](std::size_t k) {
    const contact::SurfaceBody& b = c.work.body[k];
    return contact::CurvedSurface{static_cast<int>(b.node.size()), *b.triangle,
                                  c.work.triangles.curved[k]};
  };
  for (std::size_t a = 0; a < c.work.body.size(); ++a)
    for (std::size_t b = a + 1; b < c.work.body.size(); ++b) {
      const auto f = contact::compute_surface_forces(law, surface(a), surface(b), 2);
      area += f.contact_area;
      for (const auto& [body, force] : {std::pair(a, &f.on_a), std::pair(b, &f.on_b)})
        for (std::size_t i = 0; i < force->size(); ++i)
          add_point(expected.data(),
                    node_address(c.state, c.work.lane_of_body[body], static_cast<int>(i)),
                    (*force)[i]);
    }
  const std::vector<double> force = exact_node_force(c);
  double worst = 0, total = 0, touching = 0;
  c.for_each_node([&](Address a) {
    const Vec3 f = load_point(expected.data(), a);
    worst = std::max(worst, (load_point(force.data(), a) - f).norm());
    total += f.norm();
  });
  for (const contact::Contact& k : c.surface()) touching += k.touching;
  std::printf("%zu contacts, node forces against the library's %.1e nN of %.3g nN\n",
              c.contacts.surface().size(), worst, total);
  // Of each force 6e-8 goes to another corner.
  EXPECT_LT(worst, 6e-8 * total);
  EXPECT_NEAR(touching, area, 1e-12 * area);
}

// Two spheres of 642 nodes pressed 0.5 um: benchmarks.md has 0.999 +- 0.004 of the curve.
TEST(TriangleContacts, SpheresFollowTheCurve) {
  Clump c;
  auto random = reference::stream(75);
  c.add_cells({new_cell(0, Vec3::Zero(), 10, reference::random_rotation(random), 642),
               new_cell(1, Vec3(0, 0, 19.5), 10, reference::random_rotation(random), 642)});
  for (std::size_t l = 0; l < 2;
       ++l)  // from the rest shape, as voluminous as a sphere, to a sphere
    for (int i = 0; i < 642; ++i) {
      const Address a = node_address(c.state, l, i);
      const Vec3 center(0, 0, l == 0 ? 0 : 19.5);
      store_point(c.state.position.data(), a,
                  center + 10 * (load_point(c.state.position.data(), a) - center).normalized());
    }
  c.options.law = ContactLaw::kMaugisDugdale;
  c.find();
  double push = 0;
  for (const contact::Contact& k : c.surface()) push -= k.force * k.normal.z();
  const double exact =
      contact::maugis_at_overlap({{5, 10, 0.01}, 0.5}, 0.5).force;
  std::printf("push of two spheres over the curve's: %.4f\n", push / exact);
  EXPECT_NEAR(push / exact, 1, 3 * 0.004);
}

TEST(TriangleContacts, TurnWithTheCells) {
  Clump c = make_triangle_clump(76), turned = make_triangle_clump(76);
  auto random = reference::stream(77);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 15);
  turned.for_each_node([&](Address a) {
    store_point(turned.state.position.data(), a,
                q * load_point(turned.state.position.data(), a) + shift);
  });
  c.find();
  turned.find();
  const std::vector<double> f = exact_node_force(c), g = exact_node_force(turned);
  double worst = 0, total = 0;
  c.for_each_node([&](Address a) {
    total += load_point(f.data(), a).norm();
    worst = std::max(worst, (q * load_point(f.data(), a) - load_point(g.data(), a)).norm());
  });
  std::printf("contacts of triangles turn with the cells: %.1e of all forces\n", worst / total);
  // Places are rounded in another way, if their last digit differs: 6e-8 of a force.
  EXPECT_LT(worst, 6e-8 * total);
}

// Of the friction and stiffness of all contacts: symmetric, no direction gives energy, a
// translation costs none. Pushed together a pair of triangles resists by its slope.
TEST(TriangleContacts, MatrixIsPositiveSemiDefinite) {
  Clump c = make_triangle_clump(78);
  c.find();
  solve::System s;
  s.n_row = c.state.position.size() / kPointStride;
  s.friction_scale = 0.1;
  s.links = c.links;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(s.n_dof()),
                                            static_cast<Eigen::Index>(s.n_dof()));
  reference::add_contacts(m, s);
  const double size = m.cwiseAbs().maxCoeff();
  ASSERT_GT(size, 0);
  EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), 16 * kEps * size);
  auto random = reference::stream(79);
  Eigen::VectorXd x(m.rows());
  double least = 0;
  for (int k = 0; k < 200; ++k) {
    for (double& v : x) v = random.uniform(-1, 1);
    least = std::min(least, x.dot(m * x));
  }
  EXPECT_GE(least, 0);
  int growing = 0;
  for (const solve::Link& l : c.links.link) {
    EXPECT_GE(l.stiffness, 0);
    EXPECT_GE(l.friction, 0);
    growing += l.stiffness > 0 ? 1 : 0;
  }
  EXPECT_GT(growing, static_cast<int>(c.links.size()) / 3);
  for (Eigen::Index k = 0; k < m.rows(); ++k)  // one component of all points
    x(k) = (k / kLanes) % 3 == 1 ? 1 : 0;
  EXPECT_LT((m * x).cwiseAbs().maxCoeff(), 1e3 * kEps * size);
}

TEST(TriangleContacts, RubWithTheirAreasAndTakeThemFromTheMedium) {
  Clump c = make_triangle_clump(80);
  c.find();
  double touching = 0, shared = 0;
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const contact::Contact& k = c.contacts.all[l];
    EXPECT_EQ(c.links.link[l].friction, static_cast<float>(50 * k.touching));
    touching += k.touching;
  }
  for (std::size_t body = 0; body < c.work.body.size(); ++body) {
    const contact::SurfaceBody& b = c.work.body[body];
    for (std::size_t t = 0; t < b.triangle->size(); ++t) {
      const auto& n = (*b.triangle)[t];
      const double area =
          0.5 * (b.node[n[1]] - b.node[n[0]]).cross(b.node[n[2]] - b.node[n[0]]).norm();
      for (std::size_t q = 0; q < 3; ++q) shared += c.work.share[body][3 * t + q] * area / 3;
    }
  }
  EXPECT_GT(touching, 10);
  EXPECT_NEAR(shared, 2 * touching, 1e-12 * shared);
}

TEST(TriangleContacts, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  std::vector<std::vector<double>> force;
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    Clump c = make_triangle_clump(81);
    c.find();
    force.push_back(exact_node_force(c));
  }
  set_threads(before);
  EXPECT_EQ(force[0], force[1]);
  EXPECT_EQ(force[0], force[2]);
}

}  // namespace
}  // namespace acinus::dcm
