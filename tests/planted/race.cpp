/// Plants a sum of forces that two threads add to without a lock: ThreadSanitizer must tell it.
/// With the argument `clean` the same sum is made as the project makes it, in fixed chunks: nothing
/// may be told.

#include <omp.h>

#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

int main(int n_argument, char** argument) {
  const bool clean = n_argument > 1 && std::string_view(argument[1]) == "clean";
  const std::vector<double> force(100'000, 1.0);
  const int n = static_cast<int>(force.size());
  double sum = 0;
  std::array<double, 2> chunk{};
#pragma omp parallel num_threads(2)
  {
    const int thread = omp_get_thread_num();
    double& target = clean ? chunk[static_cast<std::size_t>(thread)] : sum;
#pragma omp for schedule(static)
    for (int i = 0; i < n; ++i) target += force[static_cast<std::size_t>(i)];
  }
  std::printf("sum %g\n", sum + chunk[0] + chunk[1]);
}
