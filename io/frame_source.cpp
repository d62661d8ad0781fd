#include "io/frame_source.hpp"

namespace acinus::io {
namespace {

std::vector<Field> without_values(const std::vector<Field>& fields) {
  std::vector<Field> names;
  for (const Field& f : fields) names.push_back({f.name, f.unit, f.components, {}});
  return names;
}

template <class T>
void append(std::vector<T>& to, std::span<const T> values) {
  to.insert(to.end(), values.begin(), values.end());
}

void append(std::vector<Field>& fields, const std::vector<std::span<const float>>& data) {
  for (std::size_t k = 0; k < fields.size(); ++k) append(fields[k].value, data[k]);
}

}  // namespace

FrameSource source_of(const Frame& frame) {
  FrameSource s;
  s.time_s = frame.time_s;
  s.n_mesh_node = frame.n_mesh_node;
  s.n_sphere = frame.n_sphere;
  s.n_triangle = std::ssize(frame.triangle);
  s.point_data = without_values(frame.point_data);
  s.cell_data = without_values(frame.cell_data);
  static_cast<FrameTables&>(s) = frame;
  s.points = [&frame](const auto& take) {
    PointRows rows{frame.point, {}};
    for (const Field& f : frame.point_data) rows.data.emplace_back(f.value);
    take(rows);
  };
  s.surfaces = [&frame](const auto& take) {
    const std::size_t n = frame.triangle.size();
    const auto part = [&frame](auto f) {  // f(values, components): a part of them
      CellRows rows{{}, f(std::span(frame.cell_id), 1), f(std::span(frame.kind), 1), {}};
      for (const Field& field : frame.cell_data)
        rows.data.push_back(f(std::span(field.value), field.components));
      return rows;
    };
    CellRows triangles = part([n](auto all, int components) { return all.first(n * components); });
    triangles.triangle = frame.triangle;
    if (n > 0) take(triangles);
    if (frame.n_sphere > 0)
      take(part([n](auto all, int components) { return all.subspan(n * components); }));
  };
  return s;
}

Frame collect(const FrameSource& s) {
  Frame f;
  f.time_s = s.time_s;
  f.n_mesh_node = s.n_mesh_node;
  f.n_sphere = s.n_sphere;
  f.point_data = s.point_data;
  f.cell_data = s.cell_data;
  static_cast<FrameTables&>(f) = s;
  s.points([&f](const PointRows& rows) {
    append(f.point, rows.point);
    append(f.point_data, rows.data);
  });
  s.surfaces([&f](const CellRows& rows) {
    append(f.triangle, rows.triangle);
    append(f.cell_id, rows.cell_id);
    append(f.kind, rows.kind);
    append(f.cell_data, rows.data);
  });
  return f;
}

}  // namespace acinus::io
