/// Fields of substances in pages of `acinus report`: what is packed, thinned, missing or damaged.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/field_file.hpp"
#include "io/run_file.hpp"
#include "service/report/frames.hpp"
#include "service/report/packed_fields.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::service {
namespace {
namespace fs = std::filesystem;
using io::test::Folder;

/// Field that rises along x, on a grid of these voxels.
io::FieldFrame make_fields(double time_s, std::array<int, 3> n) {
  io::FieldFrame frame{time_s, Vec3(-10, 0, 5), Vec3(2, 3, 4), n, {{"oxygen", "mmHg", {}}}};
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        frame.field[0].value.push_back(static_cast<float>(i + 10 * time_s));
  return frame;
}

/// Run folder with frames at 0, 60, 120 ... s and their fields.
std::string write_run(const Folder& f, int n_frame, std::array<int, 3> n) {
  const std::string folder = f / "a.run";
  fs::create_directories(folder);
  io::RunFile file = io::RunFile::create(folder + "/run.vtkhdf", {});
  io::FieldFiles fields(folder, {}, true);
  for (int k = 0; k < n_frame; ++k) {
    file.append(io::test::make_frame(k, 2, 1));
    fields.append(make_fields(io::test::make_frame(k, 2, 1).time_s, n));
  }
  file.close();
  return folder;
}

TEST(FieldFiles, ComeBackFromTheirFiles) {
  const Folder f("fields");
  const std::string folder = write_run(f, 2, {5, 4, 3});
  const auto read = io::read_fields(folder, 1);
  ASSERT_TRUE(read);
  const io::FieldFrame written = make_fields(read->time_s, {5, 4, 3});
  EXPECT_EQ(read->n, written.n);
  EXPECT_LT((read->origin - written.origin).norm(), 1e-12);
  EXPECT_EQ(read->spacing, written.spacing);
  ASSERT_EQ(read->field.size(), 1U);
  EXPECT_EQ(read->field[0].name, "oxygen");
  EXPECT_EQ(read->field[0].unit, "mmHg");
  EXPECT_EQ(read->field[0].value, written.field[0].value);
  EXPECT_FALSE(io::read_fields(folder, 2));
}

TEST(ReportFields, AreThinnedToMeansOfBlocks) {
  const io::FieldFrame frame = make_fields(0, {10, 9, 7});
  const PackedGrid whole = make_packed_grid(frame, 630);
  EXPECT_EQ(whole.n, frame.n);
  EXPECT_EQ(whole.spacing, frame.spacing);
  const PackedGrid thin = make_packed_grid(frame, 60);
  EXPECT_EQ(thin.n, (std::array{4, 3, 3}));
  EXPECT_EQ(thin.size, Vec3(20, 27, 28));
  EXPECT_EQ(thin.spacing, Vec3(6, 9, 12));
  io::FieldFrame other = make_fields(0, {10, 9, 8});
  EXPECT_THROW(pack_fields(thin, other), Error);
  EXPECT_LT(pack_fields(thin, frame).size(), 4 * 36U);
}

TEST(ReportFields, OfASmallerBoxReachTheWholeGrid) {
  const io::FieldFrame wide = make_fields(0, {6, 5, 4});
  io::FieldFrame narrow = make_fields(0, {3, 5, 4});
  narrow.origin.x() += 2 * wide.spacing.x();
  const PackedGrid grid = make_packed_grid(wide, 1000);
  // Its values 0, 1, 2 begin at the third voxel, and go on beyond its faces.
  io::FieldFrame expected = wide;
  for (std::size_t v = 0; v < expected.field[0].value.size(); ++v)
    expected.field[0].value[v] = std::array<float, 6>{0, 0, 0, 1, 2, 2}[v % 6];
  EXPECT_EQ(pack_fields(grid, narrow), pack_fields(grid, expected));
  narrow.origin.x() += 0.5;
  EXPECT_THROW(pack_fields(grid, narrow), Error);
}

TEST(ReportFields, AreThoseOfTheFrames) {
  const Folder f("report_fields");
  const std::string folder = write_run(f, 3, {8, 8, 8});
  RunRecord run = read_run_record(folder);
  const PackedRun packed = pack_frames(run, {});
  EXPECT_TRUE(run.damage.empty()) << run.damage[0];
  EXPECT_EQ(packed.grid.name, std::vector<std::string>{"oxygen"});
  EXPECT_EQ(packed.grid.n, (std::array{8, 8, 8}));
  for (const PackedFrame& frame : packed.frame) EXPECT_FALSE(frame.fields.empty());
}

TEST(ReportFields, DoNotCrowdOutFrames) {
  const Folder f("report_fields_limit");
  const std::string folder = write_run(f, 20, {60, 60, 60});
  RunRecord run = read_run_record(folder);
  const PackedRun packed = pack_frames(run, {.most_frames = 50, .bytes = 400'000});
  EXPECT_EQ(packed.frame.size(), 20U);
  EXPECT_LE(packed.bytes(), 400'000U);
  EXPECT_LT(packed.grid.n[0], 60);
}

TEST(ReportFields, DamagedMissingAndForeignOnesAreLeftOut) {
  const Folder f("report_fields_damage");
  const std::string folder = write_run(f, 4, {8, 8, 8});
  const auto file = [&](int k) { return fmt::format("{}/fields/frame_{:06d}.vtkhdf", folder, k); };
  fs::resize_file(file(0), 700);
  fs::remove(file(1));
  fs::copy_file(file(3), file(2), fs::copy_options::overwrite_existing);  // of another time
  RunRecord run = read_run_record(folder);
  PackedRun packed = pack_frames(run, {});
  ASSERT_EQ(packed.frame.size(), 4U);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(packed.frame[k].fields.empty());
  EXPECT_FALSE(packed.frame[3].fields.empty());
  ASSERT_EQ(run.damage.size(), 2U);
  EXPECT_CONTAINS(run.damage[0], "fields of frame 0: ");
  EXPECT_CONTAINS(run.damage[1], "fields of frame 2: they are of t = ");
  // Links are not followed.
  fs::remove(file(3));
  fs::create_symlink(file(2), file(3));
  run = read_run_record(folder);
  EXPECT_TRUE(pack_frames(run, {}).frame[3].fields.empty());
}

}  // namespace
}  // namespace acinus::service
