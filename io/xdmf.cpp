#include "io/xdmf.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/disk.hpp"

namespace acinus::io {
namespace {

/// Contiguous rows of a dataset.
struct Slab {
  std::string dataset;
  const char* number;  ///< XDMF number type and precision
  std::int64_t first, n;
  int components = 1;
};

void add_slab(std::string* out, const std::string& file, const Slab& slab) {
  const std::int64_t n_row = slab.first + slab.n;
  if (slab.components == 1) {
    fmt::format_to(
        std::back_inserter(*out),
        R"(<DataItem ItemType="HyperSlab" Dimensions="{0}" Type="HyperSlab">)"
        R"(<DataItem Dimensions="3 1" Format="XML">{1} 1 {0}</DataItem>)"
        R"(<DataItem {2} Dimensions="{3}" Format="HDF">{4}:/VTKHDF/{5}</DataItem></DataItem>)",
        slab.n, slab.first, slab.number, n_row, file, slab.dataset);
  } else {
    fmt::format_to(
        std::back_inserter(*out),
        R"(<DataItem ItemType="HyperSlab" Dimensions="{0} {6}" Type="HyperSlab">)"
        R"(<DataItem Dimensions="3 2" Format="XML">{1} 0 1 1 {0} {6}</DataItem>)"
        R"(<DataItem {2} Dimensions="{3} {6}" Format="HDF">{4}:/VTKHDF/{5}</DataItem></DataItem>)",
        slab.n, slab.first, slab.number, n_row, file, slab.dataset, slab.components);
  }
}

constexpr char kFloat[] = R"(NumberType="Float" Precision="4")";
constexpr char kInt[] = R"(NumberType="Int" Precision="8")";
constexpr char kByte[] = R"(NumberType="UChar" Precision="1")";

void add_attribute(std::string* out, const std::string& file, const char* center, const Slab& slab,
                   const std::string& name) {
  const char* type = slab.components == 1 ? "Scalar" : slab.components == 3 ? "Vector" : "Matrix";
  fmt::format_to(std::back_inserter(*out),
                 R"(<Attribute Name="{}" AttributeType="{}" Center="{}">)", name, type, center);
  add_slab(out, file, slab);
  *out += "</Attribute>\n";
}

/// Grid of one kind: cells first_cell .. first_cell + n_cell of the frame.
struct XdmfGrid {
  const char* name;
  const char* topology;
  std::int64_t first_cell, n_cell, first_id, n_id;
};

void add_grid(std::string* out, const std::string& file, const FrameIndex& f,
              const RunLayout& layout, const XdmfGrid& grid) {
  if (grid.n_cell == 0) return;
  const auto to = std::back_inserter(*out);
  fmt::format_to(
      to,
      R"(<Grid Name="{}" GridType="Uniform"><Topology TopologyType="{}" NumberOfElements="{}"{}>)",
      grid.name, grid.topology, grid.n_cell,
      grid.n_id == grid.n_cell ? R"( NodesPerElement="1")" : "");
  add_slab(out, file, {"Connectivity", kInt, f.connectivity_offset + grid.first_id, grid.n_id});
  *out += "</Topology>\n<Geometry GeometryType=\"XYZ\">";
  add_slab(out, file, {"Points", kFloat, f.point_offset, f.n_point, 3});
  *out += "</Geometry>\n";
  for (const auto& field : layout.point_data) {
    add_attribute(out, file, "Node",
                  {"PointData/" + field.name, kFloat, f.point_data_offset.at(field.name), f.n_point,
                   field.components},
                  field.name);
  }
  const auto add_cells = [&](const std::string& name, const char* number, int components) {
    add_attribute(out, file, "Cell",
                  {"CellData/" + name, number, f.cell_data_offset.at(name) + grid.first_cell,
                   grid.n_cell, components},
                  name);
  };
  add_cells("cell_id", kInt, 1);
  add_cells("kind", kByte, 1);
  for (const auto& field : layout.cell_data) add_cells(field.name, kFloat, field.components);
  *out += "</Grid>\n";
}

}  // namespace

void write_xdmf(const std::string& path, const std::string& hdf5, std::span<const FrameIndex> frame,
                const RunLayout& layout) {
  const std::string file = std::filesystem::path(hdf5).filename().string();
  std::string out =
      "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf "
      "Version=\"2.0\">\n<Domain>\n"
      "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const FrameIndex& f : frame) {
    fmt::format_to(std::back_inserter(out),
                   "<Grid Name=\"frame\" GridType=\"Collection\" CollectionType=\"Spatial\"><Time "
                   "Value=\"{}\"/>\n",
                   f.time_s);
    const std::int64_t n_triangle = f.n_triangle();
    add_grid(&out, file, f, layout, {"triangles", "Triangle", 0, n_triangle, 0, 3 * n_triangle});
    add_grid(&out, file, f, layout,
             {"spheres", "Polyvertex", n_triangle, f.n_sphere(), 3 * n_triangle, f.n_sphere()});
    out += "</Grid>\n";
  }
  out += "</Grid>\n</Domain>\n</Xdmf>\n";
  write_text_file(path, out);
}

}  // namespace acinus::io
