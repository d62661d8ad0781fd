/// Start of a submitted scene as data for the 3D view of the service's page.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/session/start_frame.hpp"
#include "service/report/frames.hpp"
#include "service/report/run_part.hpp"
#include "service/report/scene_part.hpp"
#include "service/serve/submission.hpp"

namespace acinus::service {
namespace {

/// Notes without the folders of absolute paths in parentheses, which are no matter of the client's.
std::vector<std::string> without_folders(std::vector<std::string> notes) {
  for (std::string& note : notes)
    for (std::size_t at = note.find("(/"); at != std::string::npos; at = note.find("(/", at + 1)) {
      const std::size_t end = std::min(note.find(')', at), note.size());
      const std::size_t last = note.rfind('/', end);
      note.erase(at + 1, last - at);
    }
  return notes;
}

}  // namespace

void write_preview(const std::string& folder, const ServeOptions& options) {
  using OrderedJson = nlohmann::ordered_json;
  prepare_submission(folder, options);
  const runs::Scene scene = runs::read_scene(folder + "/scene.json");
  const runs::StartFrame start = runs::make_start_frame(scene);
  const auto resolved = runs::parse_or_discard<OrderedJson>(scene.resolved_json);
  const OrderedJson preview{{"name", scene.name},
                            {"cells", {{"dcm", start.deformable}, {"cbm", start.spheres}}},
                            {"end_s", scene.time.end},
                            {"start_up", scene.start_up.enabled},
                            {"vessel_length_um", short_number(start.vessel_length)},
                            {"notes", without_folders(start.notes.info)},
                            {"warnings", without_folders(start.notes.warnings)},
                            {"walls", list_walls(resolved)},
                            {"frames", describe_frames(pack_frame(start.frame), 1)},
                            {"scene", resolved}};
  const std::string text = preview.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  check(static_cast<double>(text.size()) <= kMostPreviewBytes,
        fmt::format("the picture of this start takes {:.0f} MB; at most {:.0f} MB are sent. Start "
                    "the run, or look at a scene with fewer cells.",
                    1e-6 * static_cast<double>(text.size()), 1e-6 * kMostPreviewBytes));
  io::write_text_file(folder + "/" + kPreviewFile, text);
}

}  // namespace acinus::service
