#include "io/surface_file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "io/disk.hpp"

namespace acinus::io {
namespace {

static_assert(std::endian::native == std::endian::little);  // both binary formats are

template <class T>
void append_bytes(std::string& text, const T& value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  text.append(bytes.data(), bytes.size());
}

/// Encoder of appended data: numbers after their size.
class VtpData {
 public:
  template <class T>
  void start(std::size_t n) {
    append_bytes(bytes_, static_cast<std::uint64_t>(n * sizeof(T)));
  }
  template <class T>
  void add(T value) {
    append_bytes(bytes_, value);
  }
  std::size_t size() const { return bytes_.size(); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string vtp_text(const geometry::Surface& s) {
  constexpr int kCorners = 3;
  VtpData data;
  data.start<double>(3 * s.node.size());
  for (const Vec3& x : s.node)
    for (int k = 0; k < 3; ++k) data.add(x[k]);
  const std::size_t connectivity = data.size();
  data.start<std::int32_t>(3 * s.triangle.size());
  for (const auto& corner : s.triangle)
    for (const int k : corner) data.add(static_cast<std::int32_t>(k));
  const std::size_t offsets = data.size();
  data.start<std::int32_t>(s.triangle.size());
  for (std::size_t t = 0; t < s.triangle.size(); ++t)
    data.add(static_cast<std::int32_t>(kCorners * (t + 1)));
  return fmt::format(
             R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData>
<Piece NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}">
<Points>
<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="0"/>
</Points>
<Polys>
<DataArray type="Int32" Name="connectivity" format="appended" offset="{}"/>
<DataArray type="Int32" Name="offsets" format="appended" offset="{}"/>
</Polys>
</Piece>
</PolyData>
<AppendedData encoding="raw">
_)",
             s.node.size(), s.triangle.size(), connectivity, offsets) +
         data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

/// Number in the byte order of legacy VTK (big-endian).
template <class T>
void append_swapped(std::string& text, const T& value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  text.append(bytes.rbegin(), bytes.rend());
}

std::string vtk_text(std::span<const geometry::Surface> surfaces,
                     std::span<const std::uint32_t> label) {
  constexpr std::int32_t kCorners = 3;
  std::size_t nodes = 0, triangles = 0;
  for (const geometry::Surface& s : surfaces) {
    nodes += s.node.size();
    triangles += s.triangle.size();
  }
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\nsurfaces, um\nBINARY\nDATASET POLYDATA\nPOINTS {} double\n",
      nodes);
  for (const geometry::Surface& s : surfaces)
    for (const Vec3& x : s.node)
      for (int k = 0; k < 3; ++k) append_swapped(text, x[k]);
  text += fmt::format("\nPOLYGONS {} {}\n", triangles, (1 + kCorners) * triangles);
  std::int32_t first = 0;
  for (const geometry::Surface& s : surfaces) {
    for (const auto& corner : s.triangle) {
      append_swapped(text, kCorners);
      for (const int k : corner) append_swapped(text, first + static_cast<std::int32_t>(k));
    }
    first += static_cast<std::int32_t>(s.node.size());
  }
  if (label.empty()) return text + "\n";
  text += fmt::format("\nCELL_DATA {}\nSCALARS label int 1\nLOOKUP_TABLE default\n", triangles);
  for (std::size_t b = 0; b < surfaces.size(); ++b)
    for (std::size_t t = 0; t < surfaces[b].triangle.size(); ++t)
      append_swapped(text, static_cast<std::int32_t>(label[b]));
  return text + "\n";
}

std::string stl_text(const geometry::Surface& s) {
  constexpr std::size_t kHeader = 80;
  std::string text = "binary STL, um";
  text.resize(kHeader, ' ');
  append_bytes(text, static_cast<std::uint32_t>(s.triangle.size()));
  for (const auto& [a, b, c] : s.triangle) {
    const Vec3 n = (s.node[b] - s.node[a]).cross(s.node[c] - s.node[a]).normalized();
    for (const Vec3& x : {n, s.node[a], s.node[b], s.node[c]})
      for (int k = 0; k < 3; ++k) append_bytes(text, static_cast<float>(x[k]));
    append_bytes(text, std::uint16_t{0});
  }
  return text;
}

std::string obj_text(const geometry::Surface& s) {
  std::string text = "# um\n";
  for (const Vec3& x : s.node) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
  for (const auto& [a, b, c] : s.triangle) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

}  // namespace

void check_surface_file(const std::string& path) {
  const std::string ending = geometry::extension_of(path);
  check(ending == ".vtk" || ending == ".vtp" || ending == ".stl" || ending == ".obj",
        fmt::format("{}: surfaces are written as .vtk, .vtp, .stl or .obj, not {}. Choose one of "
                    "these endings.",
                    path, geometry::in_quotes(ending)));
}

void write_surface(const std::string& path, const geometry::Surface& surface) {
  check_surface_file(path);
  const std::string ending = geometry::extension_of(path);
  write_text_file(path, ending == ".vtk"   ? vtk_text({&surface, 1}, {})
                        : ending == ".vtp" ? vtp_text(surface)
                        : ending == ".stl" ? stl_text(surface)
                                           : obj_text(surface));
}

void write_surfaces(const std::string& path, std::span<const geometry::Surface> surfaces,
                    std::span<const std::uint32_t> label) {
  write_text_file(path, vtk_text(surfaces, label));
}

}  // namespace acinus::io
