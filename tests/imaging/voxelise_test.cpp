#include "imaging/voxelise.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "core/parallel/threads.hpp"
#include "geometry/measures.hpp"
#include "geometry/topology.hpp"
#include "imaging/pieces.hpp"
#include "tests/reference/brick.hpp"

namespace acinus::imaging {
namespace {

geometry::Surface ball(const Vec3& center, double radius) {
  const geometry::Topology& t = geometry::shared_icosphere(162);
  geometry::Surface s;
  s.triangle = t.triangle;
  for (const Vec3& x : t.rest) s.node.push_back(center + radius * x);
  return s;
}

TEST(Voxelise, PaintsWhatIsInside) {
  const std::vector<geometry::Surface> bodies{ball({1, 2, 3}, 5), ball({9, 2, 3}, 4)};
  Voxelise how;
  how.voxel = Vec3(0.5, 0.4, 0.6);
  const VoxelisedBodies made = voxelise(bodies, how);
  const LabelImage& image = made.image;
  const auto body_at = [&](const Vec3& p) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (geometry::is_inside(p, bodies[b].node, bodies[b].triangle))
        return static_cast<Label>(b + 1);
    return Label{0};
  };
  // At the corners of all voxels, then at their centres.
  const auto places = [&](const Voxel& n, double shift) {
    std::vector<Label> label;
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x)
          label.push_back(
              body_at(made.corner + how.voxel.cwiseProduct(Vec3(x + shift, y + shift, z + shift))));
    return label;
  };
  LabelImage corners = image;
  for (int& n : corners.size) ++n;
  corners.label = places(corners.size, 0);
  const std::vector<Label> center = places(image.size, 0.5);
  std::size_t wrong = 0, whole = 0;
  for (int z = 0; z < image.size[2]; ++z)
    for (int y = 0; y < image.size[1]; ++y)
      for (int x = 0; x < image.size[0]; ++x) {
        const std::size_t at = image.index({x, y, z});
        std::set<Label> seen{center[at]};
        for (int k = 0; k < 8; ++k)
          seen.insert(corners.label[corners.index({x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)})]);
        whole += seen.size() == 1;
        wrong += !seen.contains(image.label[at]);
      }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(whole, image.label.size() / 2);
  std::array<double, 3> volume{};
  for (const Label l : image.label) volume[l] += image.voxel_volume();
  for (std::size_t b = 0; b < 2; ++b) {
    const double exact = geometry::compute_volume(bodies[b].node, bodies[b].triangle);
    EXPECT_NEAR(volume[b + 1], exact,
                (b == 0 ? 0.01 : 0.03) * exact);  // the first had its voxels first
  }
}

/// Faces of tissue between walls lie along the lattice: a picture's noise decides which voxels of
/// the layer cut by one are inside, each or none.
TEST(Voxelise, WithNoiseKeepsTheVolumeBetweenFacesAlongTheLattice) {
  const Vec3 side(14, 15, 16);
  for (const double more : {0.2, 0.4, 0.6, 0.8}) {
    const geometry::Surface s = reference::brick(Vec3::Zero(), side + Vec3::Constant(more));
    const double exact = geometry::compute_volume(s.node, s.triangle);
    Voxelise how;
    how.blur = 0.4;
    how.noise = 0.3;
    double volume = 0;
    for (const Label l : voxelise(std::vector{s}, how).image.label) volume += l;
    EXPECT_NEAR(volume, exact, 0.025 * exact) << more;  // centres alone: up to 0.08
  }
}

TEST(Voxelise, WithNoiseHasRaggedWallsAndTheSameVoxelsOnAnyThreads) {
  const std::vector<geometry::Surface> bodies{ball({0, 0, 0}, 6), ball({11.5, 0, 0}, 6)};
  Voxelise how;
  how.blur = 0.7;
  how.noise = 0.4;
  std::vector<std::vector<Label>> found;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    found.push_back(voxelise(bodies, how).image.label);
  }
  set_threads(1);
  EXPECT_EQ(found[0], found[1]);
  how.seed = 2;
  const LabelImage other = voxelise(bodies, how).image;
  EXPECT_NE(other.label, found[0]);
  how.noise = 0;
  const LabelImage smooth = voxelise(bodies, how).image;
  std::size_t differ = 0, any = 0;
  for (std::size_t k = 0; k < smooth.label.size(); ++k) {
    differ += smooth.label[k] != other.label[k];
    any += smooth.label[k] != 0;
  }
  EXPECT_GT(differ, 20u);
  EXPECT_LT(differ, any / 5);
}

}  // namespace
}  // namespace acinus::imaging
