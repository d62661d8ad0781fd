#include "io/run_file.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/hdf5.hpp"
#include "io/run_reader.hpp"
#include "tests/io/expect_frame.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::io {
namespace {

using test::changing_frame;
using test::expect_same_frame;
using test::Folder;
using test::make_frame;

/// Source of a frame that hands over a few rows at a time.
FrameSource in_parts(const Frame& frame, std::size_t n_row) {
  FrameSource whole = source_of(frame), parts = whole;
  const auto cut = [](auto rows, std::size_t first, std::size_t n, std::size_t components) {
    return rows.subspan(first * components, n * components);
  };
  parts.points = [=, &frame](const auto& take) {
    whole.points([&](const PointRows& all) {
      const std::size_t total = all.point.size() / 3;
      for (std::size_t k = 0; k < total; k += n_row) {
        const std::size_t n = std::min(n_row, total - k);
        PointRows rows{cut(all.point, k, n, 3), {}};
        for (std::size_t f = 0; f < all.data.size(); ++f)
          rows.data.push_back(cut(all.data[f], k, n, frame.point_data[f].components));
        take(rows);
      }
    });
  };
  parts.surfaces = [=, &frame](const auto& take) {
    whole.surfaces([&](const CellRows& all) {
      for (std::size_t k = 0; k < all.cell_id.size(); k += n_row) {
        const std::size_t n = std::min(n_row, all.cell_id.size() - k);
        CellRows rows{{}, cut(all.cell_id, k, n, 1), cut(all.kind, k, n, 1), {}};
        if (!all.triangle.empty()) rows.triangle = cut(all.triangle, k, n, 1);
        for (std::size_t f = 0; f < all.data.size(); ++f)
          rows.data.push_back(cut(all.data[f], k, n, frame.cell_data[f].components));
        take(rows);
      }
    });
  };
  return parts;
}

std::vector<SeriesValue> sample(double time) {
  return {{"time", "s", time}, {"dt", "s", 0.5 * time}};
}

/// Frames 0..n-1, 7 samples and 2 events per frame.
void write_run(RunFile* run, int first, int n) {
  for (int k = first; k < first + n; ++k) {
    for (int i = 0; i < 7; ++i) run->append_series(sample(7 * k + i));
    run->append_event({1.0 * k, "division", {k, k + 1}, "cell " + std::to_string(k) + " divided"});
    run->append_event({1.0 * k, "note", {}, ""});
    run->append(changing_frame(k));
  }
}

void expect_run(const std::string& path, int n) {
  const RunReader reader(path);
  ASSERT_EQ(reader.n_frame(), n);
  for (int k = 0; k < n; ++k) expect_same_frame(reader.frame(k), changing_frame(k));
  const auto series = reader.series();
  ASSERT_EQ(std::ssize(series.at("time")), 7 * n);
  for (int i = 0; i < 7 * n; ++i) {
    EXPECT_EQ(series.at("time")[i], i);
    EXPECT_EQ(series.at("dt")[i], 0.5 * i);
  }
  const auto event = reader.events();
  ASSERT_EQ(std::ssize(event), 2 * n);
  for (int k = 0; k < n; ++k) {
    const Event& e = event[2 * k];
    EXPECT_EQ(e.code, "division");
    EXPECT_EQ(e.cell_id, (std::vector<std::int64_t>{k, k + 1}));
    EXPECT_EQ(e.message, "cell " + std::to_string(k) + " divided");
    EXPECT_TRUE(event[2 * k + 1].cell_id.empty());
  }
}

void expect_error(Exit code, const std::string& part, const std::function<void()>& action) {
  EXPECT_CONTAINS(acinus::test::message_of(action, code), part);
}

class RunFileTest : public testing::TestWithParam<bool> {};

TEST_P(RunFileTest, ReadsBackFramesWithChangingNumbersOfCells) {
  const Folder folder("run_file_back");
  RunFile run =
      RunFile::create(folder / "run.vtkhdf", {{"seed", "1"}, {"empty", ""}}, {GetParam(), 5});
  write_run(&run, 0, 17);
  run.set_provenance("end", "today");
  run.set_provenance("seed", "22");
  run.close();
  expect_run(folder / "run.vtkhdf", 17);
  EXPECT_EQ(RunReader(folder / "run.vtkhdf").provenance(),
            (std::map<std::string, std::string>{{"empty", ""}, {"end", "today"}, {"seed", "22"}}));
}

TEST_P(RunFileTest, TruncatesAndContinuesAsIfNeverInterrupted) {
  const Folder folder("run_file_cut");
  const std::string path = folder / "run.vtkhdf";
  constexpr int kFrame = 30;  // so many that some chunks of Types are padding only
  RunFileCounts at[kFrame];
  {
    RunFile run = RunFile::create(path, {{"seed", "1"}}, {GetParam(), 5});
    for (int k = 0; k < kFrame; ++k) {
      write_run(&run, k, 1);
      at[k] = run.counts();
    }
  }
  for (const int keep :
       {kFrame, 27, 22, 7, 6, 3, 1}) {  // after frames of every kind, the empty one included
    RunFile run = RunFile::open_for_append(path, at[keep - 1]);
    EXPECT_EQ(run.n_frame(), keep);
    expect_run(path, keep);
    write_run(&run, keep, kFrame - keep);
    run.close();
    expect_run(path, kFrame);
  }
  RunFile run = RunFile::open_for_append(path, {});
  write_run(&run, 0, 2);
  run.close();
  expect_run(path, 2);
  EXPECT_EQ(RunReader(path).provenance().at("seed"), "1");
  EXPECT_FALSE(std::filesystem::exists(path + ".tmp"));
}

INSTANTIATE_TEST_SUITE_P(Compression, RunFileTest, testing::Bool(),
                         [](const auto& set) { return std::string(set.param ? "fast" : "none"); });

TEST(RunFile, FramesInPartsAreThoseInOne) {
  const Folder folder("run_file_parts");
  constexpr int kBodies = 5000, kSpheres = 3000;  // several chunks of every array
  for (const bool compress : {true, false}) {
    const std::string path = folder / (compress ? "compressed" : "plain");
    {
      RunFile run = RunFile::create(path, {}, {.compress = compress});
      for (const int k : {0, 1, 2}) {
        const Frame frame = make_frame(k, kBodies + (k == 2 ? 1 : 0), kSpheres);
        run.append(in_parts(frame, 777));
      }
    }
    const RunReader reader(path);
    for (const int k : {0, 1, 2})
      expect_same_frame(reader.frame(k), make_frame(k, kBodies + (k == 2 ? 1 : 0), kSpheres));
  }
}

TEST(RunFile, RefusesPartsThatDoNotFit) {
  const Folder folder("run_file_refused");
  RunFile run = RunFile::create(folder / "run", {});
  const Frame frame = make_frame(1, 2, 1);
  const auto refuse = [&](const std::string& part, const std::function<void(FrameSource&)>& spoil) {
    FrameSource source = in_parts(frame, 3);
    spoil(source);
    expect_error(Exit::kInternal, part, [&] { run.append(source); });
    EXPECT_EQ(run.n_frame(), 0);
  };
  refuse("13 of 14 points", [](FrameSource& s) { ++s.n_mesh_node; });
  refuse("kinds for 1 triangles", [](FrameSource& s) { --s.n_triangle; });
  run.append(in_parts(frame, 3));
  EXPECT_EQ(run.n_frame(), 1);
}

TEST(RunFile, SamplesBetweenFramesSurviveARestart) {
  const Folder folder("run_file_between");
  const std::string path = folder / "run.vtkhdf";
  RunFileCounts keep;
  {
    RunFile run = RunFile::create(path, {});
    run.append(make_frame(0, 1, 1));
    for (int i = 0; i < 5; ++i) run.append_series(sample(i));
    keep = run.counts();
    EXPECT_EQ(keep.series, 5);
    run.flush();
    for (int i = 5; i < 9; ++i) run.append_series(sample(i));
  }
  RunFile run = RunFile::open_for_append(path, keep);
  run.append_series(sample(50));
  run.close();
  EXPECT_EQ(RunReader(path).series().at("time"), (std::vector<double>{0, 1, 2, 3, 4, 50}));
}

/// Observables of frame k.
std::vector<SeriesValue> observed(int k) {
  return {{"time", "s", 60.0 * k}, {"cells", "1", 3.0 + k}, {"area", "um^2", 0.25 * k * k}};
}

std::vector<double> column(const RunReader& reader, const std::string& name) {
  return reader.observables().at(name);
}

TEST(RunFile, ObservablesAreReadableBetweenFrames) {
  const Folder folder("run_file_observed");
  const std::string path = folder / "run.vtkhdf";
  RunFile run = RunFile::create(path, {});
  run.append(make_frame(0, 1, 1));  // of the start-up: nothing is measured yet
  EXPECT_TRUE(RunReader(path).observables().empty());
  for (int k = 1; k < 5; ++k) {
    run.append(make_frame(k, 1, 1), observed(k));
    const RunReader reader(path);  // a second handle, while the writer lives
    ASSERT_EQ(reader.counts().observable, k);
    EXPECT_EQ(column(reader, "time").back(), 60.0 * k);
    EXPECT_EQ(column(reader, "area").back(), 0.25 * k * k);
    EXPECT_EQ(reader.observable_unit().at("area"), "um^2");
  }
}

TEST(RunFile, ObservablesAreCutBackAndGoOn) {
  const Folder folder("run_file_observed_cut");
  const std::string path = folder / "run.vtkhdf";
  RunFileCounts at[6];
  {
    RunFile run = RunFile::create(path, {});
    for (int k = 0; k < 6; ++k) {
      run.append(make_frame(k, 1, 1),
                 k < 2 ? std::vector<SeriesValue>{} : observed(k));  // two of the start-up
      at[k] = run.counts();
    }
  }
  for (const int keep : {6, 4, 3, 1}) {
    RunFile run = RunFile::open_for_append(path, at[keep - 1]);
    EXPECT_EQ(RunReader(path).counts().observable, std::max(0, keep - 2));
    for (int k = keep; k < 6; ++k)
      run.append(make_frame(k, 1, 1), k < 2 ? std::vector<SeriesValue>{} : observed(k));
    run.close();
    EXPECT_EQ(column(RunReader(path), "cells"), (std::vector<double>{5, 6, 7, 8}));
  }
}

TEST(RunFile, RefusesObservablesThatAreNotFiniteOrChange) {
  const Folder folder("run_file_observed_bad");
  const std::string path = folder / "run.vtkhdf";
  RunFile run = RunFile::create(path, {});
  run.append(make_frame(1, 1, 1), observed(1));
  std::vector<SeriesValue> bad = observed(2);
  bad[1].value = std::numeric_limits<double>::infinity();
  expect_error(Exit::kInternal, "\"cells\" is inf", [&] { run.append(make_frame(2, 1, 1), bad); });
  bad = observed(2);
  bad.pop_back();
  // The columns of a file are those of the version that began it.
  expect_error(Exit::kCannotContinue, "has \"area\" where this program records no more",
               [&] { run.append(make_frame(2, 1, 1), bad); });
  run.append(make_frame(2, 1, 1), observed(2));
  const RunReader reader(path);
  EXPECT_EQ(reader.n_frame(), 2);
  EXPECT_EQ(column(reader, "cells"), (std::vector<double>{4, 5}));
}

TEST(RunFile, RefusesToContinueWhatIsNotThere) {
  const Folder folder("run_file_short");
  const std::string path = folder / "run.vtkhdf";
  RunFile::create(path, {}).append(make_frame(0, 1, 1));
  expect_error(Exit::kFileError, "holds 1 frames", [&] {
    RunFile::open_for_append(path, {2, 0, 0});
  });
  expect_error(Exit::kFileError, "cannot open for writing: No such file",
               [&] { RunFile::open_for_append(folder / "none.vtkhdf", {}); });
  write_text_file(folder / "text.vtkhdf", "not HDF5");
  expect_error(Exit::kFileError, "cannot open for writing",
               [&] { RunFile::open_for_append(folder / "text.vtkhdf", {}); });
}

TEST(RunFile, UnchangedTopologyIsWrittenOnce) {
  const Folder folder("run_file_static");
  RunFile run = RunFile::create(folder / "run.vtkhdf", {});
  // 4000 octahedra: 32000 triangles; random coordinates would hide the effect, these are enough.
  run.append(make_frame(0, 4000, 0));
  const auto first = std::filesystem::file_size(folder / "run.vtkhdf");
  run.append(make_frame(1, 4000, 0));
  const auto second = std::filesystem::file_size(folder / "run.vtkhdf") - first;
  std::printf("first frame %zu bytes, second %zu bytes\n", static_cast<std::size_t>(first),
              static_cast<std::size_t>(second));
  const RunReader reader(folder / "run.vtkhdf");
  expect_same_frame(reader.frame(0), make_frame(0, 4000, 0));
  expect_same_frame(reader.frame(1), make_frame(1, 4000, 0));
}

TEST(RunFile, NothingThatIsNotFiniteReachesTheFile) {
  const Folder folder("run_file_nan");
  const std::string path = folder / "run.vtkhdf";
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  RunFile run = RunFile::create(path, {});
  run.append(make_frame(0, 1, 1));
  const std::string before = read_text_file(path);
  const auto refuse = [&](const std::string& part, const std::function<void(Frame&)>& spoil) {
    Frame frame = make_frame(1, 1, 1);
    spoil(frame);
    expect_error(Exit::kInternal, part, [&] { run.append(frame); });
  };
  refuse("point coordinates: value 4 of 21 is nan", [&](Frame& f) { f.point[4] = nan; });
  refuse("\"force\"", [&](Frame& f) { f.point_data[0].value[2] = -inf; });
  refuse("\"pressure\"", [&](Frame& f) { f.cell_data[1].value[8] = nan; });
  refuse("\"stress\"", [&](Frame& f) { f.cells.columns[1].value[3] = inf; });
  refuse("\"gap\"", [&](Frame& f) { f.interface.columns[0].value[0] = nan; });
  refuse("time is nan", [&](Frame& f) { f.time_s = nan; });
  expect_error(Exit::kInternal, "series \"dt\" is nan", [&] {
    const std::vector<SeriesValue> value{{"time", "s", 0}, {"dt", "s", nan}};
    run.append_series(value);
  });
  expect_error(Exit::kInternal, "event time is inf", [&] { run.append_event({inf, "x", {}, ""}); });
  run.close();
  EXPECT_TRUE(read_text_file(path) == before);
}

TEST(RunFile, FramesMustFitTogether) {
  const Folder folder("run_file_fit");
  RunFile run = RunFile::create(folder / "run.vtkhdf", {});
  run.append(make_frame(0, 1, 1));
  const auto refuse = [&](const std::string& part, const std::function<void(Frame&)>& spoil) {
    Frame frame = make_frame(1, 1, 1);
    spoil(frame);
    expect_error(Exit::kInternal, part, [&] { run.append(frame); });
  };
  refuse("does not come after", [](Frame& f) { f.time_s = 0; });
  refuse("point data changed", [](Frame& f) { f.point_data.clear(); });
  refuse("cell data changed", [](Frame& f) { f.cell_data[0].unit = "m"; });
  refuse("/cells columns changed", [](Frame& f) { f.cells.columns.pop_back(); });
  refuse("given twice", [](Frame& f) { f.cell_data[0].name = "kind"; });
  refuse("cannot be the name", [](Frame& f) { f.cell_data[0].name = "a/b"; });
  refuse("uses node 6 of 6", [](Frame& f) { f.triangle[0][1] = 6; });
  refuse("rows of 3 are needed", [](Frame& f) { f.point_data[0].value.pop_back(); });
  refuse("cell ids", [](Frame& f) { f.cell_id.pop_back(); });
  refuse("has no unit", [](Frame& f) { f.cell_data[0].unit = ""; });
  run.append(make_frame(1, 1, 1));
  run.append_series(sample(0));
  const std::vector<SeriesValue> other{{"time", "s", 1}};
  expect_error(Exit::kCannotContinue, "begun by another version",
               [&] { run.append_series(other); });
}

/// Shapes and indices that only damage can make: none may lead out of an array.
TEST(RunFile, ShapesAndCornersThatDoNotFitAreDamage) {
  const Folder folder("run_shapes");
  const std::string path = folder / "run.vtkhdf";
  const auto replace = [&](const std::string& name, hsize_t rows, hsize_t width,
                           std::int64_t value) {
    RunFile run = RunFile::create(path, {{"seed", "1"}});
    for (int k = 0; k < 2; ++k) run.append(make_frame(k, 1, 1));
    run.append_event({0, "note", {1}, ""});
    run.close();
    h5::File file = h5::File::open(path, h5::Access::kAppend);
    ASSERT_GE(H5Ldelete(file.id(), name.c_str(), H5P_DEFAULT), 0);
    const hsize_t dims[2] = {rows, width};
    const hid_t space = H5Screate_simple(width == 1 ? 1 : 2, dims, nullptr);
    const hid_t data = H5Dcreate2(file.id(), name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT);
    const std::vector<std::int64_t> values(rows * width, value);
    H5Dwrite(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(data);
    H5Sclose(space);
    file.close();
  };
  const auto read = [&] {
    const RunReader reader(path);
    for (int k = 0; k < reader.n_frame(); ++k) reader.frame(k);
    reader.events();
  };
  // A sphere is a point, but no corner.
  const std::int64_t sphere = make_frame(0, 1, 1).n_mesh_node;
  replace("/VTKHDF/Steps/PartOffsets", 2, 0, 0);
  expect_error(Exit::kFileError, "no rows", read);
  const auto claim = [&](hsize_t rows) {  // none of them is stored
    h5::File file = h5::File::open(path, h5::Access::kAppend);
    ASSERT_GE(H5Ldelete(file.id(), "/VTKHDF/NumberOfPoints", H5P_DEFAULT), 0);
    const hsize_t chunk = 64;
    const hid_t space = H5Screate_simple(1, &rows, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 1, &chunk);
    H5Dclose(H5Dcreate2(file.id(), "/VTKHDF/NumberOfPoints", H5T_STD_I64LE, space, H5P_DEFAULT, how,
                        H5P_DEFAULT));
    H5Pclose(how);
    H5Sclose(space);
    file.close();
  };
  replace("/events/cell_offset", 2, 1, 0);
  claim(hsize_t{1} << 50);
  expect_error(Exit::kFileError, "larger than the file can hold", read);
  replace("/events/cell_offset", 2, 1, -1);
  expect_error(Exit::kFileError, "out of order", read);
  for (const char* count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    for (const std::int64_t many : {std::int64_t{-1}, std::int64_t{1} << 62}) {
      replace(std::string("/VTKHDF/") + count, 2, 1, many);
      expect_error(Exit::kFileError, "that cannot be", read);
    }
  for (const std::int64_t corner : {std::int64_t{-1}, std::int64_t{1} << 20, sphere}) {
    replace("/VTKHDF/Connectivity", 1 << 16, 1, corner);
    expect_error(Exit::kFileError, "corners that are not there", read);
  }
}

TEST(RunFile, LongMessagesAreMarkedAsCut) {
  const Folder folder("run_file_long");
  RunFile run = RunFile::create(folder / "run.vtkhdf", {});
  run.append_event({0, "long", {}, std::string(2000, 'x')});
  run.close();
  const auto event = RunReader(folder / "run.vtkhdf").events();
  ASSERT_EQ(event.size(), 1U);
  EXPECT_EQ(event[0].message, std::string(509, 'x') + "...");
}

}  // namespace
}  // namespace acinus::io
