/// Test that a step asks for no memory once its buffers have their size.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "coupling/apparatus/contraction/contraction.hpp"
#include "coupling/apparatus/pull/pull.hpp"
#include "coupling/apparatus/stretcher/stretcher.hpp"
#include "coupling/apparatus/suction/suction.hpp"
#include "coupling/apparatus/temperature/temperature.hpp"
#include "coupling/step/controller.hpp"
#include "tests/coupling/worlds.hpp"

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t align) {
  ++allocations;
  const auto a = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace acinus::coupling {
namespace {

/// Cells in a row between two walls, with a vessel beside them.
World make_row(bool deformable, bool spheres) {
  std::vector<TestCell> cells;
  for (int k = 0; k < 6; ++k)
    cells.push_back({Vec3(23 * k, 0.5 * (k % 2), 0), deformable && (!spheres || k % 2 == 0)});
  World w = make_test_world(cells, 60, 42);
  contact::Plane below;
  below.name = "below";
  below.point = Vec3(0, 0, -11.9);
  below.material = {.adhesion = 0.01};
  w.params.boundary.planes = {below};
  geometry::Network& vessel = w.params.boundary.vessels.network;
  vessel.node = {Vec3(-30, 16, 0), Vec3(150, 16, 0)};
  vessel.segment = {{0, 1}};
  vessel.radius = {{5, 5}};
  w.params.boundary.vessels.segments_of_node = {{0}, {0}};
  w.params.boundary.vessels.material = {};
  return w;
}

/// Allocations of steps in which lists of near cells held, and in which some were made.
struct Count {
  int steps = 0, with_lists = 0;
  long held = 0, made = 0;
};

Count count_allocations(World& w, int warm_up, int n) {
  SizedWorkspace work(w);
  Count count;
  for (int k = 0; k < warm_up + n; ++k) {
    const auto lists = work.dcm.lists.made + work.cbm.list_builds;
    const long before = allocations;
    EXPECT_TRUE(take_step(w, work, 10).accepted);
    const long more = allocations - before;
    if (k < warm_up) continue;
    const bool made = work.dcm.lists.made + work.cbm.list_builds > lists;
    ++(made ? count.with_lists : count.steps);
    (made ? count.made : count.held) += more;
  }
  return count;
}

/// Nucleus pressed against one side of its cell, with links: all of it is at work.
TEST(Allocation, NucleiAskForNoneEither) {
  World w = make_test_world({{Vec3::Zero()}, {Vec3(23, 0, 0)}}, 10, 42);
  w.params.dcm[0].nucleus = dcm::Nucleus{.size = 0.7, .link_young = 0.1};
  give_nuclei(w);
  std::vector<Vec3> nucleus;
  dcm::copy_nucleus(w.state.dcm, 0, nucleus);
  for (Vec3& x : nucleus) x.x() += 2.8;
  dcm::store_nucleus(nucleus, 0, w.state.dcm);
  const Count c = count_allocations(w, 200, 60);
  EXPECT_GT(c.steps, 10);
  EXPECT_EQ(c.held, 0) << "in " << c.steps << " steps";
}

/// One device of each kind.
Apparatus make_apparatus() {
  Temperature temperature;
  temperature.course.entry = {{0, 290}, {1e4, 310}};
  Contraction contraction;
  contraction.course.resize(1);
  contraction.course[0].entry = {{0, 1}, {1e4, 2}};
  Stretcher stretcher;
  stretcher.beams.power = 1e14;
  stretcher.pulse = {{0, 1e6}};
  Suction suction;
  suction.mouth = Vec3(60, 0, 8);
  suction.reach = 5;
  suction.pressure.entry = {{0, 0}, {1e4, 1e-3}};
  Pulls pulls;
  pulls.pull.resize(2);
  pulls.pull[0].force.entry = {{0, 0}, {1e4, 1e-3}};
  pulls.pull[1].stiffness = 1e-3;
  Apparatus all;
  all.add(temperature);
  all.add(contraction);
  all.add(stretcher);
  all.add(suction);
  all.add(pulls);
  return all;
}

TEST(Allocation, AStepOfAWorldThatWasSteppedBeforeAsksForNone) {
  for (const auto& [deformable, spheres] : {std::pair(true, false), {false, true}, {true, true}}) {
    World w = make_row(deformable, spheres);
    w.params.apparatus = make_apparatus();
    const Count c = count_allocations(w, 200, 60);
    EXPECT_GT(c.steps, 10);
    EXPECT_EQ(c.held, 0) << "in " << c.steps << " steps";
    // A list that is longer than before needs room; nothing else does.
    EXPECT_LE(c.made, 40L * c.with_lists) << "in " << c.with_lists << " steps";
  }
}

}  // namespace
}  // namespace acinus::coupling
