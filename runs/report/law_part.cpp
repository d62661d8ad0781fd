#include <filesystem>
#include <nlohmann/json.hpp>

#include "calibration/law_file.hpp"
#include "core/io/disk.hpp"
#include "runs/report/other_parts.hpp"

namespace acinus::runs {
namespace fs = std::filesystem;

nlohmann::ordered_json describe_law(const std::string& file) {
  using Json = nlohmann::ordered_json;
  const bool is_folder = fs::is_directory(file);
  const fs::path law = is_folder ? fs::path(file) / "law.json" : fs::path(file);
  calibration::read_law(law.string());  // whole and unchanged, or an error that says what is wrong
  Json j{{"type", "law"}, {"name", law.filename().string()}, {"folder", file}};
  j["law"] = Json::parse(io::read_text_file(law.string()));
  const fs::path beside =
      is_folder ? fs::path(file) : law.parent_path() / (law.stem().string() + ".calibration");
  std::error_code code;
  if (fs::exists(beside / "curves.json", code))
    j["curves"] =
        Json::parse(io::read_text_file((beside / "curves.json").string()), nullptr, false);
  return j;
}

}  // namespace acinus::runs
