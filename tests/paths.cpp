#include "tests/paths.hpp"

#include <filesystem>

namespace acinus::test {

std::string source_path(const std::string& file) { return ACINUS_SOURCE_DIR "/" + file; }
std::string data_path(const std::string& file) { return source_path("tests/data/" + file); }
std::string program_path() { return ACINUS_PROGRAM; }

bool has_real_data() {
  return std::filesystem::exists(real_path("vascpy")) &&
         std::filesystem::exists(real_path("simucell3d"));
}
std::string real_path(const std::string& file) { return ACINUS_REAL_DATA "/" + file; }

}  // namespace acinus::test
