#include "geometry/readers/read_surface.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "geometry/measures.hpp"
#include "geometry/readers/vtk_legacy.hpp"
#include "geometry/triangulate.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/paths.hpp"

namespace acinus::geometry {
namespace {

std::string points_text(const Surface& surface) {
  std::string text = fmt::format("POINTS {} double\n", surface.node.size());
  for (const Vec3& x : surface.node) text += fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
  return text;
}

std::string vtk_header(const std::string& mode, const std::string& dataset) {
  return "# vtk DataFile Version 3.0\nany title\n" + mode + "\nDATASET " + dataset + "\n";
}

/// 16 bodies with the volumes and areas that the file gives beside them.
void expect_measures_of_file(const std::string& path) {
  const std::vector<Surface> bodies = read_closed_surfaces(path, 1e6);
  ASSERT_EQ(bodies.size(), 16u);
  const VtkLegacy vtk = read_vtk_legacy(path, {"UNSTRUCTURED_GRID"}, "");
  double worst_volume = 0, worst_area = 0;
  int compared = 0;
  for (const VtkArray& array : vtk.cell_data) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto& [node, triangle] = bodies[b];
      if (array.name == "cell_volume") {
        worst_volume = std::max(
            worst_volume, std::abs(compute_volume(node, triangle) * 1e-18 / array.value[b] - 1));
        ++compared;
      }
      if (array.name == "cell_area") {
        worst_area = std::max(worst_area,
                              std::abs(compute_area(node, triangle) * 1e-12 / array.value[b] - 1));
        ++compared;
      }
    }
  }
  std::printf("worst relative difference: volume %.1e, area %.1e\n", worst_volume, worst_area);
  EXPECT_EQ(compared, 32);
  // The file prints four digits of the values and five of the coordinates.
  EXPECT_LT(worst_volume, 1e-3);
  EXPECT_LT(worst_area, 1e-3);
  for (const Surface& body : bodies) EXPECT_NO_THROW(make_topology(body));
}

/// Two bodies: the first is closed, the second is not and gets named.
void expect_second_body_refused(const std::string& path) {
  std::vector<Surface> bodies = read_surfaces(path, 1e6);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NO_THROW(check_closed(bodies[0], "body 0"));
  const std::string text = test::message_of([&] { read_closed_surfaces(path, 1e6); });
  std::printf("%s\n", text.c_str());
  EXPECT_CONTAINS(text, std::filesystem::path(path).filename().string() + ": body 1: ");
}

TEST(ReadSurface, AggregateHasTheVolumesAndAreasOfItsFile) {
  expect_measures_of_file(test::data_path("files/aggregate.vtk"));
}

TEST(ReadSurface, ABodyWithAHoleIsRefused) {
  expect_second_body_refused(test::data_path("files/open_body.vtk"));
}

TEST(ReadSurface, EmbryoHasTheVolumesAndAreasOfItsFile) {
  if (!test::has_real_data()) GTEST_SKIP();
  expect_measures_of_file(test::real_path("simucell3d/embryo_5.vtk"));
}

TEST(ReadSurface, YoungLaplaceBodyOneIsRefused) {
  if (!test::has_real_data()) GTEST_SKIP();
  expect_second_body_refused(test::real_path("simucell3d/young_laplace_test_geom.vtk"));
}

TEST(ReadSurface, PolydataQuadsBecomeTriangles) {
  const TempFolder folder;
  const std::string path = folder.write(
      "box.vtk",
      vtk_header("ASCII", "POLYDATA") + points_text(make_box(Vec3(1, 2, 3))) +
          "POLYGONS 6 30\n4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n"
          "CELL_DATA 6\nSCALARS side int 1\nLOOKUP_TABLE default\n0 1 2 3 4 5\n");
  const auto bodies = read_closed_surfaces(path, 2);
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].triangle.size(), 12u);
  EXPECT_NEAR(compute_volume(bodies[0].node, bodies[0].triangle), 48, 1e-12);
}

TEST(ReadSurface, BinaryPolydataAndTheOffsetsFormAreRead) {
  const TempFolder folder;
  const Surface box = make_box(Vec3(1, 2, 3));
  std::string binary = vtk_header("BINARY", "POLYDATA") + "POINTS 8 float\n";
  for (const Vec3& x : box.node) {
    for (int d = 0; d < 3; ++d) binary += big_endian(static_cast<float>(x[d]));
  }
  binary += "\nPOLYGONS 12 48\n";
  std::string text = vtk_header("ASCII", "POLYDATA") + points_text(box) +
                     "POLYGONS 13 36\nOFFSETS vtktypeint64\n0";
  for (int t = 1; t <= 12; ++t) text += fmt::format(" {}", 3 * t);
  text += "\nCONNECTIVITY vtktypeint64\n";
  for (const auto& [a, b, c] : box.triangle) {
    binary += big_endian(3) + big_endian(a) + big_endian(b) + big_endian(c);
    text += fmt::format("{} {} {}\n", a, b, c);
  }
  for (const auto& path : {folder.write("b.vtk", binary + "\n"), folder.write("t.vtk", text)}) {
    const auto bodies = read_closed_surfaces(path, 1);
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_EQ(bodies[0].triangle, box.triangle);
    EXPECT_EQ(bodies[0].node, box.node);
  }
}

TEST(ReadSurface, GridOfPolyhedraAndTrianglesGivesOneSurfaceEach) {
  const TempFolder folder;
  Surface two = make_box(Vec3(1, 1, 1));
  for (const Vec3& x : make_box(Vec3(2, 2, 2)).node) two.node.push_back(x + Vec3(5, 0, 0));
  std::string text = vtk_header("ASCII", "UNSTRUCTURED_GRID") + points_text(two) + "CELLS 13 80\n";
  for (const auto& [a, b, c] : make_box(Vec3(1, 1, 1)).triangle)
    text += fmt::format("3 {} {} {}\n", a + 8, b + 8, c + 8);
  // Faces of the polyhedron point inward here.
  text += "31 6 4 0 1 3 2 4 4 6 7 5 4 0 4 5 1 4 2 3 7 6 4 0 2 6 4 4 1 5 7 3\nCELL_TYPES 13\n";
  for (int t = 0; t < 12; ++t) text += "5\n";
  const auto bodies = read_closed_surfaces(folder.write("two.vtk", text + "42\n"), 1);
  ASSERT_EQ(bodies.size(), 2u);  // polyhedra first
  EXPECT_NEAR(compute_volume(bodies[0].node, bodies[0].triangle), 1, 1e-14);
  EXPECT_NEAR(compute_volume(bodies[1].node, bodies[1].triangle), 8, 1e-14);
}

TEST(ReadSurface, ObjWithSlashesNegativesAndContinuation) {
  const TempFolder folder;
  std::string text = "# box\no part\r\n";
  for (const Vec3& x : make_box(Vec3(1, 2, 3)).node)
    text += fmt::format("v {} {} +{}  # node\r\n", x.x(), x.y(), x.z());
  text +=
      "vn 0 0 1\nusemtl x\nf 1//1 3//1 4/7/1 \\\n 2\nf -4 -3 -1 -2\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 "
      "3\nf 2 4 8 6\n";
  const auto bodies = read_closed_surfaces(folder.write("box.OBJ", text), 1);
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_NEAR(compute_volume(bodies[0].node, bodies[0].triangle), 6, 1e-14);
}

/// Files in the form of Blender, MeshLab and others: unused properties, both binary orders.
TEST(ReadSurface, PlyOfAllKinds) {
  const TempFolder folder;
  const Surface box = make_box(Vec3(1, 2, 3));
  const auto header = [&](const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\ncomment made by hand\nelement vertex 8\nproperty float x\nproperty float y\n"
           "property float z\nproperty uchar red\nelement face 12\nproperty list uchar int "
           "vertex_indices\nproperty float quality\nelement edge 1\nproperty int vertex1\n"
           "end_header\n";
  };
  std::string text = header("ascii"), big = header("binary_big_endian"),
              little = header("binary_little_endian");
  const auto add = [&](auto value) {
    const std::string bytes = big_endian(value);
    big += bytes;
    little += std::string(bytes.rbegin(), bytes.rend());
    text += fmt::format("{} ", value);
  };
  const auto add_byte = [&](char value) {
    big += value;
    little += value;
    text += fmt::format("{} ", static_cast<int>(value));
  };
  for (const Vec3& x : box.node) {
    for (int k = 0; k < 3; ++k) add(static_cast<float>(x[k]));
    add_byte(9);
  }
  for (const auto& t : box.triangle) {
    add_byte(3);
    for (const int k : t) add(k);
    add(0.5f);
  }
  add(1);
  for (const std::string& content : {text, big, little}) {
    const auto bodies = read_closed_surfaces(folder.write("box.ply", content), 1);
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_NEAR(compute_volume(bodies[0].node, bodies[0].triangle), 6, 1e-14);
  }
  EXPECT_CONTAINS(refusal(folder.write("cut.ply", big.substr(0, big.size() - 20))), "truncated");
  EXPECT_CONTAINS(refusal(folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex x\n")),
                  "a.ply:3: found \"x\" where a number of elements");
  EXPECT_CONTAINS(refusal(folder.write("b.ply",
                                       "ply\nformat ascii 1.0\nelement vertex 1\nproperty "
                                       "float x\nend_header\n1\n")),
                  "it needs x, y and z");
}

TEST(ReadSurface, StlCornersAreMerged) {
  const TempFolder folder;
  const Surface sphere = make_sphere(42, 3);
  std::string text = "solid s\n", binary(80, ' ');
  binary.replace(0, 5, "solid");  // some writers do this
  const auto little = [](std::uint32_t raw) {
    std::string bytes = big_endian(raw);
    return std::string(bytes.rbegin(), bytes.rend());
  };
  binary += little(80);
  for (const auto& t : sphere.triangle) {
    text += "facet normal 0 0 0\nouter loop\n";
    binary += std::string(12, '\0');
    for (const int i : t) {
      const Vec3& x = sphere.node[i];
      text += fmt::format("vertex {} {} {}\n", x.x(), x.y(), x.z());
      for (int d = 0; d < 3; ++d)
        binary += little(std::bit_cast<std::uint32_t>(static_cast<float>(x[d])));
    }
    text += "endloop\nendfacet\n";
    binary += std::string(2, '\0');
  }
  text += "endsolid s\n";
  const double volume = compute_volume(sphere.node, sphere.triangle);
  for (const auto& path : {folder.write("t.stl", text), folder.write("b.stl", binary)}) {
    const auto bodies = read_closed_surfaces(path, 1);
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_EQ(bodies[0].node.size(), 42u);
    EXPECT_NEAR(compute_volume(bodies[0].node, bodies[0].triangle) / volume, 1, 1e-6);  // float
  }
  EXPECT_CONTAINS(refusal(folder.write("cut.stl", text.substr(0, text.size() / 2))), "cut.stl:");
  EXPECT_CONTAINS(refusal(folder.write("cutb.stl", binary.substr(0, 1000))), "cutb.stl:");
  binary.replace(0, 5, "other");
  EXPECT_CONTAINS(refusal(folder.write("cutc.stl", binary.substr(0, 1000))),
                  "1000 bytes do not fit the 80 facets");
}

TEST(ReadSurface, BadFilesAreRefusedWithPlaceAndRemedy) {
  const TempFolder folder;
  EXPECT_CONTAINS(refusal(folder.path() + "/none.obj"), "none.obj: no such file");
  EXPECT_CONTAINS(refusal(folder.path()), "read from .vtk");
  EXPECT_CONTAINS(refusal(folder.write("a.off", "OFF\n")),
                  ".vtk (legacy), .obj, .stl and .ply, not \".off\"");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "")), "empty");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 0\nv 1 0\n")),
                  "a.obj:2: coordinate 3 of node 2 is missing");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 nan\n")),
                  "a.obj:1: coordinate 3 of node 1 is \"nan\"");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 0\nf 1 2 3\n")),
                  "a.obj:2: face 1 uses node 2");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 0\nf 1 x 3\n")),
                  "a.obj:2: a face uses node \"x\"");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n")),
                  "face 1 has 2 corners");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\n")),
                  "uses the same node twice");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 0 0 0\n")), "holds no faces");
  EXPECT_CONTAINS(refusal(folder.write("a.vtk", "<?xml version=\"1.0\"?>\n<VTKFile>")), "VTK XML");
  const std::string grid =
      vtk_header("ASCII", "UNSTRUCTURED_GRID") + points_text(make_box(Vec3(1, 1, 1)));
  EXPECT_CONTAINS(refusal(folder.write("a.vtk", grid + "CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n")),
                  "a.vtk:15: cell 0 has type 10");
  EXPECT_CONTAINS(refusal(folder.write("a.vtk", grid + "CELLS 1 4\n3 0 1 2\n")),
                  "CELLS has 1 cells but CELL_TYPES 0");
  EXPECT_CONTAINS(
      refusal(folder.write("a.vtk", grid + "CELLS 1 6\n5 2 3 0 1 2\nCELL_TYPES 1\n42\n")),
      "polyhedron 0: its face list ends early");
  EXPECT_CONTAINS(
      refusal(folder.write("a.vtk", grid + "CELLS 1 6\n5 1 3 0 1 8\nCELL_TYPES 1\n42\n")),
      "polyhedron 0, face 0 uses node 8");
  EXPECT_CONTAINS(
      refusal(folder.write("a.vtk", grid + "CELLS 1 6\n5 999999999 3 0 1 2\nCELL_TYPES 1\n42\n")),
      "ends early");
  EXPECT_CONTAINS(refusal(folder.write("a.vtk", grid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n")),
                  "body 0: not a closed surface: 3 open edges");
  const std::string poly = vtk_header("ASCII", "POLYDATA") + points_text(make_box(Vec3(1, 1, 1)));
  EXPECT_CONTAINS(refusal(folder.write("a.vtk", poly + "TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n")),
                  "TRIANGLE_STRIPS");
  EXPECT_CONTAINS(test::message_of([&] { read_surfaces(folder.write("u.vtk", poly), 0); }),
                  "must be above 0");
}

TEST(Triangulate, CutsConvexAndConcavePolygons) {
  // An arrow head: a fan from node 0 would fold over.
  const std::vector<Vec3> node = {Vec3(0, 0, 0), Vec3(4, 2, 0), Vec3(0, 4, 0), Vec3(1, 2, 0)};
  const std::vector<int> corner = {0, 1, 2, 3};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    std::vector<int> turned = corner;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
    const auto triangle = triangulate(turned, node);
    ASSERT_EQ(triangle.size(), 2u);
    for (const auto& [a, b, c] : triangle) {
      const auto x = [&](int i) { return node[i]; };
      EXPECT_GT((x(b) - x(a)).cross(x(c) - x(a)).z(), 0);
    }
    EXPECT_NEAR(compute_area(node, triangle), 6, 1e-14);
  }
  std::vector<Vec3> star;
  std::vector<int> index;
  for (int k = 0; k < 40; ++k) {
    const double r = k % 2 ? 1 : 2, angle = kPi * k / 20;
    star.push_back(Vec3(r * std::cos(angle), r * std::sin(angle), 0.5));
    index.push_back(k);
  }
  const auto triangle = triangulate(index, star);
  EXPECT_EQ(triangle.size(), 38u);
  EXPECT_NEAR(compute_area(star, triangle), 40 * std::sin(kPi / 20), 1e-12);  // r1 r2 sin / 2 each
}

}  // namespace
}  // namespace acinus::geometry
