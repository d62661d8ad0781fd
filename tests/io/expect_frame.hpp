#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "io/frame.hpp"

namespace acinus::io::test {

inline void expect_same_table(Table a, Table b) {
  const auto by_name = [](const auto& x, const auto& y) { return x.name < y.name; };
  for (Table* t : {&a, &b}) {
    std::sort(t->ids.begin(), t->ids.end(), by_name);
    std::sort(t->columns.begin(), t->columns.end(), by_name);
  }
  ASSERT_EQ(a.ids.size(), b.ids.size());
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.ids.size(); ++i) {
    EXPECT_EQ(a.ids[i].name, b.ids[i].name);
    EXPECT_EQ(a.ids[i].value, b.ids[i].value) << a.ids[i].name;
  }
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    EXPECT_EQ(a.columns[i].name, b.columns[i].name);
    EXPECT_EQ(a.columns[i].unit, b.columns[i].unit);
    EXPECT_EQ(a.columns[i].components, b.columns[i].components);
    EXPECT_EQ(a.columns[i].value, b.columns[i].value) << a.columns[i].name;
  }
}

inline void expect_same_fields(std::vector<Field> a, std::vector<Field> b) {
  const auto by_name = [](const Field& x, const Field& y) { return x.name < y.name; };
  std::sort(a.begin(), a.end(), by_name);
  std::sort(b.begin(), b.end(), by_name);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].unit, b[i].unit);
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_EQ(a[i].value, b[i].value) << a[i].name;
  }
}

/// Equal in every bit; the order of fields does not count.
inline void expect_same_frame(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.n_mesh_node, b.n_mesh_node);
  EXPECT_EQ(a.n_sphere, b.n_sphere);
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.cell_id, b.cell_id);
  EXPECT_EQ(a.kind, b.kind);
  expect_same_fields(a.point_data, b.point_data);
  expect_same_fields(a.cell_data, b.cell_data);
  expect_same_table(a.cells, b.cells);
  expect_same_table(a.interface, b.interface);
  expect_same_table(a.contacts, b.contacts);
}

}  // namespace acinus::io::test
