#include "io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/hdf5.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::io {
namespace {

using test::Folder;

CheckpointData make_data(double x) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double odd_nan = std::bit_cast<double>(std::uint64_t{0x7ff8dead0000beefULL});
  CheckpointData data;
  data.put("dcm/position", std::vector<double>{x, -0.0, tiny, 0.1, 1e308, odd_nan});
  data.put("dcm/empty", std::vector<double>{});
  data.put("cells/id", std::vector<std::int64_t>{-1, 0, std::numeric_limits<std::int64_t>::min()});
  data.put("random/seed", std::vector<std::uint64_t>{~std::uint64_t{0}, 7});
  data.put("scene", "{\"name\": \"\u00b5\"}\nsecond line");
  data.put("nothing", "");
  data.put_number("time", x);
  data.put_count("step", 12);
  return data;
}

CheckpointSource make_source(double x) { return CheckpointSource(make_data(x)); }

/// Array that is handed over in parts of two values.
/// @param size  given as its size
template <class T>
ArraySource<T> in_pairs(std::vector<T> values, std::size_t size) {
  return {size, [values](const TakePart<T>& take) {
            for (std::size_t k = 0; k < values.size(); k += 2)
              take(std::span(values).subspan(k, std::min<std::size_t>(2, values.size() - k)));
          }};
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& value) {
  std::vector<std::uint64_t> bits;
  for (const double v : value) bits.push_back(std::bit_cast<std::uint64_t>(v));
  return bits;
}

TEST(Checkpoint, RoundTripKeepsEveryBit) {
  const Folder folder("checkpoint_bits");
  const CheckpointData data = make_data(3.5);
  save_checkpoint(folder.path, CheckpointSource(data));
  const LoadedCheckpoint loaded = load_checkpoint(folder.path);
  EXPECT_EQ(loaded.warning, "");
  EXPECT_EQ(loaded.file, folder / "checkpoint.h5");
  ASSERT_EQ(loaded.data.all().size(), data.all().size());
  EXPECT_EQ(bits_of(loaded.data.numbers("dcm/position")), bits_of(data.numbers("dcm/position")));
  EXPECT_TRUE(loaded.data.numbers("dcm/empty").empty());
  EXPECT_EQ(loaded.data.integers("cells/id"), data.integers("cells/id"));
  EXPECT_EQ(loaded.data.bits("random/seed"), data.bits("random/seed"));
  EXPECT_EQ(loaded.data.text("scene"), data.text("scene"));
  EXPECT_EQ(loaded.data.text("nothing"), "");
  EXPECT_EQ(loaded.data.number("time"), 3.5);
  EXPECT_EQ(loaded.data.count("step"), 12);
}

TEST(Checkpoint, ArraysInPartsAreThoseOfTheWhole) {
  const Folder folder("checkpoint_parts");
  CheckpointData whole = make_data(3.5);
  CheckpointSource parts(whole);
  const std::vector<double> numbers{1, 2, 0.1, 4, 5};
  const std::vector<std::int64_t> counts{7, -8, 9};
  whole.put("numbers/many", numbers);
  whole.put("numbers/none", std::vector<double>{});
  whole.put("counts", counts);
  parts.put("numbers/many", in_pairs(numbers, 5));
  parts.put("numbers/none", in_pairs<double>({}, 0));
  parts.put("counts", in_pairs(counts, 3));
  save_state_file(folder / "parts.h5", parts);
  const CheckpointData loaded = load_state_file(folder / "parts.h5"), made = collect(parts);
  for (const CheckpointData* data : {&loaded, &made}) {
    EXPECT_EQ(data->all().size(), whole.all().size());
    EXPECT_EQ(data->numbers("numbers/many"), numbers);
    EXPECT_TRUE(data->numbers("numbers/none").empty());
    EXPECT_EQ(data->integers("counts"), counts);
  }
}

TEST(Checkpoint, ArraysInPartsHaveTheirSize) {
  const Folder folder("checkpoint_size");
  save_checkpoint(folder.path, make_source(1));
  for (const std::size_t size : {2, 4}) {
    CheckpointSource source(make_data(2));
    source.put("numbers", in_pairs<double>({1, 2, 3}, size));
    EXPECT_THROW(save_checkpoint(folder.path, source), Error);
  }
  EXPECT_EQ(load_checkpoint(folder.path).data.number("time"), 1);
}

TEST(Checkpoint, NeverInventsAValue) {
  const CheckpointData data = make_data(1);
  EXPECT_CONTAINS(acinus::test::message_of([&] { data.numbers("absent"); }, Exit::kFileError),
                  "has no \"absent\"");
  EXPECT_CONTAINS(acinus::test::message_of([&] { data.integers("time"); }, Exit::kFileError),
                  "holds 64-bit floats, but signed");
  acinus::test::message_of([&] { data.text("time"); }, Exit::kFileError);
  acinus::test::message_of([&] { data.number("dcm/position"); }, Exit::kFileError);
  EXPECT_FALSE(data.contains("absent"));
}

TEST(Checkpoint, NamesMustBePlainAndDistinct) {
  CheckpointData data = make_data(1);
  for (const char* name : {"", "/a", "a/", "a//b", "a b", "time", "time/x", "dcm"}) {
    acinus::test::message_of([&] { data.put(name, "x"); }, Exit::kInternal);
  }
}

TEST(Checkpoint, KeepsTheOneBefore) {
  const Folder folder("checkpoint_prev");
  EXPECT_FALSE(has_checkpoint(folder.path));
  acinus::test::message_of([&] { load_checkpoint(folder.path); }, Exit::kFileError);
  for (const double x : {1.0, 2.0, 3.0}) save_checkpoint(folder.path, make_source(x));
  EXPECT_TRUE(has_checkpoint(folder.path));
  EXPECT_EQ(load_checkpoint(folder.path).data.number("time"), 3.0);
  std::filesystem::remove(folder / "checkpoint.h5");
  const auto loaded = load_checkpoint(folder.path);
  EXPECT_EQ(loaded.data.number("time"), 2.0);
  EXPECT_CONTAINS(loaded.warning, "checkpoint.prev.h5");
}

/// Changes one byte at a time, everywhere: the result is the true state, the one before, but never
/// a wrong one.
TEST(Checkpoint, DamageAnywhereIsNoticedOrHarmless) {
  const Folder folder("checkpoint_damage");
  save_checkpoint(folder.path, make_source(1));
  save_checkpoint(folder.path, make_source(2));
  const std::string whole = read_text_file(folder / "checkpoint.h5");
  int n_fallback = 0, n_harmless = 0;
  for (std::size_t at = 0; at < whole.size(); at += 13) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    write_text_file(folder / "checkpoint.h5", damaged);
    const auto loaded = load_checkpoint(folder.path);
    const double expected = loaded.warning.empty() ? 2.0 : 1.0;
    (loaded.warning.empty() ? n_harmless : n_fallback) += 1;
    ASSERT_EQ(loaded.data.number("time"), expected) << "byte " << at;
    ASSERT_EQ(bits_of(loaded.data.numbers("dcm/position")),
              bits_of(make_data(expected).numbers("dcm/position")));
    ASSERT_EQ(loaded.data.all().size(), 8U);
  }
  std::printf("%zu bytes; of the bytes tried %d fell back, %d were unused space\n", whole.size(),
              n_fallback, n_harmless);
  EXPECT_GT(n_fallback, 0);
  write_text_file(folder / "checkpoint.h5", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(load_checkpoint(folder.path).data.number("time"), 1.0);
  write_text_file(folder / "checkpoint.prev.h5", "");
  EXPECT_CONTAINS(acinus::test::message_of([&] { load_checkpoint(folder.path); }, Exit::kFileError),
                  "Neither");
}

/// Damage of the list of arrays, which has no checksum of its own: one that names an array twice,
/// or none that can be, is damage.
TEST(Checkpoint, DamagedListOfArraysIsDamage) {
  const Folder folder("checkpoint_names");
  for (const std::string list : {"time\ntime\n", "time\ntime/x\n", "/\n", "\n"}) {
    save_state_file(folder / "state.h5", make_source(1));
    {
      h5::File file = h5::File::open(folder / "state.h5", h5::Access::kAppend);
      ASSERT_GE(H5Ldelete(file.id(), "/names", H5P_DEFAULT), 0);
      file.write_array<std::uint8_t>(
          "/names", {reinterpret_cast<const std::uint8_t*>(list.data()), list.size()});
      file.close();
    }
    acinus::test::message_of([&] { load_state_file(folder / "state.h5"); }, Exit::kFileError);
  }
}

TEST(Checkpoint, NewerFormatIsRefusedNotReplaced) {
  const Folder folder("checkpoint_newer");
  save_checkpoint(folder.path, make_source(1));
  save_checkpoint(folder.path, make_source(2));
  {
    h5::File file = h5::File::open(folder / "checkpoint.h5", h5::Access::kAppend);
    const std::int64_t version[2] = {3, 0};
    file.write_attribute("/", "schema_version", version);
    file.close();
  }
  const std::string message =
      acinus::test::message_of([&] { load_checkpoint(folder.path); }, Exit::kFileError);
  EXPECT_CONTAINS(message, "3.0 is newer than this program reads (2.0)");
}

TEST(Checkpoint, UnfinishedFileFallsBack) {
  const Folder folder("checkpoint_open");
  save_checkpoint(folder.path, make_source(1));
  save_checkpoint(folder.path, make_source(2));
  {
    h5::File file = h5::File::open(folder / "checkpoint.h5", h5::Access::kAppend);
    const std::int64_t no = 0;
    file.write_attribute("/", "complete", std::span(&no, 1));
    file.close();
  }
  const auto loaded = load_checkpoint(folder.path);
  EXPECT_CONTAINS(loaded.warning, "not finished");
  EXPECT_EQ(loaded.data.number("time"), 1.0);
}

}  // namespace
}  // namespace acinus::io
