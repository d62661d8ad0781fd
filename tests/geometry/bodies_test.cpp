/// Bodies that touch: what the file says, and what hangs together at edges.

#include "geometry/bodies.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/measures.hpp"
#include "geometry/readers/read_surface.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/geometry/temp_folder.hpp"

namespace acinus::geometry {
namespace {

/// Body, outward; two triangles a side, those at low x the fifth.
Surface body(const Vec3& low, const Vec3& size) {
  Surface s = make_box(size);
  for (Vec3& x : s.node) x += low;
  return s;
}

const Vec3 kSize(10, 10, 10);
constexpr double kVolume = 1000;

/// Two cells of 1000 um^3 that share a wall, an edge, a corner, or half a wall.
std::vector<std::vector<Surface>> touching() {
  const Surface a = body(Vec3::Zero(), kSize);
  return {{a, body({10, 0, 0}, kSize)},
          {a, body({10, 10, 0}, kSize)},
          {a, body({10, 10, 10}, kSize)},
          {a, body({0, -10, 0}, kSize), body({-10, 0, 0}, kSize), body({-10, -10, 0}, kSize)}};
}

std::string facets(const Surface& s) {
  std::string text;
  for (const auto& t : s.triangle) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int k : t)
      text += fmt::format("vertex {} {} {}\n", s.node[k][0], s.node[k][1], s.node[k][2]);
    text += "endloop\nendfacet\n";
  }
  return text;
}

std::string solid(const std::vector<Surface>& all, const std::string& name = "a") {
  std::string text = "solid " + name + "\n";
  for (const Surface& s : all) text += facets(s);
  return text + "endsolid " + name + "\n";
}

std::string binary_stl(const std::vector<Surface>& all) {
  std::string text(80, ' ');
  std::uint32_t n = 0;
  std::string facets;
  const auto put = [&](std::uint32_t raw, std::string& to) {
    for (int k = 0; k < 4; ++k) to += static_cast<char>(raw >> 8 * k & 0xff);
  };
  for (const Surface& s : all)
    for (const auto& t : s.triangle) {
      ++n;
      facets += std::string(12, '\0');
      for (const int k : t)
        for (int c = 0; c < 3; ++c)
          put(std::bit_cast<std::uint32_t>(static_cast<float>(s.node[k][c])), facets);
      facets += std::string(2, '\0');
    }
  put(n, text);
  return text + facets;
}

/// All corners once, by place, with a group a body. @param named  says which body a face is of
std::string obj(const std::vector<Surface>& all, const char* named) {
  std::string nodes, faces;
  std::vector<Vec3> seen;
  for (std::size_t b = 0; b < all.size(); ++b) {
    if (named[0] != 0) faces += fmt::format("{} cell{}\n", named, b);
    for (const auto& t : all[b].triangle) {
      faces += "f";
      for (const int k : t) {
        std::size_t n = 0;
        while (n < seen.size() && seen[n] != all[b].node[k]) ++n;
        if (n == seen.size()) {
          seen.push_back(all[b].node[k]);
          nodes += fmt::format("v {} {} {}\n", seen[n][0], seen[n][1], seen[n][2]);
        }
        faces += fmt::format(" {}", n + 1);
      }
      faces += "\n";
    }
  }
  return nodes + faces;
}

/// Every triangle with nodes of its own, as unwelded exports have it.
std::string ply_soup(const std::vector<Surface>& all) {
  std::string nodes, faces;
  int n = 0;
  for (const Surface& s : all)
    for (const auto& t : s.triangle) {
      for (const int k : t)
        nodes += fmt::format("{} {} {}\n", s.node[k][0], s.node[k][1], s.node[k][2]);
      faces += fmt::format("3 {} {} {}\n", n, n + 1, n + 2);
      n += 3;
    }
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float "
             "y\nproperty float z\nelement face {}\nproperty list uchar int "
             "vertex_indices\nend_header\n",
             n, n / 3) +
         nodes + faces;
}

void expect_cells(const std::string& path, std::size_t n) {
  const std::vector<Surface> bodies = read_closed_surfaces(path, 1);
  ASSERT_EQ(bodies.size(), n) << path;
  for (const Surface& s : bodies) {
    EXPECT_EQ(s.node.size(), 8u) << path;
    EXPECT_NEAR(compute_volume(s.node, s.triangle), kVolume, 1e-3) << path;
  }
}

TEST(Bodies, ThatTouchComeApartInEveryFormat) {
  const TempFolder folder;
  for (const std::vector<Surface>& all : touching()) {
    std::string solids;
    for (std::size_t b = 0; b < all.size(); ++b) solids += solid({all[b]}, fmt::format("c{}", b));
    expect_cells(folder.write("solids.stl", solids), all.size());
    expect_cells(folder.write("one.stl", solid(all)), all.size());
    expect_cells(folder.write("binary.stl", binary_stl(all)), all.size());
    expect_cells(folder.write("objects.obj", obj(all, "o")), all.size());
    expect_cells(folder.write("groups.obj", obj(all, "g")), all.size());
    expect_cells(folder.write("plain.obj", obj(all, "")), all.size());
    expect_cells(folder.write("soup.ply", ply_soup(all)), all.size());
  }
}

TEST(Bodies, ThatAllPointInwardComeApartAsWell) {
  const TempFolder folder;
  for (std::vector<Surface> all : touching()) {
    for (Surface& s : all)
      for (auto& t : s.triangle) std::swap(t[1], t[2]);
    expect_cells(folder.write("a.stl", solid(all)), all.size());
  }
}

TEST(Bodies, OfSeveralPatchesAreOne) {
  const TempFolder folder;
  const Surface a = body(Vec3::Zero(), kSize);
  std::string patches, groups = obj({a}, "");
  for (std::size_t k = 0; k < 12; k += 2) {  // a solid a side, as meshers of flows write it
    Surface side = a;
    side.triangle = {a.triangle[k], a.triangle[k + 1]};
    patches += solid({side}, fmt::format("side{}", k));
  }
  expect_cells(folder.write("a.stl", patches), 1);
  std::size_t side = 0;
  for (std::size_t at = 0; (at = groups.find("f ", at)) != groups.npos; at += 20)
    groups.insert(at, fmt::format("g side{:09}\n", side++ / 2));
  expect_cells(folder.write("a.obj", groups), 1);
}

TEST(Bodies, ThatShareWallsWithoutTwinsAreToldWhatIsNeeded) {
  const TempFolder folder;
  Surface a = body(Vec3::Zero(), kSize), b = body({10, 0, 0}, kSize);
  b.triangle.erase(b.triangle.begin() + 8, b.triangle.begin() + 10);  // the wall, once
  const std::string message = refusal(folder.write("a.obj", obj({a, b}, "g")));
  EXPECT_CONTAINS(message, "non-manifold edges");
  EXPECT_CONTAINS(message, "need all their faces each");
}

TEST(Bodies, InsideOthersAreFound) {
  const TempFolder folder;
  const Surface outer = body(Vec3::Zero(), kSize), inner = body({3, 3, 3}, {4, 4, 4});
  Surface cavity = inner;
  for (auto& t : cavity.triangle) std::swap(t[1], t[2]);
  EXPECT_CONTAINS(refusal(folder.write("a.stl", solid({outer}) + solid({cavity}))),
                  "body 1 lies inside body 0 and is turned the other way: a cavity");
  EXPECT_CONTAINS(refusal(folder.write("b.stl", binary_stl({cavity, outer}))),
                  "body 0 lies inside body 1");
  const std::vector<Surface> two =
      read_closed_surfaces(folder.write("c.stl", solid({inner, outer})), 1);
  const Nested n = find_nested(two);
  EXPECT_EQ(n.inner, 0);
  EXPECT_EQ(n.outer, 1);
  // In the body of the other, not inside it.
  Surface ring = body(Vec3::Zero(), {10, 10, 1});
  ring.node[7] += Vec3(0, 0, 9);
  EXPECT_EQ(find_nested({ring, body({1, 1, 3}, {1, 1, 1})}).inner, -1);
}

TEST(Bodies, OfTextWithCapitalsOrAByteOrderMark) {
  const TempFolder folder;
  const std::string mark = "\xef\xbb\xbf", text = solid({body(Vec3::Zero(), kSize)});
  std::string capitals = text;
  for (char& c : capitals) c = static_cast<char>(std::toupper(c));
  expect_cells(folder.write("a.stl", capitals), 1);
  expect_cells(folder.write("b.stl", mark + text), 1);
  const std::vector<Surface> one{body(Vec3::Zero(), kSize)};
  expect_cells(folder.write("a.obj", mark + obj(one, "o")), 1);
  expect_cells(folder.write("a.ply", mark + ply_soup(one)), 1);
  EXPECT_CONTAINS(refusal(folder.write("c.stl", std::string("\xff\xfes\0o\0", 6))), "UTF-16");
}

TEST(ReadSurface, IsLinearInTheFacesOfTextFiles) {
  const TempFolder folder;
  constexpr int kFaces = 120000;
  std::string points, faces;
  for (int k = 0; k < kFaces + 2; ++k) points += fmt::format("{} {} 0\n", k / 2, k % 2);
  for (int k = 0; k < kFaces; ++k) faces += fmt::format("3 {} {} {}\n", k, k + 1, k + 2);
  const std::string path = folder.write(
      "a.vtk", fmt::format("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS {} "
                           "float\n{}POLYGONS {} {}\n{}",
                           kFaces + 2, points, kFaces, 4 * kFaces, faces));
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(read_surfaces(path, 1)[0].triangle.size(), static_cast<std::size_t>(kFaces));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
  EXPECT_LT(took.count(), 5);  // a search for the place of every face took a minute
}

TEST(ReadSurface, RefusesNumbersThatCannotBePlaces) {
  const TempFolder folder;
  std::string text = obj({body(Vec3::Zero(), kSize)}, "");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", "v 1e308 0 0\n" + text)), "a.obj:1: coordinate 1");
  text = solid({body({5e9, 0, 0}, kSize)});
  EXPECT_CONTAINS(refusal(folder.write("a.stl", text)), "coordinates may be up to 1000000000 um");
  EXPECT_CONTAINS(refusal(folder.write("a.ply",
                                       "ply\nformat ascii 1.0\nelement x 9000000000000000\n"
                                       "end_header\n")),
                  "without properties");
  EXPECT_CONTAINS(
      refusal(folder.write("b.ply", ply_soup({body(Vec3::Zero(), kSize)}) + "3 1 2 3\n")),
      "goes on behind all the elements");
}

TEST(ReadSurface, TellsAnObjThatWasCutByItsLastNodes) {
  const TempFolder folder;
  const std::string text = obj({body(Vec3::Zero(), kSize)}, "");
  EXPECT_CONTAINS(refusal(folder.write("a.obj", text + "v 1 2 3\nv 4 5 6\n")),
                  "nodes 9 to 10, the last of the file, are in no face");
  expect_cells(folder.write("c.obj", text + "v 1 2 3\nv 4 5 6\nl 9 10\n"), 1);
  EXPECT_CONTAINS(refusal(folder.write("b.obj", text + "F 1 2 3\n")), "b.obj:21: found \"F\"");
}

}  // namespace
}  // namespace acinus::geometry
