#include "io/inside.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>

#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::io {
namespace {

/// Opens a path below a folder by the kernel's openat2, with no link anywhere.
int open_beneath(int folder, const std::string& path, std::uint64_t flags) {
  open_how how{};
  how.flags = flags;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  return static_cast<int>(syscall(SYS_openat2, folder, path.c_str(), &how, sizeof how));
}

/// Opens a path below a folder component by component, for kernels and sandboxes without openat2.
int walk_beneath(int folder, const std::string& path, int flags) {
  const std::filesystem::path parts(path);
  Descriptor at(fcntl(folder, F_DUPFD_CLOEXEC, 0));
  for (auto part = parts.begin(); at.valid() && part != parts.end();) {
    const std::string name = part->string();
    const bool last = ++part == parts.end();
    if (name.empty() || name == "." || name == ".." || name.front() == '/') {
      errno = ENOENT;
      return -1;
    }
    at = Descriptor(
        openat(at.number(), name.c_str(),
               last ? flags | O_NOFOLLOW : O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  }
  return at.release();
}

Descriptor open_any_inside(const std::string& folder, const std::string& path, int flags) {
  const Descriptor root(open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!root.valid()) return {};
  if (path.empty() || path.find('\0') != std::string::npos) {
    errno = ENOENT;
    return {};
  }
  Descriptor file(open_beneath(root.number(), path, static_cast<std::uint64_t>(flags)));
  if (!file.valid() && (errno == ENOSYS || errno == EPERM))
    file = Descriptor(walk_beneath(root.number(), path, flags));
  return file;
}

}  // namespace

Descriptor::~Descriptor() {
  const int error = errno;  // of what made it go
  if (number_ >= 0) ::close(number_);
  errno = error;
}

Descriptor open_inside(const std::string& folder, const std::string& path) {
  // A pipe must not wait for a writer.
  Descriptor file = open_any_inside(folder, path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  struct stat status {};
  if (!file.valid() || fstat(file.number(), &status) != 0) return {};
  if (S_ISREG(status.st_mode)) return file;
  errno = S_ISDIR(status.st_mode) ? EISDIR : ESPIPE;
  return {};
}

std::optional<std::size_t> size_inside(const std::string& folder, const std::string& path) {
  const Descriptor file = open_any_inside(folder, path, O_PATH | O_CLOEXEC);
  struct stat status {};
  if (!file.valid() || fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
    return std::nullopt;
  return status.st_size;
}

std::string read_text_inside(const std::string& folder, const std::string& path, std::size_t most) {
  const std::string name = (std::filesystem::path(folder) / path).string();
  const Descriptor file = open_inside(folder, path);
  if (!file.valid()) {
    check(errno != ELOOP && errno != EXDEV && errno != ESPIPE,
          fmt::format("{}: is a link or no regular file, which is not read there. Put the file "
                      "itself in its place.",
                      name),
          Exit::kFileError);
    fail_on_disk(name, "open", errno);
  }
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t n = read(file.number(), buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_on_disk(name, "read", errno);
    if (n == 0) return text;
    text.append(buffer.data(), n);
    check(text.size() <= most,
          fmt::format("{}: is longer than the {} bytes that are read.", name, most),
          Exit::kFileError);
  }
}

std::string read_text_beside(const std::string& path, std::size_t most) {
  const std::filesystem::path p(path);
  const std::string folder = p.parent_path().string();
  return read_text_inside(folder.empty() ? "." : folder, p.filename().string(), most);
}

bool is_folder_inside(const std::string& folder, const std::string& path) {
  const Descriptor found = open_any_inside(folder, path, O_PATH | O_CLOEXEC | O_DIRECTORY);
  return found.valid() || errno == ENOENT;
}

}  // namespace acinus::io
