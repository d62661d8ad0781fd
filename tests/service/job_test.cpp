/// Record of a run of the service.

#include "service/serve/job.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/disk.hpp"

namespace acinus::service {
namespace {

TEST(JobRecord, OfARunKilledWithinItsStartUpIsReadBack) {
  const std::string folder = io::make_temporary_folder("acinus_job_");
  RunJob job;
  job.id = "20260101-000000-000001";
  job.kills = 2;
  job.checkpoint_s = -11460;
  job.used_s = 0.8;
  write_job(folder, job);
  const RunJob read = read_job(folder);
  EXPECT_EQ(read.checkpoint_s, -11460);
  EXPECT_EQ(read.kills, 2);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acinus::service
