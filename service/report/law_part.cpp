#include <filesystem>
#include <nlohmann/json.hpp>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/inside.hpp"
#include "runs/scene/bounded_json.hpp"
#include "service/report/other_parts.hpp"

namespace acinus::service {
namespace fs = std::filesystem;

nlohmann::ordered_json describe_law(const std::string& file) {
  using OrderedJson = nlohmann::ordered_json;
  const bool is_folder = fs::is_directory(file);
  const fs::path law = is_folder ? fs::path(file) / "law.json" : fs::path(file);
  std::error_code code;
  check(is_folder ? io::is_file_inside(file, "law.json") : fs::is_regular_file(law, code),
        law.string() + ": is a link or no regular file, and is not read.", Exit::kFileError);
  calibration::read_law(law.string());  // whole and unchanged, or an error that says what is wrong
  OrderedJson j{{"type", "law"}, {"name", law.filename().string()}, {"folder", file}};
  j["law"] = OrderedJson::parse(io::read_text_file(law.string()), nullptr, true, true);
  const fs::path beside =
      is_folder ? fs::path(file) : law.parent_path() / (law.stem().string() + ".calibration");
  if (fs::exists(beside / "curves.json", code))
    j["curves"] =
        runs::parse_or_discard<OrderedJson>(io::read_text_inside(beside.string(), "curves.json"));
  return j;
}

}  // namespace acinus::service
