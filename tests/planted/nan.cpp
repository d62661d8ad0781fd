/// Plants a force that is not a number: the step must not be accepted. Exit code 0 means that it
/// was.

#include <cstdio>
#include <limits>
#include <utility>

#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

int main() {
  using namespace acinus;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  coupling::World world = coupling::make_test_world(
      {{{0, 0, 0}, true, Vec3(nan, 0, 0)}, {{23, 0, 0}}, {{11, 20, 0}, false}});
  coupling::Simulation simulation(std::move(world));
  const coupling::LoopResult result = simulation.run_until(600);
  if (!result.ok) {
    std::printf("refused: %s\n", result.last.cause.c_str());
    return 3;
  }
  std::printf("not caught: %g s were simulated\n", simulation.time());
}
