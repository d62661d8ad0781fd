#include "core/io/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "core/io/disk.hpp"

namespace acinus::io {
namespace {

int open_file(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_on_disk(path, "open", errno);
  return descriptor;
}

/// @return false if another one holds it
bool lock(int descriptor, int how) {
  while (flock(descriptor, how) != 0) {
    if (errno == EINTR) continue;
    return errno != EWOULDBLOCK;
  }
  return true;
}

}  // namespace

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<FileLock> FileLock::try_take(const std::string& path, double patience_s) {
  constexpr double kWait = 0.02;  // s
  FileLock held(open_file(path));
  while (!lock(held.descriptor_, LOCK_EX | LOCK_NB)) {
    if (patience_s <= 0) return std::nullopt;
    patience_s -= kWait;
    usleep(static_cast<useconds_t>(1e6 * kWait));
  }
  return held;
}

FileLock FileLock::take(const std::string& path) {
  FileLock held(open_file(path));
  lock(held.descriptor_, LOCK_EX);
  return held;
}

bool is_locked(const std::string& path) {
  return access(path.c_str(), F_OK) == 0 && !FileLock::try_take(path);
}

}  // namespace acinus::io
