#pragma once
/// Helpers of the mesh tests: small files in a folder of their own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/readers/read_surface.hpp"
#include "tests/messages.hpp"

namespace acinus::geometry {

/// Removed with its files at the end of the test.
class TempFolder {
 public:
  TempFolder() {
    static int counter = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("acinus_mesh_test_" + std::to_string(getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  /// Writes the file and returns its path.
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return (path_ / name).string();
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Message with which a file of closed surfaces is refused.
inline std::string refusal(const std::string& path) {
  return test::message_of([&] { read_closed_surfaces(path, 1); });
}

/// Big-endian bytes of a 4-byte value.
template <class Value>
std::string big_endian(Value value) {
  const auto raw = std::bit_cast<std::uint32_t>(value);
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(raw >> shift & 0xff);
  return bytes;
}

}  // namespace acinus::geometry
