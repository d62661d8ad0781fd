#include "io/tidy_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "io/disk.hpp"
#include "io/hdf5.hpp"
#include "tests/io/sample.hpp"

namespace acinus::io {
namespace {

TEST(TidyTable, TheSameRowsMakeTheSameBytes) {
  const std::vector<TidyColumn> columns{
      {"run", "", std::vector<std::string>{"a/seed_1", "a,b \xC2\xB5"}},
      {"seed", "1", std::vector<std::int64_t>{1, 2}},
      {"value", "um", std::vector<double>{0.1, -2e-300}}};
  write_tidy_table(test::path("one"), columns);
  write_tidy_table(test::path("two"), columns);
  EXPECT_TRUE(read_text_file(test::path("one")) == read_text_file(test::path("two")));
  const h5::File file = h5::File::open(test::path("one"), h5::Access::kRead);
  EXPECT_EQ(file.read_all<double>("/value"), (std::vector<double>{0.1, -2e-300}));
  EXPECT_EQ(file.read_text_attribute("/value", "unit"), "um");
  EXPECT_EQ(file.read_text_rows("/run", 0, 2)[1], "a,b \xC2\xB5");
}

TEST(TidyTable, NothingElseStaysBehind) {
  write_tidy_table(test::path("alone"), {{"value", "um", std::vector<double>{1}}});
  for (const char* end : {".sums", ".tmp", ".tmp.sums", ".tmp.journal"})
    EXPECT_NE(access((test::path("alone") + end).c_str(), F_OK), 0) << end;
}

TEST(TidyTable, MayBeEmpty) {
  write_tidy_table(test::path("empty"), {{"run", "", std::vector<std::string>{}},
                                         {"value", "um", std::vector<double>{}}});
  EXPECT_EQ(h5::File::open(test::path("empty"), h5::Access::kRead).n_row("/value"), 0);
}

}  // namespace
}  // namespace acinus::io
