#pragma once
/// Files inside an untrusted folder: paths are resolved below the folder, without links and never
/// out of it, and only regular files are opened.

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace acinus::io {

/// Owner of a file descriptor.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  int number() const { return number_; }
  bool valid() const { return number_ >= 0; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

/// Opens a regular file for reading.
/// @param folder  may itself be a link: the caller trusts its name
/// @param path    relative to the folder
/// @return not valid, with errno set, if there is no such regular file or the path contains a link
Descriptor open_inside(const std::string& folder, const std::string& path);

/// Size of such a file, bytes; nothing if there is none.
std::optional<std::size_t> size_inside(const std::string& folder, const std::string& path);

/// True for a regular file reached without a link.
inline bool is_file_inside(const std::string& folder, const std::string& path) {
  return size_inside(folder, path).has_value();
}

/// Reads the text of such a file.
/// @throws Error(kFileError) if there is none, or it has more than `most` bytes
std::string read_text_inside(const std::string& folder, const std::string& path,
                             std::size_t most = 256'000'000);

/// Reads the text of a file by its whole path, which must not be a link.
std::string read_text_beside(const std::string& path, std::size_t most = 4'000'000'000);

/// True for a folder below another that is reached without a link, or does not exist yet.
bool is_folder_inside(const std::string& folder, const std::string& path);

}  // namespace acinus::io
