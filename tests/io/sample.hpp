#pragma once
/// Small frames whose every value is a function of (frame, row): tests can predict what must be
/// read back.

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "io/frame.hpp"

namespace acinus::io::test {

/// `n_body` octahedra (6 nodes, 8 triangles each) in a row along x and `n_sphere` spheres above
/// them.
inline Frame make_frame(int k, int n_body, int n_sphere) {
  constexpr float kCorner[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                   {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  constexpr std::int64_t kFace[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  Frame f;
  f.time_s = 60.0 * k;
  f.n_mesh_node = 6 * n_body;
  f.n_sphere = n_sphere;
  for (int b = 0; b < n_body; ++b) {
    for (const auto& c : kCorner) {
      f.point.insert(f.point.end(), {c[0] + 3.0F * static_cast<float>(b), c[1],
                                     c[2] + 0.1F * static_cast<float>(k)});
    }
    for (const auto& face : kFace)
      f.triangle.push_back({6 * b + face[0], 6 * b + face[1], 6 * b + face[2]});
  }
  for (int s = 0; s < n_sphere; ++s)
    f.point.insert(f.point.end(), {3.0F * static_cast<float>(s), 0, 10});
  const int n_point = 6 * n_body + n_sphere, n_cell = 8 * n_body + n_sphere;
  Field force{"force", "nN", 3, {}}, radius{"radius", "um", 1, {}},
      pressure{"pressure", "kPa", 1, {}};
  for (int p = 0; p < n_point; ++p) {
    for (int i = 0; i < 3; ++i)
      force.value.push_back(static_cast<float>(k + p) + 0.25F * static_cast<float>(i));
  }
  for (int c = 0; c < n_cell; ++c) {
    const bool sphere = c >= 8 * n_body;
    f.cell_id.push_back(sphere ? 1000 + c - 8 * n_body : c / 8);
    f.kind.push_back(sphere ? 1 : 0);
    radius.value.push_back(sphere ? 1.5F : 0.0F);
    pressure.value.push_back(static_cast<float>(1000 * k + c));
  }
  f.point_data = {force};
  f.cell_data = {radius, pressure};
  IdColumn id{"id", {}};
  Column volume{"volume", "um^3", 1, {}}, stress{"stress", "kPa", 6, {}};
  for (int c = 0; c < n_body + n_sphere; ++c) {
    id.value.push_back(c < n_body ? c : 1000 + c - n_body);
    volume.value.push_back(k + 0.5 * c);
    for (int i = 0; i < 6; ++i) stress.value.push_back(k + c + 0.1 * i);
  }
  f.cells = {{id}, {volume, stress}};
  IdColumn dcm{"dcm_id", {}}, cbm{"cbm_id", {}};
  Column gap{"gap", "um", 1, {}};
  for (int i = 0; i < std::min(n_body, n_sphere); ++i) {
    dcm.value.push_back(i);
    cbm.value.push_back(1000 + i);
    gap.value.push_back(-0.01 * (i + k));
  }
  f.interface = {{dcm, cbm}, {gap}};
  IdColumn a{"a", {}}, b{"b", {}};
  Column area{"area_a", "um^2", 1, {}}, pair_force{"force", "nN", 3, {}};
  for (int i = 0; i + 1 < n_body; ++i) {
    a.value.push_back(i);
    b.value.push_back(i + 1);
    area.value.push_back(i + 0.5 * k);
    for (int c = 0; c < 3; ++c) pair_force.value.push_back(k - 0.1 * c);
  }
  f.contacts = {{a, b}, {area, pair_force}};
  return f;
}

/// Frame k of a run whose cell numbers change; some frames have no bodies, some no spheres, one is
/// empty.
inline Frame changing_frame(int k) {
  constexpr int kBody[8] = {2, 2, 0, 3, 3, 0, 700, 4}, kSphere[8] = {3, 3, 4, 0, 5, 0, 200, 1};
  return make_frame(k, kBody[k % 8], kSphere[k % 8]);
}

/// Name in the folder of temporary files.
inline std::string path(const char* name) {
  return (std::filesystem::temp_directory_path() / (name + std::to_string(getpid()))).string();
}

/// Fresh folder for one test, removed at the end.
struct Folder {
  explicit Folder(const std::string& name)
      : path((std::filesystem::temp_directory_path() / (name + "_" + std::to_string(getpid())))
                 .string()) {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::string operator/(const std::string& file) const { return path + "/" + file; }
  std::string path;
};

}  // namespace acinus::io::test
