#pragma once
/// Jobs of the service: one simulation each, recorded in its run folder.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace acinus::service {

/// State of a job in the queue.
enum class JobState {
  kWaiting,
  kRunning,
  kStopped,  ///< with a checkpoint, until resumed
  kCompleted,
  kFailed,
};
const char* name_of(JobState state);

/// Record of a job and its progress.
struct RunJob {
  // What stands in job.json.
  std::string id;
  std::string name;              ///< of the scene
  std::string scene;             ///< shipped scene it is based on; "" = the client's own
  std::vector<std::string> set;  ///< changes of the scene, PATH=VALUE
  std::string key;               ///< cache key of its result: scene, seed and version
  bool evaluation = false;       ///< requested by UM-Bridge: only the result is kept
  std::string created;           ///< UTC
  int kills = 0;            ///< consecutive attempts ended by a signal without a new checkpoint
  double checkpoint_s = 0;  ///< simulated time at the end of the last attempt
  double used_s = 0;        ///< wall time of earlier attempts
  bool failed = false;      ///< ended with an error
  std::string cause;        ///< of a stop or failure

  // What the service knows while it lives.
  JobState state = JobState::kWaiting;
  double time_s = 0, end_s = 0;  ///< simulated time
  double left_s = -1;            ///< wall time left by the run's own estimate; < 0: unknown
  int dcm = 0, cbm = 0;          ///< number of cells
  std::string phase;             ///< phase of the simulation
  double bytes = 0;              ///< size of its folder
  std::uint64_t revision = 0;    ///< counter of changes, for event streams
};

/// True if a text has the form of a job id, and so is safe as a path component.
bool is_job_id(const std::string& text);

/// New job id; ids sort by time of creation: "20261125-134502-000173".
std::string make_job_id();

/// Writes and reads job.json of a run folder.
/// @throws Error(kFileError), kBadInput for an invalid record
void write_job(const std::string& folder, const RunJob& job);
RunJob read_job(const std::string& folder);

}  // namespace acinus::service
