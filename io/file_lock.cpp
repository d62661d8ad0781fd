#include "io/file_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::io {
namespace {

/// Opens a regular file, not through a link: the holder of a lock writes its name into it.
/// @param mode  of a new file
/// @return -1 with errno set
int open_regular(const std::string& path, int flags, mode_t mode = 0) {
  const int descriptor =
      open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY, mode);
  struct stat status {};
  if (descriptor >= 0 && (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
    close(descriptor);
    errno = ELOOP;
    return -1;
  }
  return descriptor;
}

/// Permissions of a lock file: for all accounts that may write in its folder. Read permission is
/// enough to lock it and so to block its owner, so other accounts have none.
mode_t mode_of_lock(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  struct stat status {};
  if (stat(folder.empty() ? "." : folder.c_str(), &status) != 0) return S_IRUSR | S_IWUSR;
  mode_t mode = S_IRUSR | S_IWUSR;
  if ((status.st_mode & S_IWGRP) != 0) mode |= S_IRGRP | S_IWGRP;
  if ((status.st_mode & S_IWOTH) != 0) mode |= S_IROTH | S_IWOTH;
  return mode;
}

/// Opens the lock file, or makes it; sets its permissions if it is this user's.
int open_file(const std::string& path) {
  const mode_t mode = mode_of_lock(path);
  const int descriptor = open_regular(path, O_RDWR | O_CREAT, mode);
  [[maybe_unused]] const int not_ours = descriptor < 0 ? 0 : fchmod(descriptor, mode);
  check(descriptor >= 0 || errno != ELOOP,
        path + ": is a link or no regular file, and cannot be a lock. Remove it.",
        Exit::kFileError);
  if (descriptor < 0) fail_on_disk(path, "open", errno);
  return descriptor;
}

/// Tries to lock a file. @return false if another process holds it
bool lock(int descriptor, int how) {
  while (flock(descriptor, how) != 0) {
    if (errno == EINTR) continue;
    return errno != EWOULDBLOCK;
  }
  return true;
}

constexpr double kRetryInterval = 0.02;  // s, between two looks

void wait_a_moment() { usleep(static_cast<useconds_t>(1e6 * kRetryInterval)); }

std::string this_host() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return host.data();
}

std::string describe_this_process() {
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC", getpid(), this_host(),
                     fmt::gmtime(std::time(nullptr)));
}

std::string first_line(const std::string& path) {
  std::array<char, 512> text{};
  const int descriptor = open_regular(path, O_RDONLY);
  if (descriptor < 0) return "";
  const ssize_t n = pread(descriptor, text.data(), text.size(), 0);
  close(descriptor);
  const std::string line(text.data(), std::max<ssize_t>(n, 0));
  return line.substr(0, line.find('\n'));
}

/// True if the line names a process that may hold the lock: not one of this machine that ended
/// without removing its name, because it was killed for example.
bool names_a_process(const std::string& line) {
  pid_t process = 0;
  if (std::sscanf(line.c_str(), "process %d on ", &process) != 1 || process <= 0) return false;
  if (line.find(" on " + this_host() + " since ") == std::string::npos) return true;
  return kill(process, 0) == 0 || errno != ESRCH;
}

/// True if the system's list of locks contains the file: for accounts that may not open it.
bool is_listed(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return false;
  const std::string file =
      fmt::format(" {:02x}:{:02x}:{} ", major(status.st_dev), minor(status.st_dev), status.st_ino);
  std::ifstream list("/proc/locks");
  for (std::string line; std::getline(list, line);)
    if (line.find("FLOCK") != std::string::npos && line.find(file) != std::string::npos)
      return true;
  return false;
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
  if (descriptor_ < 0) return;
  // The next one to ask must not read the name of one that holds it no more.
  [[maybe_unused]] const int failed = ftruncate(descriptor_, 0);
  close(descriptor_);
}

std::optional<FileLock> FileLock::try_take(const std::string& path, double patience_s) {
  const int descriptor = open_file(path);
  while (!lock(descriptor, LOCK_EX | LOCK_NB)) {
    if (patience_s <= 0) {
      close(descriptor);
      return std::nullopt;
    }
    patience_s -= kRetryInterval;
    wait_a_moment();
  }
  FileLock held(descriptor);
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
  const int descriptor = open_regular(path, O_RDONLY);
  if (descriptor < 0) return errno == EACCES && is_listed(path);
  const bool free = lock(descriptor, LOCK_SH | LOCK_NB);
  close(descriptor);
  return !free;
}

std::string name_holder(const std::string& path, double patience_s) {
  while (true) {
    const std::string line = first_line(path);
    if (names_a_process(line)) return line;
    if (patience_s <= 0) return "another process";
    patience_s -= kRetryInterval;
    wait_a_moment();
  }
}

}  // namespace acinus::io
