/// Plants an index past the end of the forces of a real world: AddressSanitizer must stop it.

#include <cstdio>

#include "tests/coupling/worlds.hpp"

int main() {
  using namespace acinus::coupling;
  const World world = make_test_world({{{0, 0, 0}}, {{23, 0, 0}, false}});
  SizedWorkspace work(world);
  assemble(world, 60, work);
  work.system.force.shrink_to_fit();  // what lies behind must not belong to it
  const std::size_t past = work.system.force.size();
  std::printf("not caught: a force past the end is %g nN\n", work.system.force[past]);
}
