#pragma once
/// One simulation the service was asked for, as its record in the run folder says it.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace acinus::runs {

enum class JobState {
  kWaiting,
  kRunning,
  kStopped,  ///< with a checkpoint, until it is resumed
  kCompleted,
  kFailed,
};
const char* name_of(JobState state);

struct RunJob {
  // What stands in job.json.
  std::string id;
  std::string name;              ///< of the scene
  std::string scene;             ///< the shipped scene it was made from; "" = the client's own
  std::vector<std::string> set;  ///< PATH=VALUE
  std::string key;               ///< of its result: scene, seed and version
  bool evaluation = false;       ///< asked for by UM-Bridge: only its result is kept
  std::string created;           ///< UTC
  int kills = 0;                 ///< attempts in a row that a signal ended without a new checkpoint
  double checkpoint_s = 0;       ///< simulated time of the last attempt's end
  double used_s = 0;             ///< wall time of earlier attempts
  bool failed = false;           ///< how it ended
  std::string cause;             ///< why it stopped or failed

  // What the service knows while it lives.
  JobState state = JobState::kWaiting;
  double time_s = 0, end_s = 0;  ///< simulated
  double left_s = -1;            ///< wall time, by the run's own estimate; < 0: not known
  int dcm = 0, cbm = 0;          ///< cells
  std::string phase;             ///< what it is busy with
  double bytes = 0;              ///< of its folder
  std::uint64_t revision = 0;    ///< counts changes, for those who watch
};

/// Whether a text has the form of an id, so that it can stand in a path.
bool is_job_id(const std::string& text);

/// An id that sorts by the time it was made: "20261125-134502-000173".
std::string make_job_id();

/// Writes and reads job.json in a run folder.   @throws Error(kFileError), kBadInput if it is none
void write_job(const std::string& folder, const RunJob& job);
RunJob read_job(const std::string& folder);

}  // namespace acinus::runs
