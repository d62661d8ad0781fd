#include "core/parallel/machine.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/clock.hpp"
#include "core/parallel/memory.hpp"

namespace acinus {
namespace {

TEST(Machine, IsDescribed) {
  const Machine machine = describe_machine();
  std::printf("%s, %d cores, %s, peak %.1f MB, cpu %.3f s\n", machine.cpu_model.c_str(),
              machine.cores, machine.instruction_set.c_str(),
              1e-6 * static_cast<double>(peak_rss_bytes()), cpu_seconds());
  EXPECT_FALSE(machine.cpu_model.empty());
  EXPECT_GE(machine.cores, 1);
  EXPECT_EQ(machine.instruction_set, best_instruction_set());
}

}  // namespace
}  // namespace acinus
