/// Plants a sum of forces that two threads add to without a lock: ThreadSanitizer must tell it.
/// With the argument `clean` the same sum is made as the project makes it, in fixed parts: no
/// race may be reported.

#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include "core/parallel/threads.hpp"

int main(int n_argument, char** argument) {
  const bool clean = n_argument > 1 && std::string_view(argument[1]) == "clean";
  const std::vector<double> force(100'000, 1.0);
  double sum = 0;
  std::array<double, 2> part_sum{};
  acinus::set_threads(2);
  // Often: one thread may come too late and find nothing left to do.
  for (int round = 0; round < 100; ++round)
    acinus::for_each_part(part_sum.size(), [&](std::size_t part) {
      double& target = clean ? part_sum[part] : sum;
      const std::size_t half = force.size() / 2;
      for (std::size_t k = part * half; k < (part + 1) * half; ++k) target += force[k];
    });
  std::printf("sum %g\n", sum + part_sum[0] + part_sum[1]);
}
