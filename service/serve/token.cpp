#include "service/serve/token.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/inside.hpp"

namespace acinus::service {

namespace {

constexpr std::size_t kMostTokenBytes = 4096;  ///< of the token file, bytes

}  // namespace

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  check(getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
        "no random numbers from the system", Exit::kFileError);
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::string keep_token(const std::string& file) {
  struct stat status {};
  if (lstat(file.c_str(), &status) == 0) {
    check(S_ISREG(status.st_mode) && status.st_uid == geteuid() && (status.st_mode & 077) == 0,
          fmt::format("{}: others made it or can read or write it, so it may be no secret. Remove "
                      "it, and a new one is made.",
                      file));
    std::string token = io::read_text_beside(file, kMostTokenBytes);
    while (!token.empty() && token.back() == '\n') token.pop_back();
    check(token.size() >= 16,
          fmt::format("{}: holds no token of 16 characters or more. Remove it, and a new one is "
                      "made.",
                      file));
    return token;
  }
  const std::string token = make_token(), line = token + "\n";
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) io::fail_on_disk(file, "be made", errno);
  const bool written =
      io::write_all(descriptor, reinterpret_cast<const std::byte*>(line.data()), line.size(), 0);
  const int error = errno;
  close(descriptor);
  if (!written) io::fail_on_disk(file, "be written", error);
  return token;
}

bool same_secret(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < a.size() && !b.empty(); ++k)
    difference |= static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k % b.size()]);
  return difference == 0;
}

}  // namespace acinus::service
