#include "runs/scene/scene_folder.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.hpp"

namespace acinus::runs {
namespace fs = std::filesystem;

std::string scene_folder() {
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  const fs::path above = program.parent_path().parent_path();
  const fs::path places[] = {above / "runs" / "scenes", above / "share" / "acinus" / "scenes",
                             ACINUS_SCENE_DIR};
  for (const fs::path& place : places)
    if (fs::is_directory(place, code)) return place.string();
  throw Error(fmt::format("no folder of shipped scenes: neither {}, {} nor {}", places[0].string(),
                          places[1].string(), places[2].string()),
              Exit::kFileError);
}

}  // namespace acinus::runs
