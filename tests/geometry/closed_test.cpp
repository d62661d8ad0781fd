#include "geometry/closed.hpp"

#include <gtest/gtest.h>

#include "geometry/measures.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/geometry/temp_folder.hpp"

namespace acinus::geometry {
namespace {

TEST(CheckClosed, TurnsAnInwardSurfaceOutward) {
  Surface box = make_box(Vec3(1, 2, 3));
  const auto outward = box.triangle;
  check_closed(box, "box");
  EXPECT_EQ(box.triangle, outward);  // untouched
  for (auto& t : box.triangle) std::swap(t[0], t[2]);
  EXPECT_LT(compute_volume(box.node, box.triangle), 0);
  check_closed(box, "box");
  EXPECT_NEAR(compute_volume(box.node, box.triangle), 6, 1e-14);
}

TEST(CheckClosed, NamesTheFirstOpenEdge) {
  Surface box = make_box(Vec3(1, 2, 3));
  box.triangle.erase(box.triangle.begin() + 1);  // nodes 1, 2, 3
  const std::string text = test::message_of([&] { check_closed(box, "walls.obj: body 4"); });
  EXPECT_CONTAINS(text, "walls.obj: body 4: not a closed surface: 3 open edges");
  EXPECT_CONTAINS(text, "0 non-manifold edges");
  EXPECT_CONTAINS(text, "edge 1-2 from (1, 0, 0) to (0, 2, 0) um");
  EXPECT_CONTAINS(text, "Close the holes");
}

TEST(CheckClosed, CountsNonManifoldEdges) {
  Surface box = make_box(Vec3(1, 1, 1));
  box.node.push_back(Vec3(0, 0, -1));
  box.triangle.push_back({0, 1, 8});
  const std::string text = test::message_of([&] { check_closed(box, "b"); });
  EXPECT_CONTAINS(text, "2 open edges");
  EXPECT_CONTAINS(text, "1 non-manifold edges");
  EXPECT_CONTAINS(text, "first edge 0-1");
}

TEST(CheckClosed, RefusesMixedOrientation) {
  Surface box = make_box(Vec3(1, 1, 1));
  std::swap(box.triangle[5][0], box.triangle[5][1]);
  const std::string text = test::message_of([&] { check_closed(box, "b"); });
  EXPECT_CONTAINS(text, "3 edges are run twice in the same direction");
}

TEST(CheckClosed, RefusesSheetsThatTouchInANode) {
  Surface box = make_box(Vec3(1, 1, 1));
  const Surface other = make_box(Vec3(-1, -1, 1));  // shares the corner at the origin
  for (std::size_t i = 1; i < 8; ++i) box.node.push_back(other.node[i]);
  for (auto t : other.triangle) {
    for (int& node : t) node = node == 0 ? 0 : node + 7;
    box.triangle.push_back(t);
  }
  EXPECT_CONTAINS(test::message_of([&] { check_closed(box, "b"); }),
                  "node 0 at (0, 0, 0) um joins two sheets");
}

TEST(CheckClosed, RefusesBadIndicesAndFlatBodies) {
  Surface box = make_box(Vec3(1, 1, 1));
  box.triangle[2][1] = 8;
  EXPECT_CONTAINS(test::message_of([&] { check_closed(box, "b"); }),
                  "triangle 2 uses nodes 4, 8, 6");
  box.triangle[2][1] = 4;
  EXPECT_CONTAINS(test::message_of([&] { check_closed(box, "b"); }),
                  "triangle 2 uses a node twice");
  Surface flat = make_box(Vec3(1, 1, 0));
  EXPECT_CONTAINS(test::message_of([&] { check_closed(flat, "b"); }), "encloses a volume of");
  Surface none;
  EXPECT_CONTAINS(test::message_of([&] { check_closed(none, "b"); }), "no triangles");
}

}  // namespace
}  // namespace acinus::geometry
