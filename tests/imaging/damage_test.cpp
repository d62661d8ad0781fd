/// Files cut short and files with a bit changed, of every format that is read: each is refused, or
/// read with the sizes that the whole file states. Labels, coordinates and radii may differ
/// where nothing in the format can tell. With ACINUS_DAMAGE=all thousands are tried.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "geometry/readers/read_network.hpp"
#include "geometry/readers/read_surface.hpp"
#include "geometry/topology.hpp"
#include "imaging/inflate.hpp"
#include "imaging/read_image.hpp"
#include "imaging/write_image.hpp"
#include "io/surface_file.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/hdf5_dataset.hpp"
#include "tests/imaging/images.hpp"
#include "tests/imaging/tiff_bytes.hpp"

namespace acinus {
namespace {

using geometry::Surface;
using geometry::TempFolder;
using imaging::LabelImage;

/// Sizes and counts of a file that was read, and all its numbers.
struct Content {
  std::string structure, data;
  bool told = false;  ///< with a note
};

Content image_content(const std::string& path) {
  std::vector<std::string> notes;
  const LabelImage i = imaging::read_labels(path, {}, &notes);
  std::string data = fmt::format("{} {} {}", i.voxel[0], i.voxel[1], i.voxel[2]);
  data.append(reinterpret_cast<const char*>(i.label.data()), 4 * i.label.size());
  return {fmt::format("{} x {} x {}", i.size[0], i.size[1], i.size[2]), data, !notes.empty()};
}

void add_number(double x, std::string& to) {
  to.append(reinterpret_cast<const char*>(&x), sizeof(x));
}

Content surface_content(const std::string& path) {
  Content c;
  for (const Surface& s : geometry::read_closed_surfaces(path, 1)) {
    c.structure += fmt::format("{} nodes, {} triangles; ", s.node.size(), s.triangle.size());
    for (const Vec3& x : s.node)
      for (int k = 0; k < 3; ++k) add_number(x[k], c.data);
    for (const auto& t : s.triangle)
      for (const int k : t) add_number(k, c.data);
  }
  return c;
}

Content network_content(const std::string& path) {
  const geometry::Network n = geometry::read_network(path);
  Content c{fmt::format("{} nodes, {} segments", n.node.size(), n.segment.size()), "", false};
  for (const Vec3& x : n.node)
    for (int k = 0; k < 3; ++k) add_number(x[k], c.data);
  for (const auto& [a, b] : n.segment) add_number(1e6 * a + b, c.data);
  for (const auto& [a, b] : n.radius) add_number(a + 1e3 * b, c.data);
  return c;
}

struct Format {
  std::string name, bytes;  ///< ends as its files do
  Content (*read)(const std::string&);
  bool says_counts = true;  ///< otherwise whole lines may be missing at the end
};

std::string bytes_of(const std::string& path) {
  std::stringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

std::vector<Format> images(const TempFolder& folder) {
  imaging::Label next = 0;
  const LabelImage i =
      imaging::make_image({6, 5, 7}, {1, 1, 2}, [&](const Vec3&) { return next++ / 9 * 40; });
  std::vector<Format> all;
  for (const char* name : {"written.tif", "written.mha", "written.nrrd"}) {
    imaging::write_image(folder.path() + "/" + name, i);
    all.push_back({name, bytes_of(folder.path() + "/" + name), image_content});
  }
  const std::string sizes = "DimSize = 6 5 7\nElementSpacing = 1 1 2\nDistanceUnits = um\n";
  const std::string raw = imaging::image_bytes<std::uint16_t>(i);
  all.push_back({"raw.mha",
                 "NDims = 3\nBinaryData = True\n" + sizes +
                     "ElementType = MET_USHORT\nElementDataFile = LOCAL\n" + raw,
                 image_content});
  all.push_back({"raw.nrrd",
                 "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 6 5 7\nspacings: 1 1 2\nunits: "
                 "\"um\" \"um\" \"um\"\nendian: little\nencoding: raw\n\n" +
                     raw,
                 image_content});
  all.push_back({"imagej.tif",
                 imaging::tiff(i, {.description = "ImageJ=1.53t\nimages=7\nslices=7\nunit=um\n"
                                                  "spacing=2\n",
                                   .per_unit = 1}),
                 image_content});
  all.push_back(
      {"ome.tif",
       imaging::tiff(i,
                     {.description = "<OME><Image><Pixels DimensionOrder=\"XYZCT\" Type=\"uint16\" "
                                     "SizeX=\"6\" SizeY=\"5\" SizeZ=\"7\" SizeC=\"1\" SizeT=\"1\" "
                                     "PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" PhysicalSizeZ=\"2\">"
                                     "<TiffData/></Pixels></Image></OME>"}),
       image_content});
  all.push_back({"plain.tif", imaging::tiff(i), [](const std::string& path) {
                   const LabelImage found = imaging::read_labels(path, {.voxel = Vec3(1, 1, 2)});
                   Content c{
                       fmt::format("{} x {} x {}", found.size[0], found.size[1], found.size[2]), "",
                       false};
                   for (const imaging::Label l : found.label) add_number(l, c.data);
                   return c;
                 }});
  all.push_back({"plain.nii", imaging::nifti(i, 3), image_content});
  all.push_back(
      {"packed.nii.gz", imaging::deflate_bytes(imaging::nifti(i, 3), true), image_content});
  imaging::Hdf5Dataset d{{7, 5, 6}, i.label, "", {"z", "y", "x"}, {2, 1, 1}};
  imaging::write_dataset(folder.path() + "/flat.h5", d);
  all.push_back({"flat.h5", bytes_of(folder.path() + "/flat.h5"), image_content});
  d.chunk = {3, 5, 6};
  imaging::write_dataset(folder.path() + "/chunks.h5", d);
  all.push_back({"chunks.h5", bytes_of(folder.path() + "/chunks.h5"), image_content});
  return all;
}

/// Two balls, of which the second is larger.
std::vector<Surface> balls() {
  std::vector<Surface> all;
  for (const double x : {0.0, 30.0}) {
    const geometry::Topology& t = geometry::shared_icosphere(12);
    Surface s;
    for (const Vec3& n : t.rest) s.node.push_back((5 + x / 10) * n + Vec3(x, 0, 0));
    s.triangle = t.triangle;
    all.push_back(std::move(s));
  }
  return all;
}

std::string ply(const std::vector<Surface>& all) {
  std::string nodes, faces;
  std::size_t first = 0, n = 0;
  for (const Surface& s : all) {
    for (const Vec3& x : s.node) nodes += fmt::format("{:.6f} {:.6f} {:.6f}\n", x[0], x[1], x[2]);
    for (const auto& t : s.triangle)
      faces += fmt::format("3 {} {} {}\n", first + t[0], first + t[1], first + t[2]);
    first += s.node.size();
    n += s.triangle.size();
  }
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float "
             "y\nproperty float z\nelement face {}\nproperty list uchar int "
             "vertex_indices\nend_header\n",
             first, n) +
         nodes + faces;
}

std::string stl(const std::vector<Surface>& all) {
  std::string text;
  for (const Surface& s : all) {
    text += "solid cell\n";
    for (const auto& t : s.triangle) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int k : t)
        text +=
            fmt::format("vertex {:.5f} {:.5f} {:.5f}\n", s.node[k][0], s.node[k][1], s.node[k][2]);
      text += "endloop\nendfacet\n";
    }
    text += "endsolid cell\n";
  }
  return text;
}

std::string vtk_text(const std::vector<Surface>& all) {
  std::string points, faces;
  std::size_t first = 0, n = 0;
  for (const Surface& s : all) {
    for (const Vec3& x : s.node) points += fmt::format("{:.6f} {:.6f} {:.6f}\n", x[0], x[1], x[2]);
    for (const auto& t : s.triangle)
      faces += fmt::format("3 {} {} {}\n", first + t[0], first + t[1], first + t[2]);
    first += s.node.size();
    n += s.triangle.size();
  }
  return fmt::format(
      "# vtk DataFile Version 3.0\ncells\nASCII\nDATASET POLYDATA\nPOINTS {} float\n"
      "{}POLYGONS {} {}\n{}",
      first, points, n, 4 * n, faces);
}

std::vector<Format> surfaces(const TempFolder& folder) {
  const std::vector<Surface> two = balls();
  std::vector<Format> all{{"text.ply", ply(two), surface_content},
                          {"text.stl", stl(two), surface_content, false},
                          {"text.vtk", vtk_text(two), surface_content}};
  io::write_surfaces(folder.path() + "/a.vtk", two, std::vector<std::uint32_t>{1, 2});
  all.push_back({"binary.vtk", bytes_of(folder.path() + "/a.vtk"), surface_content});
  Surface both = two[0];
  for (const Vec3& x : two[1].node) both.node.push_back(x);
  const int first = static_cast<int>(two[0].node.size());
  for (const auto& [i, j, k] : two[1].triangle)
    both.triangle.push_back({first + i, first + j, first + k});
  for (const char* name : {"binary.stl", "text.obj"}) {
    io::write_surface(folder.path() + "/" + name, both);
    all.push_back({name, bytes_of(folder.path() + "/" + name), surface_content});
  }
  return all;
}

std::vector<Format> networks() {
  std::string points, lines, radii, swc = "# a tree\n", nodes, strands;
  constexpr int kNodes = 40;
  for (int k = 0; k < kNodes; ++k) {
    points += fmt::format("{} {} 0\n", 10 * k, k % 3);
    radii += fmt::format("{}\n", 2 + k % 4);
    swc += fmt::format("{} 3 {} {} 0 {} {}\n", k + 1, 10 * k, k % 3, 2 + k % 4, k == 0 ? -1 : k);
    nodes += fmt::format("{} {} {} 0 {}\n", k + 1, 10 * k, k % 3, 2 + k % 4);
    if (k > 0) lines += fmt::format("2 {} {}\n", k - 1, k);
    if (k > 0) strands += fmt::format("{} {} {}\n", k, k, k + 1);
  }
  return {{"text.vtk",
           fmt::format("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS {} float\n{}"
                       "LINES {} {}\n{}POINT_DATA {}\nSCALARS radius float 1\nLOOKUP_TABLE "
                       "default\n{}",
                       kNodes, points, kNodes - 1, 3 * (kNodes - 1), lines, kNodes, radii),
           network_content},
          {"tree.swc", swc, network_content, false},
          {"tree.vmv",
           fmt::format("$PARAM_BEGIN\n$NUM_VERTS {}\n$NUM_STRANDS {}\n$PARAM_END\n"
                       "$VERT_LIST_BEGIN\n{}$VERT_LIST_END\n$STRANDS_LIST_BEGIN\n{}"
                       "$STRANDS_LIST_END\n",
                       kNodes, kNodes - 1, nodes, strands),
           network_content}};
}

class Damage : public testing::Test {
 protected:
  static bool all() { return std::getenv("ACINUS_DAMAGE") != nullptr; }

  void try_all(const std::vector<Format>& formats) {
    for (const Format& f : formats) {
      const Content whole = f.read(folder_.write(f.name, f.bytes));
      counts_ = {};
      cut(f, whole);
      flip(f, whole);
      fmt::print(
          "{:14} {:6} bytes: {:6} refused, {:5} the same, {:5} with other data{}{}, {} with "
          "another structure\n",
          f.name, f.bytes.size(), counts_.refused, counts_.same, counts_.data,
          counts_.lines > 0 ? fmt::format(", {} cut between lines", counts_.lines) : "",
          counts_.told > 0 ? fmt::format(", {} told by a note", counts_.told) : "",
          counts_.structure);
      EXPECT_EQ(counts_.structure, 0) << f.name << ": " << counts_.first;
      EXPECT_GT(counts_.refused, 20) << f.name;
    }
  }

 private:
  struct Counts {
    int refused = 0, same = 0, data = 0, structure = 0, lines = 0, told = 0;
    std::string first;
  };

  void cut(const Format& f, const Content& whole) {
    const std::size_t n = all() ? std::min<std::size_t>(f.bytes.size(), kMost) : 20;
    for (std::size_t k = 1; k < n; ++k) {
      const std::size_t size = k * f.bytes.size() / n;
      const bool whole_line =
          !f.says_counts && (f.bytes[size - 1] == '\n' || f.bytes[size] == '\n');
      judge(f, whole, f.bytes.substr(0, size), fmt::format("cut to {} bytes", size), whole_line);
    }
  }

  void flip(const Format& f, const Content& whole) {
    std::mt19937 random(7);
    const std::size_t bits = 8 * f.bytes.size();
    const std::size_t n = all() ? std::min<std::size_t>(bits, kMost) : 100;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t place = n == bits ? k : random() % bits, at = place / 8;
      const auto bit = static_cast<int>(place % 8);
      std::string bytes = f.bytes;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      judge(f, whole, bytes, fmt::format("bit {} of byte {}", bit, at), false);
    }
  }

  void judge(const Format& f, const Content& whole, const std::string& bytes,
             const std::string& what, bool whole_line) {
    try {
      const Content found = f.read(folder_.write(f.name, bytes));
      if (found.structure != whole.structure) {
        ++(whole_line ? counts_.lines : found.told ? counts_.told : counts_.structure);
        if (counts_.first.empty() && !whole_line && !found.told)
          counts_.first = what + ": " + found.structure + " for " + whole.structure;
      } else {
        ++(found.data == whole.data ? counts_.same : counts_.data);
      }
    } catch (const Error&) {
      ++counts_.refused;
    }
  }

  static constexpr std::size_t kMost = 5000;  ///< cuts, and changes, of a file
  Counts counts_;

 protected:
  TempFolder folder_;
};

TEST_F(Damage, ImagesKeepTheSizesThatTheyStateOrAreRefused) { try_all(images(folder_)); }
TEST_F(Damage, SurfacesKeepTheirBodiesOrAreRefused) { try_all(surfaces(folder_)); }
TEST_F(Damage, NetworksKeepTheirNodesOrAreRefused) { try_all(networks()); }

}  // namespace
}  // namespace acinus
