/// Maugis-Dugdale between triangles as loads: balance, the law, invariance, matrix, areas.

#include "dcm/contact/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/maugis_overlap.hpp"
#include "contact/maugis_triangles.hpp"
#include "contact/static_mesh.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/node_friction.hpp"
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
  const double exact = contact::maugis_at_overlap({{5, 10, 0.01}, 0.5}, 0.5).force;
  std::printf("push of two spheres over the curve's: %.4f\n", push / exact);
  EXPECT_NEAR(push / exact, 1, 3 * 0.004);
}

/// Round cell of 642 nodes and radius 10 um around a place, alone, for the law of triangles.
Clump make_round_cell(const Vec3& center) {
  Clump c;
  auto random = reference::stream(82);
  c.add_cells({new_cell(0, center, 10, reference::random_rotation(random), 642)});
  for (int i = 0; i < 642; ++i) {
    const Address a = node_address(c.state, 0, i);
    const Vec3 out = load_point(c.state.position.data(), a) - center;
    store_point(c.state.position.data(), a, center + 10 * out.normalized());
  }
  c.options.law = ContactLaw::kMaugisDugdale;
  return c;
}

/// Sum of the forces on the cell along a direction, nN.
double force_along(std::span<const contact::Contact> contacts, const Vec3& direction) {
  double force = 0;
  for (const contact::Contact& k : contacts) force += k.force * k.normal.dot(direction);
  return force;
}

// Estimated curvatures, 2.4e-5 off for 642 nodes, make the overlap 0.5 nm wrong.
TEST(TriangleContacts, WallsFollowTheCurve) {
  const double overlap = 0.3, W = 0.01;
  Clump on_plane = make_round_cell(Vec3(0, 0, 10 - overlap));
  on_plane.boundary.planes.push_back({.name = "floor", .material = {.adhesion = W}});
  on_plane.find();
  const double plane = contact::maugis_at_overlap({{10, 10, W}, W / 0.02}, overlap).force;
  const double push = force_along(on_plane.obstacle(), Vec3::UnitZ());
  std::printf("on a plane: %.6f of the curve\n", push / plane);
  EXPECT_NEAR(push, plane, 3e-3 * plane);
  EXPECT_GT(on_plane.work.share[0].size(), 0);

  // A wall of a tenth of the modulus of the contact: in series.
  on_plane.boundary.planes[0].material = {.adhesion = 0, .young = 1};
  on_plane.find();
  const double soft = contact::maugis_at_overlap({{10, 1 / 1.1, 0}, 0}, overlap).force;
  EXPECT_NEAR(force_along(on_plane.obstacle(), Vec3::UnitZ()), soft, 3e-3 * soft);

  // In a capsule of 30 um: R^ of 15, to the order of Hertz.
  Clump in_capsule = make_round_cell(Vec3(0, 0, -20 - overlap));
  in_capsule.boundary.capsules.push_back({.name = "capsule", .radius = 30, .material = {}});
  in_capsule.find();
  const double capsule = contact::maugis_at_overlap({{15, 10, 0}, 0}, overlap).force;
  EXPECT_NEAR(force_along(in_capsule.obstacle(), Vec3::UnitZ()), capsule, 0.02 * capsule);
}

// A mesh of a ball beside the cell is met as another cell is.
TEST(TriangleContacts, StaticMeshesFollowTheCurve) {
  const double overlap = 0.3;
  Clump c = make_round_cell(Vec3(0, 0, 20 - overlap));
  const geometry::Topology& t = geometry::shared_icosphere(642);
  geometry::Surface ball{{}, t.triangle};
  for (const Vec3& x : t.rest) ball.node.push_back(10 * x.normalized());
  c.boundary.meshes.push_back(contact::make_static_mesh("ball", ball, false));
  c.find();
  const double exact = contact::maugis_at_overlap({{5, 10, 0}, 0}, overlap).force;
  EXPECT_NEAR(force_along(c.surface(), Vec3::UnitZ()), exact, 3e-3 * exact);
  for (const contact::Contact& k : c.surface()) EXPECT_EQ(k.partner, contact::Partner::kMesh);
}

// On a straight vessel of 5 um the relative curvatures are 0.1 and 0.3 um^-1: the ellipse of Hertz,
// with the correction F2 of Johnson's Contact Mechanics, section 4.2.
TEST(TriangleContacts, VesselsFollowTheEllipseOfHertz) {
  const double overlap = 0.1;
  Clump c = make_round_cell(Vec3(0, 0, 15 - overlap));
  geometry::Network network;
  network.node = {Vec3(0, -60, 0), Vec3(0, 60, 0)};
  network.segment = {{0, 1}};
  network.radius = {{5, 5}};
  contact::set_network(c.boundary.vessels, network);
  c.boundary.vessels.material = {};
  c.find();
  const double mean_radius = 1 / std::sqrt(0.1 * 0.3);
  const double f2 = 1 - std::pow(std::pow(3.0, 0.0684) - 1, 1.531);
  const double exact = 4.0 / 3 * 10 * std::sqrt(mean_radius) * std::pow(overlap / f2, 1.5);
  const double force = force_along(c.obstacle(), Vec3::UnitZ());
  std::printf("on a vessel: %.3f of the ellipse of Hertz\n", force / exact);
  EXPECT_NEAR(force, exact, 0.06 * exact);  // each triangle takes the mean curvature
  for (const contact::Contact& k : c.obstacle()) EXPECT_EQ(k.partner, contact::Partner::kVessel);
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

// A tilt moves the centre of the stress of a contact aside. The matrix has this moment from three
// places a part: of a contact in the middle of its triangle and of one that is wider than it.
TEST(TriangleContacts, MatrixResistsATilt) {
  const std::array<Vec3, 3> corner = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 2 * std::sqrt(3.0), 0)};
  const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
  const auto contacts_at = [&](double tilt, double radius, double overlap) {
    std::array<Vec3, 3> x;
    for (int q = 0; q < 3; ++q)
      x[q] = middle + Eigen::AngleAxisd(tilt, Vec3::UnitX()) * (corner[q] - middle);
    const contact::CurvedTriangle t = contact::make_curved_triangle(x, 1 / radius);
    // The sphere of the triangle goes through its corners.
    const double rim = t.circumradius, cap = radius - std::sqrt(radius * radius - rim * rim);
    contact::Contacts found;
    add_object_contacts({.modulus = 10, .adhesion = 0, .cohesive_stress = 0}, t,
                        {middle + (cap - overlap) * Vec3::UnitZ(), -Vec3::UnitZ(), 0, 0}, {},
                        nullptr, found);
    return std::pair(found, t);
  };
  const auto arm_of = [&](const contact::Contact& k, const contact::CurvedTriangle& t) {
    const auto w = contact::Contact::weights_at(k.place_a);
    return Vec3(w[0] * t.corner[0] + w[1] * t.corner[1] + w[2] * t.corner[2] - middle);
  };
  const auto moment_of = [&](const auto& at) {  // about the x axis through the middle, nN um
    double moment = 0;
    for (const contact::Contact& k : at.first)
      moment += arm_of(k, at.second).cross(k.force * k.normal).x();
    return moment;
  };
  for (const double radius : {12.0, 1e3}) {
    const double overlap = radius > 100 ? 0.3 : 0.1, tilt = 1e-5;
    const auto at = contacts_at(0, radius, overlap);
    ASSERT_EQ(at.first.size(), 3);
    double stiffness = 0;
    for (const contact::Contact& k : at.first)
      stiffness += k.slope * std::pow(arm_of(k, at.second).y(), 2);
    const double exact = (moment_of(contacts_at(-tilt, radius, overlap)) -
                          moment_of(contacts_at(tilt, radius, overlap))) /
                         (2 * tilt);
    std::printf("radius %4.0f um: stiffness against tilt %.3g nN um, exact %.3g\n", radius,
                stiffness, exact);
    EXPECT_NEAR(stiffness, exact, 0.25 * exact);
  }
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

// From node to node: a third of the area for each node of either side, and none between places.
TEST(TriangleContacts, RubFromNodeToNode) {
  Clump c = make_triangle_clump(83);
  c.options.friction_form = FrictionForm::kNodes;
  c.find();
  solve::PointLinks links;
  add_node_friction(c.input(), c.work, c.contacts, links);
  double touching = 0, friction = 0;
  for (const contact::Contact& k : c.surface()) touching += k.touching;
  for (const solve::PointLink& l : links) friction += static_cast<double>(l.friction);
  for (const solve::Link& l : c.links.link) EXPECT_EQ(l.friction, 0);
  EXPECT_GT(touching, 10);
  EXPECT_NEAR(friction, 50 * touching, 1e-6 * friction);
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
