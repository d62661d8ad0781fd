#include "core/io/file_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
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

std::string describe_this_process() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC", getpid(), host.data(),
                     fmt::gmtime(std::time(nullptr)));
}

}  // namespace

void FileLock::sign() const {
  const std::string text = describe_this_process() + "\n";
  // Only a help for who finds it locked: that a full disk keeps it empty is no reason to stop.
  if (ftruncate(descriptor_, 0) != 0) return;
  [[maybe_unused]] const auto written = pwrite(descriptor_, text.data(), text.size(), 0);
}

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
  held.sign();
  return held;
}

FileLock FileLock::take(const std::string& path) {
  FileLock held(open_file(path));
  lock(held.descriptor_, LOCK_EX);
  held.sign();
  return held;
}

bool is_locked(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool free = lock(descriptor, LOCK_SH | LOCK_NB);
  close(descriptor);
  return !free;
}

std::string name_holder(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line.starts_with("process ") ? line : "another process";
}

}  // namespace acinus::io
