#include "service/report/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "service/report/pack.hpp"
#include "service/report/thin.hpp"

namespace acinus::service {
namespace {

/// Part of a frame's surfaces with its own nodes.
struct Surfaces {
  std::vector<double> x, y, z;
  std::vector<std::int64_t> corner, cell, kind;
};

/// Extracts the boundary triangles of a frame, or all others.
/// @param boundary  extract the boundary
Surfaces take_surfaces(const io::Frame& f, bool boundary) {
  Surfaces s;
  std::vector<std::int64_t> place(f.n_mesh_node, -1);
  for (std::size_t t = 0; t < f.triangle.size(); ++t) {
    if ((f.kind[t] == io::kBoundary) != boundary) continue;
    for (const std::int64_t node : f.triangle[t]) {
      std::int64_t& at = place[node];
      if (at < 0) {
        at = static_cast<std::int64_t>(s.x.size());
        s.x.push_back(f.point[3 * node]);
        s.y.push_back(f.point[3 * node + 1]);
        s.z.push_back(f.point[3 * node + 2]);
        s.cell.push_back(f.cell_id[t]);
        s.kind.push_back(f.kind[t]);
      }
      s.corner.push_back(at);
    }
  }
  return s;
}

/// Index of the item with the same chunk in a list; adds the item if there is none.
template <class Item>
std::size_t place_of(std::vector<Item>& list, Item item) {
  const auto at = std::ranges::find(list, item.chunk, &Item::chunk);
  const std::size_t place = at - list.begin();
  if (at == list.end()) list.push_back(std::move(item));
  return place;
}

std::vector<double> radii_of(const io::Frame& f) {
  for (const io::Field& field : f.cell_data)
    if (field.name == "radius") return {field.value.end() - f.n_sphere, field.value.end()};
  return std::vector<double>(f.n_sphere, 0);
}

std::string pack_moving(const io::Frame& f, const Surfaces& cells) {
  std::string bytes;
  for (const auto* part : {&cells.x, &cells.y, &cells.z}) append_quantised(bytes, *part);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> part;
    for (std::int64_t k = 0; k < f.n_sphere; ++k)
      part.push_back(f.point[3 * (f.n_mesh_node + k) + axis]);
    append_quantised(bytes, part);
  }
  append_quantised(bytes, radii_of(f));
  append_integers(bytes, std::span(f.cell_id).subspan(f.triangle.size()));
  for (const io::IdColumn& c : f.cells.ids) append_integers(bytes, c.value);
  for (const io::Column& c : f.cells.columns)
    if (c.components == 1) append_quantised(bytes, c.value);
  return encode_chunk(bytes);
}

InterfaceSample sample_interface(const io::Frame& f) {
  InterfaceSample s{.time_s = f.time_s};
  const std::vector<double> force = table_column(f.interface, "force");
  const std::vector<double> gap = table_column(f.interface, "gap");
  if (force.size() != 3 * gap.size()) return s;
  for (std::size_t k = 0; k < gap.size(); ++k) {
    const double size = std::hypot(force[3 * k], force[3 * k + 1], force[3 * k + 2]);
    if (!(size > 0)) continue;
    ++s.pairs;
    s.mean_force += size;
    s.largest_force = std::max(s.largest_force, size);
    s.deepest = std::max(s.deepest, -gap[k]);
  }
  if (s.pairs > 0) s.mean_force /= s.pairs;
  return s;
}

void add_frame(PackedRun& out, const io::Frame& f, int number) {
  const Surfaces cells = take_surfaces(f, false), still = take_surfaces(f, true);
  std::string mesh, walls;
  for (const auto* part : {&cells.corner, &cells.cell, &cells.kind}) append_integers(mesh, *part);
  for (const auto* part : {&still.x, &still.y, &still.z}) append_quantised(walls, *part);
  append_integers(walls, still.corner);
  PackedFrame p;
  p.time_s = f.time_s;
  p.number = number;
  p.mesh = place_of(out.mesh, {cells.x.size(), cells.corner.size() / 3, encode_chunk(mesh)});
  p.still = place_of(out.still, {still.x.size(), still.corner.size() / 3, encode_chunk(walls)});
  p.spheres = f.n_sphere;
  p.cells = f.cells.ids.empty() ? 0 : f.cells.ids[0].value.size();
  p.chunk = pack_moving(f, cells);
  out.frame.push_back(std::move(p));
  if (!f.interface.ids.empty()) out.interface.push_back(sample_interface(f));
  if (!out.id_column.empty() || !out.column.empty()) return;
  for (const io::IdColumn& c : f.cells.ids) out.id_column.push_back(c.name);
  for (const io::Column& c : f.cells.columns) {
    if (c.components != 1) continue;
    out.column.push_back(c.name);
    out.unit[c.name] = c.unit;
  }
}

/// Share of the bytes of a page that fields may take, and bytes that one of their values takes at
/// most: the byte itself in base64.
constexpr double kShareOfFields = 0.25, kBytesPerValue = 4.0 / 3;

/// Fields of the last frame of the run, up to which a box may have grown; empty if unreadable.
std::optional<io::FieldFrame> last_fields(const RunRecord& run) {
  try {
    return io::read_fields(run.folder, static_cast<std::size_t>(run.n_frame() - 1));
  } catch (const Error&) {
    return {};
  }
}

/// Adds the fields of substances to the last packed frame.
void add_fields(PackedRun& out, RunRecord& run, const FrameLimits& limits, int n_frame) {
  PackedFrame& frame = out.frame.back();
  const std::optional<io::FieldFrame> fields = read_fields(run, frame.number, frame.time_s);
  if (!fields) return;
  if (!out.grid.exists()) {
    const double most =
        kShareOfFields * static_cast<double>(limits.bytes) / (kBytesPerValue * n_frame);
    out.grid = make_packed_grid(last_fields(run).value_or(*fields), static_cast<std::size_t>(most));
  }
  if (out.grid.exists())
    attempt(run, fmt::format("fields of frame {}", frame.number),
            [&] { frame.fields = pack_fields(out.grid, *fields); });
}

}  // namespace

std::size_t PackedRun::bytes() const {
  std::size_t sum = 0;
  for (const PackedMesh& m : mesh) sum += m.chunk.size();
  for (const PackedStill& s : still) sum += s.chunk.size();
  for (const PackedFrame& f : frame) sum += f.chunk.size() + f.fields.size();
  return sum;
}

PackedRun pack_frame(const io::Frame& frame) {
  PackedRun packed;
  add_frame(packed, frame, 0);
  return packed;
}

PackedRun pack_frames(RunRecord& run, const FrameLimits& limits) {
  int n = std::min(limits.most_frames, run.n_frame());
  while (n > 0) {
    PackedRun packed;
    for (const int number : choose_evenly(run.n_frame(), n)) {
      if (const std::optional<io::Frame> f = read_frame(run, number)) {
        add_frame(packed, *f, number);
        add_fields(packed, run, limits, n);
      }
      if (n > 1 && packed.bytes() > limits.bytes) break;
    }
    const std::size_t bytes = packed.bytes();
    if (n == 1 || bytes <= limits.bytes) return packed;
    // What the frames so far took says how many fit.
    const double share = static_cast<double>(limits.bytes) / static_cast<double>(bytes);
    const auto fit = static_cast<int>(share * static_cast<double>(packed.frame.size()));
    n = std::clamp(fit, 1, n - 1);
  }
  return {};
}

}  // namespace acinus::service
