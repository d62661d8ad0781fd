/// Reads run files with the plain C library: the layout is a contract with VTK's readers.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/run_file.hpp"
#include "tests/io/sample.hpp"

namespace acinus::io {
namespace {

constexpr hsize_t kChunk = 16384;

struct Dataset {
  std::string type;  ///< f4 f8 i8 u1 text
  std::vector<hsize_t> shape, chunk;
  int n_filter = 0;
  std::string unit;
};

std::string type_of(hid_t type) {
  if (H5Tget_class(type) == H5T_STRING)
    return H5Tis_variable_str(type) > 0 ? "variable text" : "text";
  if (H5Tequal(type, H5T_IEEE_F32LE) > 0) return "f4";
  if (H5Tequal(type, H5T_IEEE_F64LE) > 0) return "f8";
  if (H5Tequal(type, H5T_STD_I64LE) > 0) return "i8";
  if (H5Tequal(type, H5T_STD_U8LE) > 0) return "u1";
  return "other";
}

Dataset describe(hid_t object) {
  Dataset d;
  const hid_t type = H5Dget_type(object), space = H5Dget_space(object),
              list = H5Dget_create_plist(object);
  d.type = type_of(type);
  d.shape.resize(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, d.shape.data(), nullptr);
  if (H5Pget_layout(list) == H5D_CHUNKED) {
    d.chunk.resize(d.shape.size());
    H5Pget_chunk(list, static_cast<int>(d.chunk.size()), d.chunk.data());
  }
  d.n_filter = H5Pget_nfilters(list);
  if (H5Aexists(object, "unit") > 0) {
    const hid_t attribute = H5Aopen(object, "unit", H5P_DEFAULT), text = H5Aget_type(attribute);
    EXPECT_EQ(type_of(text), "text");
    EXPECT_EQ(H5Tget_cset(text), H5T_CSET_ASCII);
    std::string unit(H5Tget_size(text), '\0');
    H5Aread(attribute, text, unit.data());
    d.unit = unit.c_str();
    H5Tclose(text);
    H5Aclose(attribute);
  }
  H5Pclose(list);
  H5Sclose(space);
  H5Tclose(type);
  return d;
}

herr_t visit(hid_t file, const char* name, const H5O_info_t* info, void* data) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t object = H5Dopen2(file, name, H5P_DEFAULT);
  (*static_cast<std::map<std::string, Dataset>*>(data))[name] = describe(object);
  H5Dclose(object);
  return 0;
}

struct Open {
  explicit Open(const std::string& path) : id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~Open() { H5Fclose(id); }
  std::vector<std::int64_t> read(const std::string& name) const {
    const hid_t set = H5Dopen2(id, name.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<std::int64_t> value(H5Sget_simple_extent_npoints(space));
    EXPECT_GE(H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), 0)
        << name;
    H5Sclose(space);
    H5Dclose(set);
    return value;
  }
  std::vector<std::int64_t> attribute(const char* object, const char* name) const {
    const hid_t a = H5Aopen_by_name(id, object, name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(a), space = H5Aget_space(a);
    EXPECT_EQ(type_of(type), "i8") << object << "@" << name;
    std::vector<std::int64_t> value(H5Sget_simple_extent_npoints(space));
    H5Aread(a, H5T_NATIVE_INT64, value.data());
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(a);
    return value;
  }
  hid_t id;
};

void write_run(const std::string& path, int n, bool compress) {
  RunFile run =
      RunFile::create(path, {{"seed", "1"}, {"command", "acinus run x.json"}}, {compress, 64});
  for (int k = 0; k < n; ++k) {
    const std::vector<SeriesValue> sample{{"time", "s", 1.0 * k}, {"energy", "fJ", 2.0 * k}};
    run.append_series(sample);
    run.append_event({1.0 * k, "step_rejected", {k}, "why"});
    run.append(test::changing_frame(k), {sample.data(), 1});
  }
}

TEST(RunFileLayout, EveryDatasetHasItsTypeShapeAndUnit) {
  const test::Folder folder("layout_types");
  write_run(folder / "run.vtkhdf", 9, true);
  const Open file(folder / "run.vtkhdf");
  std::map<std::string, Dataset> set;
  ASSERT_GE(H5Ovisit(file.id, H5_INDEX_NAME, H5_ITER_INC, visit, &set), 0);
  for (const auto& [name, d] : set) EXPECT_FALSE(d.unit.empty()) << name << " has no unit";
  struct Row {
    const char *name, *type, *unit;
    hsize_t columns;  ///< 0 = one-dimensional, 9 = scalar
    int n_filter;
  };
  const Row expected[] = {
      {"VTKHDF/Points", "f4", "um", 3, 3},
      {"VTKHDF/Connectivity", "i8", "1", 0, 3},
      {"VTKHDF/Offsets", "i8", "1", 0, 3},
      {"VTKHDF/Types", "u1", "1", 0, 0},
      {"VTKHDF/NumberOfPoints", "i8", "1", 0, 0},
      {"VTKHDF/NumberOfCells", "i8", "1", 0, 0},
      {"VTKHDF/NumberOfConnectivityIds", "i8", "1", 0, 0},
      {"VTKHDF/PointData/force", "f4", "nN", 3, 3},
      {"VTKHDF/CellData/cell_id", "i8", "1", 0, 3},
      {"VTKHDF/CellData/kind", "u1", "1", 0, 3},
      {"VTKHDF/CellData/radius", "f4", "um", 0, 3},
      {"VTKHDF/CellData/pressure", "f4", "kPa", 0, 3},
      {"VTKHDF/Steps/Values", "f8", "s", 0, 0},
      {"VTKHDF/Steps/PartOffsets", "i8", "1", 0, 0},
      {"VTKHDF/Steps/NumberOfParts", "i8", "1", 0, 0},
      {"VTKHDF/Steps/PointOffsets", "i8", "1", 0, 0},
      {"VTKHDF/Steps/CellOffsets", "i8", "1", 1, 0},
      {"VTKHDF/Steps/ConnectivityIdOffsets", "i8", "1", 1, 0},
      {"VTKHDF/Steps/PointDataOffsets/force", "i8", "1", 0, 0},
      {"VTKHDF/Steps/CellDataOffsets/cell_id", "i8", "1", 0, 0},
      {"VTKHDF/Steps/CellDataOffsets/kind", "i8", "1", 0, 0},
      {"VTKHDF/Steps/CellDataOffsets/radius", "i8", "1", 0, 0},
      {"VTKHDF/Steps/CellDataOffsets/pressure", "i8", "1", 0, 0},
      {"cells/frame_offset", "i8", "1", 0, 0},
      {"cells/id", "i8", "1", 0, 0},
      {"cells/volume", "f8", "um^3", 0, 0},
      {"cells/stress", "f8", "kPa", 6, 0},
      {"interface/frame_offset", "i8", "1", 0, 0},
      {"interface/dcm_id", "i8", "1", 0, 0},
      {"interface/cbm_id", "i8", "1", 0, 0},
      {"interface/gap", "f8", "um", 0, 0},
      {"contacts/frame_offset", "i8", "1", 0, 0},
      {"contacts/a", "i8", "1", 0, 0},
      {"contacts/b", "i8", "1", 0, 0},
      {"contacts/area_a", "f8", "um^2", 0, 0},
      {"contacts/force", "f8", "nN", 3, 0},
      {"series/time", "f8", "s", 0, 0},
      {"series/energy", "f8", "fJ", 0, 0},
      {"observables/time", "f8", "s", 0, 0},
      {"events/time", "f8", "s", 0, 0},
      {"events/code", "text", "text", 0, 0},
      {"events/message", "text", "text", 0, 0},
      {"events/cell_id", "i8", "1", 0, 0},
      {"events/cell_offset", "i8", "1", 0, 0},
      {"provenance/seed", "text", "text", 9, 0},
      {"provenance/command", "text", "text", 9, 0},
  };
  std::set<std::string> seen;
  for (const Row& row : expected) {
    seen.insert(row.name);
    ASSERT_EQ(set.count(row.name), 1U) << row.name;
    const Dataset& d = set[row.name];
    EXPECT_EQ(d.type, row.type) << row.name;
    EXPECT_EQ(d.unit, row.unit) << row.name;
    EXPECT_EQ(d.n_filter, row.n_filter) << row.name;
    if (row.n_filter > 0) {
      EXPECT_EQ(d.chunk[0], kChunk) << row.name;
    }
    ASSERT_EQ(d.shape.size(), row.columns == 9 ? 0U : row.columns == 0 ? 1U : 2U) << row.name;
    if (d.shape.size() == 2) {
      EXPECT_EQ(d.shape[1], row.columns) << row.name;
    }
  }
  for (const auto& [name, d] : set)
    EXPECT_EQ(seen.count(name), 1U) << name << " is not part of the layout";
}

TEST(RunFileLayout, HeadersAreWhatVtkCompares) {
  const test::Folder folder("layout_headers");
  write_run(folder / "run.vtkhdf", 3, true);
  const Open file(folder / "run.vtkhdf");
  EXPECT_EQ(file.attribute("/VTKHDF", "Version"), (std::vector<std::int64_t>{2, 0}));
  EXPECT_EQ(file.attribute("/VTKHDF/Steps", "NSteps"), std::vector<std::int64_t>{3});
  EXPECT_EQ(file.attribute("/", "schema_version"), (std::vector<std::int64_t>{1, 2}));
  const hid_t a = H5Aopen_by_name(file.id, "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT),
              type = H5Aget_type(a);
  EXPECT_EQ(H5Tis_variable_str(type), 0);
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII);
  ASSERT_EQ(H5Tget_size(type), 16U);
  std::string text(16, '\0');
  H5Aread(a, type, text.data());
  EXPECT_EQ(text, "UnstructuredGrid");
  H5Tclose(type);
  H5Aclose(a);
  const hid_t create = H5Fget_create_plist(file.id);
  unsigned super = 9;
  H5Pget_version(create, &super, nullptr, nullptr, nullptr);
  EXPECT_EQ(super, 0U) << "a newer superblock keeps an open-for-write mark after a kill";
  H5Pclose(create);
}

TEST(RunFileLayout, CompressedFramesStartOnChunks) {
  const test::Folder folder("layout_chunks");
  constexpr int kFrame = 17;
  write_run(folder / "run.vtkhdf", kFrame, true);
  const Open file(folder / "run.vtkhdf");
  const auto read = [&](const std::string& name) { return file.read("/VTKHDF/Steps/" + name); };
  const auto part = read("PartOffsets"), cell = read("CellOffsets");
  for (const char* name :
       {"PointOffsets", "ConnectivityIdOffsets", "PointDataOffsets/force", "CellDataOffsets/kind",
        "CellDataOffsets/cell_id", "CellDataOffsets/radius", "CellDataOffsets/pressure"}) {
    const auto offset = read(name);
    ASSERT_EQ(offset.size(), std::size_t{kFrame}) << name;
    for (std::size_t k = 0; k < kFrame; ++k) {
      EXPECT_EQ(offset[k] % static_cast<std::int64_t>(kChunk), 0) << name;
      if (k > 0) {
        EXPECT_GE(offset[k], offset[k - 1]) << name;
      }
    }
  }
  const auto n_point = file.read("/VTKHDF/NumberOfPoints"),
             n_cell = file.read("/VTKHDF/NumberOfCells");
  const auto n_id = file.read("/VTKHDF/NumberOfConnectivityIds"),
             offsets = file.read("/VTKHDF/Offsets");
  const auto types = file.read("/VTKHDF/Types"), ids = file.read("/VTKHDF/Connectivity");
  const auto id_offset = read("ConnectivityIdOffsets");
  EXPECT_EQ(part[1], part[0]) << "frames 0 and 1 have the same topology";
  for (std::size_t k = 0; k < kFrame; ++k) {
    // What a VTKHDF reader does: index = offset of the step, sizes of the part.
    EXPECT_EQ((cell[k] + part[k]) % static_cast<std::int64_t>(kChunk), 0);
    const std::size_t p = part[k];
    const Frame frame = test::changing_frame(static_cast<int>(k));
    EXPECT_EQ(n_point[p], frame.n_mesh_node + frame.n_sphere);
    EXPECT_EQ(n_cell[p], std::ssize(frame.triangle) + frame.n_sphere);
    const std::size_t start = cell[k] + part[k];
    EXPECT_EQ(offsets[start], 0);
    EXPECT_EQ(offsets[start + static_cast<std::size_t>(n_cell[p])], n_id[p]);
    for (std::int64_t c = 0; c < n_cell[p]; ++c) {
      const bool triangle = c < std::ssize(frame.triangle);
      const std::size_t at = c;
      ASSERT_EQ(types[cell[k] + c], triangle ? 5 : 1);
      const auto first = offsets[start + at];
      ASSERT_EQ(offsets[start + at + 1] - first, triangle ? 3 : 1);
      ASSERT_EQ(
          ids[id_offset[k] + first],
          triangle ? frame.triangle[at][0] : frame.n_mesh_node + c - std::ssize(frame.triangle));
    }
  }
}

TEST(RunFileLayout, UncompressedFramesHaveNoPadding) {
  const test::Folder folder("layout_plain");
  write_run(folder / "run.vtkhdf", 9, false);
  const Open file(folder / "run.vtkhdf");
  std::map<std::string, Dataset> set;
  H5Ovisit(file.id, H5_INDEX_NAME, H5_ITER_INC, visit, &set);
  hsize_t n_point = 0;
  for (int k = 0; k < 9; ++k) n_point += test::changing_frame(k).point.size() / 3;
  EXPECT_EQ(set["VTKHDF/Points"].shape[0], n_point);
  for (const auto& [name, d] : set) EXPECT_EQ(d.n_filter, 0) << name;
}

}  // namespace
}  // namespace acinus::io
