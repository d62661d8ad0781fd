#include "io/disk.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"

namespace acinus::io {
namespace {

void sync(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) fail_on_disk(path, "open", errno);
  const int error = fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  // Some network file systems cannot sync a folder and say EINVAL; there is nothing better to do
  // there.
  if (error != 0 && error != EINVAL) fail_on_disk(path, "write to disk", error);
}

/// True for a device or a pipe: it must be written to, not replaced by a file.
bool is_stream(const std::string& path) {
  namespace fs = std::filesystem;
  // Descriptors of this process.
  for (const char* own : {"/dev/stdout", "/dev/stderr", "/dev/fd/", "/proc/self/fd/"})
    if (path.starts_with(own)) return true;
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void append(const std::string& path, std::string_view text) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) fail_on_disk(path, "open", errno);
  const int error = write_stream(descriptor, text);
  ::close(descriptor);
  if (error != 0) fail_on_disk(path, "write", error);
}

}  // namespace

std::string make_temporary_folder(const std::string& prefix) {
  std::string name = (std::filesystem::temp_directory_path() / prefix).string();
  name.append(6, 'X');  // mkdtemp puts its own letters there
  if (mkdtemp(name.data()) == nullptr) fail_on_disk(name, "make a folder", errno);
  return name;
}

void write_text_file(const std::string& path, std::string_view text) {
  if (is_stream(path)) return append(path, text);
  const std::string partial = path + ".tmp";
  const RemoveUnlessMoved cleanup{partial};
  const int descriptor =
      open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) fail_on_disk(partial, "create", errno);
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  int error = write_all(descriptor, bytes, text.size(), 0) ? 0 : errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) fail_on_disk(partial, "write", error);
  replace_file(partial, path);
}

std::string read_text_file(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rbe");
  if (file == nullptr) fail_on_disk(path, "open", errno);
  std::string text;
  char buffer[65536];
  errno = 0;
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, n);
  const int error = std::ferror(file) != 0 ? errno : 0;
  std::fclose(file);
  if (error != 0) fail_on_disk(path, "read", error);
  return text;
}

int write_stream(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(descriptor, text.data(), text.size());
    if (n >= 0) {
      text.remove_prefix(n);
    } else if (errno == EAGAIN) {  // another process that has the pipe made it non-blocking
      pollfd room{descriptor, POLLOUT, 0};
      poll(&room, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

bool write_all(int descriptor, const std::byte* data, std::uint64_t size, std::uint64_t address) {
  while (size > 0) {
    const ssize_t n = pwrite(descriptor, data, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    address += static_cast<std::uint64_t>(n);
    size -= static_cast<std::uint64_t>(n);
  }
  return true;
}

void replace_file(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0)
    fail_on_disk(to, "put the new version in place", errno);
}

void sync_file(const std::string& path) { sync(path, O_RDONLY); }
void sync_folder(const std::string& folder) {
  sync(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

RemoveUnlessMoved::~RemoveUnlessMoved() { unlink(path.c_str()); }

void fail_on_disk(const std::string& path, const std::string& attempted, int error) {
  throw Error(fmt::format("{}: cannot {}: {}. {}.", path, attempted, std::strerror(error),
                          disk_advice(error)),
              Exit::kFileError);
}

const char* disk_advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "Free space (or raise the limit) there, or choose another folder; finished frames are "
             "intact";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Choose a folder you may write to, or change its permissions";
    case ENOENT:
    case ENOTDIR:
      return "Check the path: the folder or file does not exist";
    case ESPIPE:
      return "It is a pipe or a device; a regular file is needed";
    case EISDIR:
      return "Give a file, not a folder";
    case EBADMSG:
      return "The file is damaged: `acinus run --resume` keeps what is left of a run, other "
             "commands "
             "need an intact copy";
    case EIO:
      return "The disk reports a fault; choose another one";
    default:
      return "Check that the file is complete, was written by acinus and is not in use by another "
             "program";
  }
}

}  // namespace acinus::io
