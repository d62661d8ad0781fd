#include "core/parallel/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "core/parallel/system_entry.hpp"

namespace acinus {
namespace {

/// Memory limit of the control group, bytes; infinite if there is none.
double group_limit() {
  std::ifstream file("/sys/fs/cgroup/memory.max");
  double bytes = 0;
  return file >> bytes ? bytes : std::numeric_limits<double>::infinity();
}

}  // namespace

double machine_memory() {
  const double physical =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::min(physical, group_limit());
}

std::uint64_t rss_bytes() {
  const std::string entry = read_system_entry("/proc/self/status", "VmRSS");
  return entry.empty() ? 0 : 1024 * std::stoull(entry);
}

std::uint64_t peak_rss_bytes() {
  // getrusage comes second: its peak survives exec, so it may be that of the starting shell.
  const std::string entry = read_system_entry("/proc/self/status", "VmHWM");
  if (!entry.empty()) return 1024 * std::stoull(entry);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

void return_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 1 << 22);                          // bytes
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());  // bytes
#endif
}

}  // namespace acinus
