/// Writes a run for check_xdmf.py and what it must find there: one line per frame.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "io/disk.hpp"
#include "io/run_file.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::io {
namespace {

TEST(Xdmf, SampleRunForTheReader) {
  const char* wanted = std::getenv("ACINUS_XDMF_SAMPLE");
  const test::Folder scratch("xdmf_sample");
  const std::string folder = wanted != nullptr ? wanted : scratch.path;
  for (const char* compression : {"fast", "none"}) {
    const std::string where = folder + "/" + compression;
    std::filesystem::create_directories(where);
    RunFile run =
        RunFile::create(where + "/run.vtkhdf", {}, {std::string(compression) == "fast", 64});
    std::string expected;
    for (int k = 0; k < 17; ++k) {
      const Frame frame = test::changing_frame(k);
      run.append(frame);
      float low[3] = {1e30F, 1e30F, 1e30F}, high[3] = {-1e30F, -1e30F, -1e30F};
      for (std::size_t i = 0; i < frame.point.size(); ++i) {
        low[i % 3] = std::min(low[i % 3], frame.point[i]);
        high[i % 3] = std::max(high[i % 3], frame.point[i]);
      }
      // time, mesh nodes, triangles, spheres, sum of cell_id, bounds
      std::int64_t sum = 0;
      for (const std::int64_t id : frame.cell_id) sum += id;
      expected += fmt::format("{} {} {} {} {} {} {} {} {} {} {}\n", frame.time_s, frame.n_mesh_node,
                              frame.triangle.size(), frame.n_sphere, sum, low[0], high[0], low[1],
                              high[1], low[2], high[2]);
    }
    write_text_file(where + "/expected.txt", expected);
    const std::string xdmf = read_text_file(where + "/run.xmf");
    EXPECT_TRUE(xdmf.ends_with("</Xdmf>\n"));
    EXPECT_FALSE(acinus::test::contains(xdmf, folder))
        << "the sidecar must not hold absolute paths";
  }
}

}  // namespace
}  // namespace acinus::io
