#pragma once
/// Frames of a run, packed for the 3D viewer of the report page.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "service/report/packed_fields.hpp"
#include "service/report/run_record.hpp"

namespace acinus::service {

/// Limits of the packed frames of a run.
struct FrameLimits {
  int most_frames = 50;
  std::size_t bytes = 8'000'000;  ///< of all chunks, encoded as in the page
};

/// Deforming surfaces of cells; shared by frames with the same triangles and owners.
struct PackedMesh {
  std::size_t nodes = 0, triangles = 0;
  std::string chunk;  ///< corners [n_triangle][3], cell ids and kinds of the nodes
};

/// Surfaces at rest: vessels, pipettes, static meshes.
struct PackedStill {
  std::size_t nodes = 0, triangles = 0;
  std::string chunk;  ///< quantised x, y, z of the nodes; corners
};

/// Packed positions and cell table of one frame.
struct PackedFrame {
  double time_s = 0;
  int number = 0;                   ///< in the run file
  std::size_t mesh = 0, still = 0;  ///< indices into PackedRun
  std::size_t spheres = 0, cells = 0;
  std::string chunk;   ///< quantised x, y, z of nodes and spheres, radii; sphere ids; cell table
  std::string fields;  ///< of substances (pack_fields); "": none
};

/// Contacts between deformable cells and spheres in one frame.
struct InterfaceSample {
  double time_s = 0, mean_force = 0, largest_force = 0, deepest = 0;  ///< s, nN, nN, um
  int pairs = 0;  ///< pairs with a contact force
};

/// Packed frames of a run.
struct PackedRun {
  std::vector<PackedMesh> mesh;
  std::vector<PackedStill> still;
  std::vector<PackedFrame> frame;
  std::vector<InterfaceSample> interface;
  std::vector<std::string> id_column, column;  ///< columns of the cell table in the frames' chunks
  std::map<std::string, std::string> unit;     ///< by column
  PackedGrid grid;                             ///< of the fields of substances
  std::size_t bytes() const;
};

/// Packs evenly spaced frames including the first and the last, as many as the limits allow, at
/// least the last. Unreadable frames are left out and reported in run.damage.
PackedRun pack_frames(RunRecord& run, const FrameLimits& limits);

/// Packs a single frame.
PackedRun pack_frame(const io::Frame& frame);

}  // namespace acinus::service
