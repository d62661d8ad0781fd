#include "runs/images/voxelise_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "geometry/implicit/vessel_mesh.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::runs {
namespace {

/// Surface of the vessels of the scene that a run file records, um; empty if it has none.
/// @throws Error for flexible vessels, whose shape a frame does not hold
std::optional<geometry::Surface> vessels_of(const io::RunReader& run, const std::string& folder) {
  const auto provenance = run.provenance();
  const auto text = provenance.find("scene");
  if (text == provenance.end()) return std::nullopt;
  const Scene scene = parse_scene(text->second, folder, folder);
  const geometry::Network network = build_network(scene);
  if (network.segment.empty()) return std::nullopt;
  check(!scene.vessels.flexible,
        fmt::format("{}: its vessels bend, and a frame does not say where to; leave them out with "
                    "--no-vessels.",
                    folder));
  constexpr double kFineness = 0.3;  // finer than for display: a voxel may be small
  return geometry::make_vessel_mesh(network, {.fineness = kFineness}).surface;
}

}  // namespace

RunImage voxelise_run(const VoxeliseRun& o) {
  const io::RunReader run((std::filesystem::path(o.folder) / "run.vtkhdf").string());
  const int frames = run.n_frame();
  check(frames > 0, fmt::format("{}: the run has no frame yet.", o.folder));
  check(o.frame < frames,
        fmt::format("{}: --frame {}: the run has {}, numbered from 0.", o.folder, o.frame, frames));
  RunImage out;
  out.frame = o.frame < 0 ? frames - 1 : o.frame;
  imaging::CellSurfaces cells = imaging::frame_surfaces(run.frame(out.frame));
  check(!cells.empty(), fmt::format("{}: frame {} has no cells.", o.folder, out.frame));
  std::optional<geometry::Surface> vessels;
  if (o.vessels) vessels = vessels_of(run, o.folder);
  out.cells = imaging::voxelise_cells(std::move(cells), std::move(vessels), o.how);
  return out;
}

}  // namespace acinus::runs
