#include "service/serve/job_store.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::service {
namespace {

namespace fs = std::filesystem;

/// Queue folder of a state. Failed jobs count as completed there; their record holds the outcome.
const char* queue_of(JobState state) {
  const bool ended = state == JobState::kCompleted || state == JobState::kFailed;
  return ended ? "ended" : name_of(state);
}
constexpr const char* kQueues[] = {"waiting", "running", "stopped", "ended"};

JobState state_in(const std::string& queue, const RunJob& job) {
  if (queue == "stopped") return JobState::kStopped;
  if (queue == "ended") return job.failed ? JobState::kFailed : JobState::kCompleted;
  return JobState::kWaiting;
}

void make_folder(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  check(!code,
        fmt::format("{}: the folder cannot be made ({}). Choose another --data.", folder,
                    code.message()),
        Exit::kFileError);
}

/// Creates the data folder with access for this account only: other writers could plant a token or
/// a run, other readers could hold its locks.
void make_own_folder(const std::string& folder) {
  const fs::path parent = fs::path(folder).parent_path();
  if (!parent.empty()) make_folder(parent.string());
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    io::fail_on_disk(folder, "make the folder", errno);
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0) io::fail_on_disk(folder, "open", errno);
  check(S_ISDIR(status.st_mode), fmt::format("--data {}: is no folder.", folder));
  check(status.st_uid == geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0,
        fmt::format("--data {}: belongs to another user, or others may write in it: they could "
                    "put a token of their own there. Choose another --data, or take the right to "
                    "write from others (chmod go-w) after a look at what is in it.",
                    folder));
  if ((status.st_mode & 077) != 0 && chmod(folder.c_str(), 0700) != 0)
    io::fail_on_disk(folder, "be closed to others", errno);
}

std::string without_slash(std::string folder) {
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  return folder;
}

io::FileLock hold(const std::string& folder) {
  make_own_folder(folder);
  std::optional<io::FileLock> lock = io::FileLock::try_take(folder + "/service.lock", 1);
  if (!lock)
    throw Error(fmt::format("--data {}: {} serves this folder. Choose another one, or end it.",
                            folder, io::name_holder(folder + "/service.lock", 2)));
  return std::move(*lock);
}

std::string queue_file(const std::string& folder, const char* queue, const std::string& id) {
  return fmt::format("{}/queue/{}/{}", folder, queue, id);
}

}  // namespace

JobStore::JobStore(const std::string& folder)
    : folder_(without_slash(fs::absolute(folder).lexically_normal().string())),
      lock_(hold(folder_)) {
  make_folder(folder_ + "/runs");
  make_folder(results_folder());
  for (const char* queue : kQueues) make_folder(folder_ + "/queue/" + queue);
}

std::vector<RunJob> JobStore::load(std::vector<std::string>& warnings) {
  std::map<std::string, std::string> queue_by_id;
  for (const char* queue : kQueues)
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ + "/queue/" + queue))
      if (const std::string id = entry.path().filename(); is_job_id(id)) queue_by_id[id] = queue;
  std::vector<RunJob> jobs;
  for (const auto& [id, queue] : queue_by_id) {
    try {
      RunJob job = read_job(run_folder(id));
      job.id = id;
      job.state = state_in(queue, job);
      if (queue == "running")
        io::replace_file(queue_file(folder_, "running", id), queue_file(folder_, "waiting", id));
      jobs.push_back(std::move(job));
    } catch (const Error& error) {
      warnings.push_back(fmt::format("run {} cannot be taken up: {}", id, error.what()));
    }
  }
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ + "/runs"))
    if (const std::string id = entry.path().filename(); is_job_id(id) && !queue_by_id.contains(id))
      fs::remove_all(entry.path(), ignored);
  return jobs;
}

std::string JobStore::make_run_folder() {
  for (;;) {
    const std::string id = make_job_id();
    std::error_code code;
    if (fs::create_directory(run_folder(id), code)) return id;
    check(!code, fmt::format("{}: cannot be made: {}", run_folder(id), code.message()),
          Exit::kFileError);
  }
}

void JobStore::accept(const RunJob& job) {
  write_job(run_folder(job.id), job);
  io::write_text_file(queue_file(folder_, "waiting", job.id), "");
}

void JobStore::move(RunJob& job, JobState to) {
  const std::string from_file = queue_file(folder_, queue_of(job.state), job.id),
                    to_file = queue_file(folder_, queue_of(to), job.id);
  try {
    write_job(run_folder(job.id), job);
  } catch (const Error&) {
    // A full disk costs the record its news, not the job its place: a rename needs no room.
  }
  if (from_file != to_file) io::replace_file(from_file, to_file);
  job.state = to;
  ++job.revision;
}

void JobStore::remove(const RunJob& job) {
  std::error_code ignored;
  fs::remove(queue_file(folder_, queue_of(job.state), job.id), ignored);
  fs::remove_all(run_folder(job.id), ignored);
}

double JobStore::size_of(const std::string& folder) {
  double bytes = 0;
  std::error_code code;
  for (fs::recursive_directory_iterator entry(folder, code), end; entry != end && !code;
       entry.increment(code)) {
    std::error_code gone;
    if (!entry->is_regular_file(gone) || gone) continue;
    const std::uintmax_t size = entry->file_size(gone);
    if (!gone) bytes += static_cast<double>(size);
  }
  return bytes;
}

}  // namespace acinus::service
