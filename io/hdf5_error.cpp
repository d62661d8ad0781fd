#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/hdf5.hpp"

namespace acinus::io::h5 {
namespace {

struct Stack {
  std::string deepest;  ///< HDF5's own description of the first failure
  int error = 0;        ///< errno, if a driver quoted one
};

herr_t visit(unsigned, const H5E_error2_t* entry, void* data) {
  auto& stack = *static_cast<Stack*>(data);
  if (entry->desc == nullptr) return 0;
  stack.deepest = entry->desc;
  if (const char* found = std::strstr(entry->desc, "errno = ")) stack.error = std::atoi(found + 8);
  return 0;
}

}  // namespace

void fail(const std::string& file, const std::string& attempted, int error) {
  Stack stack;  // downward: from the call made here to the innermost one, which knows the cause
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, visit, &stack);
  if (error == 0) error = stack.error;
  std::string reason = error == EBADMSG ? "the bytes there are not those that were written"
                       : error != 0     ? std::strerror(error)
                                        : stack.deepest;
  if (reason.empty()) reason = "unknown cause";
  H5Eclear2(H5E_DEFAULT);
  throw Error(fmt::format("{}: cannot {}: {}. {}.", file, attempted, reason, disk_advice(error)),
              Exit::kFileError);
}

}  // namespace acinus::io::h5
