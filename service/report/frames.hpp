#pragma once
/// Frames of a run for the page's viewer.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "service/report/run_record.hpp"

namespace acinus::runs {

struct FrameLimits {
  int most_frames = 50;
  std::size_t bytes = 8'000'000;  ///< of all chunks, as written in the page
};

/// Surfaces whose triangles and owners stay the same over some frames.
struct PackedMesh {
  std::size_t nodes = 0, triangles = 0;
  std::string chunk;  ///< corners [triangles * 3], ids of the nodes' cells, kinds of the nodes
};

/// Surfaces that do not move: vessels, pipettes, rigid meshes.
struct PackedStill {
  std::size_t nodes = 0, triangles = 0;
  std::string chunk;  ///< x, y, z of the nodes quantised; corners
};

struct PackedFrame {
  double time_s = 0;
  int number = 0;                   ///< in the run file
  std::size_t mesh = 0, still = 0;  ///< places in PackedRun
  std::size_t spheres = 0, cells = 0;
  std::string chunk;  ///< x, y, z of nodes, of spheres, radii quantised; ids of spheres; the table
};

/// Interface of deformable cells and spheres in one frame.
struct InterfaceSample {
  double time_s = 0, mean_force = 0, largest_force = 0, deepest = 0;  ///< nN, um
  int pairs = 0;                                                      ///< with a force
};

struct PackedRun {
  std::vector<PackedMesh> mesh;
  std::vector<PackedStill> still;
  std::vector<PackedFrame> frame;
  std::vector<InterfaceSample> interface;
  std::vector<std::string> id_column, column;  ///< of the table in each frame's chunk
  std::map<std::string, std::string> unit;     ///< of columns
  std::size_t bytes() const;
};

/// Evenly spaced frames, the first and the last among them, as many as the limits allow, but at
/// least the last. What cannot be read is left out and told in run.damage.
PackedRun pack_frames(RunRecord& run, const FrameLimits& limits);

}  // namespace acinus::runs
