#include "geometry/readers/read_network.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <random>

#include "tests/geometry/temp_folder.hpp"
#include "tests/paths.hpp"

namespace acinus::geometry {
namespace {

const std::string kData = test::data_path("files/");
const std::string kHeader = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\n";
const std::string kPoints = "POINTS 4 float\n0 0 0 1 0 0\n2 0 0 2 1 0\n";  // lines 5 to 7
const std::string kLines = "LINES 2 7\n3 0 1 2\n2 2 3\n";                  // lines 8 to 10
const std::string kCellRadius = "CELL_DATA 2\nSCALARS radius float 1\nLOOKUP_TABLE default\n2 3\n";

std::string network_refusal(const std::string& path) {
  return test::message_of([&] { read_network(path); });
}

/// `path`.vtk holds what `path`.csv holds as text.
void expect_equal_to_decoded_copy(const std::string& path, std::size_t n_node,
                                  std::size_t n_segment) {
  const Network network = read_network(path + ".vtk");
  std::ifstream csv(path + ".csv");
  std::string line;
  std::getline(csv, line);  // comment
  std::getline(csv, line);
  ASSERT_EQ(line, fmt::format("NODES {}", n_node));
  ASSERT_EQ(network.node.size(), n_node);
  for (std::size_t i = 0; i < n_node; ++i) {
    std::getline(csv, line);
    const Vec3& x = network.node[i];
    EXPECT_EQ(line, fmt::format("{},{:.4f},{:.4f},{:.4f}", i, x.x(), x.y(), x.z()));
  }
  std::getline(csv, line);
  ASSERT_EQ(line, fmt::format("EDGES {}", n_segment));
  ASSERT_EQ(network.segment.size(), n_segment);
  ASSERT_EQ(network.radius.size(), n_segment);
  for (std::size_t s = 0; s < n_segment; ++s) {
    std::getline(csv, line);
    const auto& [a, b] = network.segment[s];
    EXPECT_EQ(line, fmt::format("{},{},{:.5f}", a, b, network.radius[s][0]));
    EXPECT_EQ(network.radius[s][0], network.radius[s][1]);
  }
}

/// Measures of an artery traced with a diameter at every node.
struct Artery {
  std::size_t n_node = 0;
  double low = 0, high = 0, first = 0;  ///< radius, um
  double length = 0;                    ///< um
};

void expect_artery(const std::string& path, const Artery& expected) {
  const Network network = read_network(path);
  EXPECT_EQ(network.node.size(), expected.n_node);
  EXPECT_EQ(network.segment.size(), expected.n_node - 1);
  double low = 1e9, high = 0;
  for (const auto& [ra, rb] : network.radius) {
    low = std::min({low, ra, rb});
    high = std::max({high, ra, rb});
  }
  const double length = total_length(network);
  std::printf("length %.1f um, radius %.2f..%.2f um\n", length, low, high);
  EXPECT_NEAR(low, expected.low, 0.05);
  EXPECT_NEAR(high, expected.high, 0.05);
  EXPECT_NEAR(length, expected.length, 1);
  EXPECT_DOUBLE_EQ(network.radius[0][0], expected.first);
}

TEST(ReadNetwork, CapillariesEqualTheirDecodedCopy) {
  expect_equal_to_decoded_copy(kData + "capillaries", 354, 348);
}

TEST(ReadNetwork, ArteryHasDiametersAtItsNodes) {
  expect_artery(kData + "artery.vtk", {420, 10.5, 14.1, 10.5, 430.2});
}

TEST(ReadNetwork, SmallVasculatureEqualsItsDecodedCopy) {
  if (!test::has_real_data()) GTEST_SKIP();
  expect_equal_to_decoded_copy(test::real_path("vascpy/test_smaller_vasculature"), 912, 897);
}

TEST(ReadNetwork, PenetratingArteryHasDiametersAtItsNodes) {
  if (!test::has_real_data()) GTEST_SKIP();
  expect_artery(test::real_path("vascpy/penetrating_artery_standardized.vtk"),
                {1274, 10.5, 14.1, 22.772800446 / 2, 1255});
}

TEST(ReadNetwork, PolylinesAreSplitAndRadiiMayStandAnywhere) {
  const TempFolder folder;
  const std::string mesh = kHeader + kPoints + kLines;
  const std::vector<std::string> cell = {
      kCellRadius, "CELL_DATA 2\nFIELD FieldData 2\nid 1 2 int\n7 8\nDiameters 1 2 double\n4 6\n",
      "CELL_DATA 2\nVECTORS v float\n0 0 0 1 1 1\nSCALARS RADII float\nLOOKUP_TABLE default\n2 "
      "3\nMETADATA\n"
      "INFORMATION 0\n\nSCALARS other int 2\nLOOKUP_TABLE default\n1 2 3 4\n"};
  for (const std::string& data : cell) {
    const Network network = read_network(folder.write("c.vtk", mesh + data));
    const std::vector<std::array<int, 2>> segment = {{0, 1}, {1, 2}, {2, 3}};
    const std::vector<std::array<double, 2>> radius = {{2, 2}, {2, 2}, {3, 3}};
    EXPECT_EQ(network.segment, segment);
    EXPECT_EQ(network.radius, radius);
  }
  const Network tapered =
      read_network(folder.write("p.vtk", mesh +
                                             "POINT_DATA 4\nSCALARS R float 1\nLOOKUP_TABLE t\n"
                                             "1 2 3 4\n" +
                                             kCellRadius));  // POINT_DATA wins
  const std::vector<std::array<double, 2>> radius = {{1, 2}, {2, 3}, {3, 4}};
  EXPECT_EQ(tapered.radius, radius);
  EXPECT_DOUBLE_EQ(total_length(tapered), 3);
}

TEST(ReadNetwork, CellDataCountVerticesFirst) {
  const TempFolder folder;
  const Network network =
      read_network(folder.write("v.vtk", kHeader + kPoints + kLines +
                                             "VERTICES 1 2\n1 0\nCELL_DATA 3\n"
                                             "FIELD FieldData 1\nradius 1 3 float\n9 2 3\n"));
  EXPECT_EQ(network.radius[0][0], 2);
  EXPECT_EQ(network.radius[2][0], 3);
}

std::string binary_file(float nan_or_radius, int last_index) {
  std::string text =
      "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n";
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 2.f, 0.f}) text += big_endian(x);
  text += "\nLINES 2 6\n";
  for (const int i : {2, 0, 1, 2, 1, last_index}) text += big_endian(i);
  text += "\nMETADATA\nINFORMATION 0\n\nPOINT_DATA 3\nFIELD FieldData 1\nradius 1 3 float\n";
  for (const float r : {1.f, 2.f, nan_or_radius}) text += big_endian(r);
  return text + "\n";
}

TEST(ReadNetwork, BinaryIsBigEndianAndErrorsGiveTheByte) {
  const TempFolder folder;
  const Network network = read_network(folder.write("b.vtk", binary_file(3, 2)));
  EXPECT_EQ(network.node[2], Vec3(1, 2, 0));
  EXPECT_EQ(network.radius[1], (std::array<double, 2>{2, 3}));
  const std::string good = binary_file(3, 2);
  EXPECT_CONTAINS(network_refusal(folder.write("n.vtk", binary_file(std::nanf(""), 2))),
                  fmt::format("n.vtk: byte {}: node 2 has \"radius\" nan", good.size() - 5));
  EXPECT_CONTAINS(network_refusal(folder.write("i.vtk", binary_file(3, 70000))),
                  fmt::format("byte {}: line 1 uses node 70000, but the file has 3 points",
                              good.find("\nMETADATA") - 12));
  EXPECT_CONTAINS(network_refusal(folder.write("t.vtk", good.substr(0, 100))), "byte");
  for (std::size_t size = 0; size + 1 < good.size();
       ++size) {  // cut anywhere: an Error, never a crash
    EXPECT_THROW(read_network(folder.write("t.vtk", good.substr(0, size))), Error) << size;
  }
}

TEST(ReadNetwork, SwcKeepsNodesAndTapers) {
  const TempFolder folder;
  const Network network =
      read_network(folder.write("a.swc",
                                "# comment\n10 2 0 0 0 1.5 -1\n\n 7 2 3 4 0 1 10\r\n"
                                "8 2 3 4 5 0.5 7 # end\n"));
  ASSERT_EQ(network.node.size(), 3u);
  const std::vector<std::array<int, 2>> segment = {{0, 1}, {1, 2}};
  const std::vector<std::array<double, 2>> radius = {{1.5, 1}, {1, 0.5}};
  EXPECT_EQ(network.segment, segment);
  EXPECT_EQ(network.radius, radius);
  EXPECT_DOUBLE_EQ(total_length(network), 10);
  const auto swc = [&](const std::string& text) {
    return network_refusal(folder.write("b.swc", text));
  };
  EXPECT_CONTAINS(swc("1 2 0 0 0 1 -1\n2 2 1 0 0 1 5\n"),
                  "b.swc:2: node 2 has the parent 5, which is not in the file");
  EXPECT_CONTAINS(swc("1 2 0 0 0 1 1\n"), "the node itself");
  EXPECT_CONTAINS(swc("1 2 0 0 0 1 -1\n1 2 1 0 0 1 1\n"),
                  "b.swc:2: node 1 is defined a second time");
  EXPECT_CONTAINS(swc("1 2 0 0 0 1 -1\n2 2 1 0\n"), "b.swc:2: the line has 4 columns");
  EXPECT_CONTAINS(swc("1 2 0 x 0 1 -1\n"), "found \"x\" in column 4");
  EXPECT_CONTAINS(swc("1 2 0 0 0 1 -1 9\n"), "found \"9\" in column 8");
  EXPECT_CONTAINS(swc("1 2 0 nan 0 1 -1\n"), "node 1 has the coordinates (0, nan, 0)");
  EXPECT_CONTAINS(swc("1 2 0 0 0 -1 -1\n"), "node 1 has the radius -1");
  EXPECT_CONTAINS(swc("# nothing\n"), "0 nodes but no segment");
}

TEST(ReadNetwork, BadTextFilesAreRefusedWithPlaceAndRemedy) {
  const TempFolder folder;
  const auto vtk = [&](const std::string& text) {
    return network_refusal(folder.write("a.vtk", text));
  };
  const std::string mesh = kHeader + kPoints + kLines;
  EXPECT_CONTAINS(network_refusal(folder.path() + "/none.vtk"), "none.vtk: no such file");
  EXPECT_CONTAINS(network_refusal(folder.path()), "is a folder");
  EXPECT_CONTAINS(network_refusal("/dev/zero"), "a device");
  EXPECT_CONTAINS(network_refusal(folder.write("a.txt", "1 2 3")),
                  "(.vtk), SWC (.swc) and VMV (.vmv), not \".txt\"");
  EXPECT_CONTAINS(vtk(""), "empty");
  EXPECT_CONTAINS(vtk("hello\n"), "a.vtk:1: the first line is \"hello\"");
  EXPECT_CONTAINS(vtk("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n"), "VTK XML");
  EXPECT_CONTAINS(vtk("# vtk DataFile Version 3.0\nt\nTEXT\n"), "a.vtk:3: found \"TEXT\"");
  EXPECT_CONTAINS(vtk("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"),
                  "a.vtk:4: DATASET \"STRUCTURED_POINTS\" cannot be used here; allowed: POLYDATA");
  EXPECT_CONTAINS(vtk(kHeader + "LINES 1 3\n2 0 1\n"), "no POINTS");
  EXPECT_CONTAINS(vtk(kHeader + kPoints + kCellRadius),
                  "a.vtk:8: CELL_DATA says 2 values per array, but the file has 0 cells");
  EXPECT_CONTAINS(vtk(kHeader + kPoints), "no LINES");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 4 float\n0 0 0 1 0 0\n2 0 nan 2 1 0\n"),
                  "a.vtk:7: node 2 has the coordinates (2, 0, nan)");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 1 float\n0 0 1e999\n"),
                  "node 0 has the coordinates (0, 0, inf)");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 1 float\n0 zero 0\n"), "a.vtk:6: found \"zero\"");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 1 string\n0 0 0\n"),
                  "POINTS has data type \"string\"; allowed are float");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 4 float\n0 0 0 1 0 0\n2 0"), "truncated");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS -4 float\n"), "the number of POINTS is -4");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 2000000000 float\n0 0 0\n"), "only 7 bytes follow");
  EXPECT_CONTAINS(vtk(kHeader + "POINTS 99999999999999999999 float\n"),
                  "a whole number, is expected");
  EXPECT_CONTAINS(vtk(kHeader + kPoints + "LINES 1 3\n2 0 4\n" + kCellRadius), "a.vtk:");
  EXPECT_CONTAINS(vtk(kHeader + kPoints + "LINES 2 6\n2 0 1\n2 0 4\n" + kCellRadius),
                  "a.vtk:10: line 1 uses node 4, but the file has 4 points");
  EXPECT_CONTAINS(vtk(kHeader + kPoints + "LINES 2 6\n2 0 1\n9 0 4\n"),
                  "a.vtk:10: cell 1 of LINES has 9 entries");
  EXPECT_CONTAINS(vtk(kHeader + kPoints + "LINES 2 7\n2 0 1\n2 0 3\n1\n"), "its header says 7");
  EXPECT_CONTAINS(vtk(kHeader + kPoints + "LINES 2 6\n2 0 1\n2 2 2\n" + kCellRadius),
                  "joins node 2 to itself");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nSCALARS radius float\nLOOKUP_TABLE default\n2 nan\n"),
                  "a.vtk:14: segment 1 (nodes 2-3) has \"radius\" nan");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nSCALARS radius float\nLOOKUP_TABLE default\n-2 1\n"),
                  "segment 0 (nodes 0-2) has \"radius\" -2; it must be a finite number above 0");
  EXPECT_CONTAINS(
      vtk(mesh + "POINT_DATA 4\nSCALARS diameter float\nLOOKUP_TABLE default\n1 1 0 1\n"),
      "node 2 has \"diameter\" 0");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nSCALARS flow float\nLOOKUP_TABLE default\n2 1\n"
                             "POINT_DATA 4\nFIELD f 1\nage%20d 1 4 int\n1 2 3 4\n"),
                  "no radius array. Arrays found: \"age d\" (POINT_DATA), \"flow\" (CELL_DATA). "
                  "Give every point");
  EXPECT_CONTAINS(vtk(mesh), "Arrays found: none");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nVECTORS radius float\n1 1 1 1 1 1\n"),
                  "has 3 components");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 3\n"),
                  "a.vtk:11: CELL_DATA says 3 values per array, but the file has 2 cells");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nFIELD f 1\nradius 1 3 float\n1 2 3\n"),
                  "has 3 tuples where 2 are expected");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nFIELD f 1\nradius 2000000000 2000000000 float\n1 2 3\n"),
                  "announces");
  EXPECT_CONTAINS(vtk(mesh + "CELL_DATA 2\nFIELD f 2000000000\nradius 1 2 float\n1 2\n"),
                  "the file ends after 1");
  EXPECT_CONTAINS(vtk(mesh + "\x01\x02zz 1 2\n"),
                  "a.vtk:11: found \"??zz\" where a section keyword");
  EXPECT_CONTAINS(
      vtk(kHeader + kPoints +
          "LINES 3 4\nOFFSETS vtktypeint64\n0 2 5\nCONNECTIVITY vtktypeint64\n0 1 1 2\n"),
      "offset 2 of LINES is 5; allowed are 2 to 4");
  const std::string text = mesh + kCellRadius;
  for (std::size_t size = 0; size < text.size() - 2; ++size) {
    EXPECT_THROW(read_network(folder.write("t.vtk", text.substr(0, size))), Error) << size;
  }
}

std::string with_arrays(const std::string& arrays) { return kHeader + kPoints + kLines + arrays; }

TEST(ReadNetwork, RadiiOfVmtkAndMicrovesselChasteAreKnown) {
  const TempFolder folder;
  const std::string point = "POINT_DATA 4\nFIELD f 2\n";
  const auto first = [&](const std::string& arrays, const std::string& name = {}) {
    return read_network(folder.write("a.vtk", with_arrays(arrays)), name).radius[0];
  };
  const std::array<double, 2> tapered{1, 2}, even{2, 2};
  EXPECT_EQ(first(point + "Flow 1 4 float\n9 9 9 9\nMaximumInscribedSphereRadius 1 4 float\n"
                          "1 2 3 4\n"),
            tapered);
  EXPECT_EQ(first(point + "Node%20Radius 1 4 float\n1 2 3 4\nVessel%20Id 1 4 int\n5 6 7 8\n"),
            tapered);
  EXPECT_EQ(first("CELL_DATA 2\nFIELD f 1\nVessel%20Radius 1 2 float\n2 3\n"), even);
  EXPECT_EQ(first("CELL_DATA 2\nFIELD f 1\nmean_radius_um 1 2 float\n2 3\n"), even);
  const std::string both = point +
                           "inner_radius 1 4 float\n1 2 3 4\nouter_radius 1 4 float\n"
                           "5 6 7 8\n";
  EXPECT_CONTAINS(test::message_of([&] { first(both); }), "--vessel-radius-array");
  EXPECT_EQ(first(both, "Inner_Radius"), tapered);
  EXPECT_EQ(
      first(point + "a 1 4 float\n9 9 9 9\nOuterDiameter 1 4 float\n2 4 6 8\n", "OuterDiameter"),
      tapered);
  EXPECT_CONTAINS(test::message_of([&] { first(both, "width"); }),
                  "no array \"width\". Arrays found");
  EXPECT_CONTAINS(test::message_of([&] {
                    read_network(folder.write("a.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 1\n"), "r");
                  }),
                  "for VTK files only");
}

TEST(ReadNetwork, ArraysOfRadiiThatContradictAreNotChosenBetween) {
  const TempFolder folder;
  const auto text = [](const char* diameters) {
    return with_arrays(std::string("POINT_DATA 4\nFIELD f 2\nradius 1 4 float\n1 2 3 4\n"
                                   "diameter 1 4 float\n") +
                       diameters);
  };
  EXPECT_EQ(read_network(folder.write("a.vtk", text("2 4 6 8\n"))).radius[0][1], 2);
  EXPECT_CONTAINS(network_refusal(folder.write("a.vtk", text("2 4 6 6\n"))),
                  "node 3 has the radius 4 by the array \"radius\" and 3 by \"diameter\"");
}

TEST(ReadNetwork, AllRadiiThatAreNoneAreToldAtOnce) {
  const TempFolder folder;
  const std::string vtk = network_refusal(folder.write(
      "a.vtk", with_arrays("POINT_DATA 4\nSCALARS radius float\nLOOKUP_TABLE default\n0 1 nan -2"
                           "\n")));
  EXPECT_CONTAINS(vtk, "node 0 has \"radius\" 0");
  EXPECT_CONTAINS(vtk, "So for 2 more: node 2 (nan), node 3 (-2).");
  const std::string swc = network_refusal(
      folder.write("a.swc", "1 1 0 0 0 0 -1\n2 1 5 0 0 1 1\n3 1 9 0 0 0 2\n4 1 12 0 0 -1 3\n"));
  EXPECT_CONTAINS(swc, "a.swc:1: node 1 has the radius 0");
  EXPECT_CONTAINS(swc, "So for 2 more: node 3 (0), node 4 (-1).");
  EXPECT_CONTAINS(
      network_refusal(folder.write("b.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 9\n3 1 9 0 0 1 9\n")),
      "node 2 has the parent 9, which is not in the file. So for 1 more.");
  EXPECT_CONTAINS(network_refusal(folder.write("c.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1e308 1\n")),
                  "node 2 has the radius 1e+308");
  const std::string vmv = network_refusal(
      folder.write("a.vmv",
                   "$VERT_LIST_BEGIN\n1 0 0 0 0\n2 5 0 0 1\n3 9 0 0 0\n$VERT_LIST_END\n"
                   "$STRANDS_LIST_BEGIN\n1 1 2 3\n$STRANDS_LIST_END\n"));
  EXPECT_CONTAINS(vmv, "So for 1 more: node 3 (0).");
}

TEST(ReadNetwork, StatementsOfHeadersAreFollowedOrRefused) {
  const TempFolder folder;
  const std::string mark = "\xef\xbb\xbf", swc = "1 1 0 0 0 1 -1\n2 1 5 0 0 1 1\n";
  EXPECT_EQ(read_network(folder.write("a.swc", mark + "# SCALE 1.0 1.0 1.0\n" + swc)).node.size(),
            2u);
  EXPECT_CONTAINS(network_refusal(folder.write("a.swc", "# SCALE 0.5 0.5 1\n" + swc)),
                  "a.swc:1: the header says \"# SCALE 0.5 0.5 1\"");
  EXPECT_CONTAINS(network_refusal(folder.write("a.swc", swc + "3 1 9 0 0 1 2")),
                  "the last line has no end");
  EXPECT_CONTAINS(network_refusal(folder.write("a.swc", swc + "# 1 9 0 0 1 2\n")),
                  "a comment holds the numbers of a node");
  EXPECT_CONTAINS(network_refusal(folder.write("b.swc", std::string("\xfe\xff\0#", 4) + swc)),
                  "UTF-16");
  const std::string vmv =
      "$VERT_LIST_BEGIN\n1 0 0 0 2\n2 5 0 0 1\n$VERT_LIST_END\n"
      "$STRANDS_LIST_BEGIN\n1 1 2\n$STRANDS_LIST_END\n";
  EXPECT_EQ(read_network(folder.write("a.vmv", mark + "$NUM_VERTS 2\n" + vmv)).node.size(), 2u);
  EXPECT_CONTAINS(network_refusal(folder.write("a.vmv", "$NUM_VERTS 3\n" + vmv)),
                  "$NUM_VERTS says 3, but the list has 2");
  EXPECT_CONTAINS(network_refusal(folder.write("a.vmv", "$NUM_STRANDS 2\n" + vmv)),
                  "$NUM_STRANDS says 2, but the list has 1");
  EXPECT_EQ(read_network(folder.write("a.vtk", mark + kHeader + kPoints + kLines + kCellRadius))
                .node.size(),
            4u);
}

TEST(ReadNetwork, SectionsInAnotherOrderAreTold) {
  const TempFolder folder;
  const auto vtk = [&](const std::string& text) {
    return network_refusal(folder.write("a.vtk", kHeader + text));
  };
  EXPECT_CONTAINS(vtk("POINT_DATA 4\n" + kPoints + kLines), "a.vtk:5: POINT_DATA stands before");
  EXPECT_CONTAINS(vtk(kPoints + kLines + "SCALARS radius float\nLOOKUP_TABLE default\n1 1 1 1\n"),
                  "a.vtk:11: \"scalars\" stands before POINT_DATA and CELL_DATA");
  EXPECT_CONTAINS(vtk(kPoints + kLines + kPoints), "the section points comes a second time");
  EXPECT_CONTAINS(vtk(kPoints +
                      "POINT_DATA 4\nSCALARS radius float\nLOOKUP_TABLE default\n1 1 1 "
                      "1\n" +
                      kLines),
                  "the section lines stands behind POINT_DATA or CELL_DATA");
  EXPECT_CONTAINS(vtk("POINTS 2 float\n0 0 0 3e24 0 0\n"), "node 1 has the coordinates (3e+24");
}

TEST(ReadNetwork, DamagedFilesNeverCrash) {
  const TempFolder folder;
  std::mt19937 random(1);
  for (const std::string& good : {kHeader + kPoints + kLines + kCellRadius, binary_file(3, 2)}) {
    for (int trial = 0; trial < 500; ++trial) {
      std::string bad = good;
      for (int change = 0; change < 3; ++change)
        bad[random() % bad.size()] = static_cast<char>(random() % 256);
      try {
        read_network(folder.write("d.vtk", bad));
      } catch (const Error&) {
      }
    }
  }
}

}  // namespace
}  // namespace acinus::geometry
