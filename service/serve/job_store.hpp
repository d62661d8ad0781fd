#pragma once
/// The data folder of the service. What is asked for and how far it is stands in files only:
///
///     runs/ID/        a run folder, with job.json and what the client sent in input/
///     queue/STATE/ID  an empty file, renamed from state to state
///     results/KEY     what evaluations found
///     cache/          laws that runs calibrated
///
/// A run exists once its file in the queue does.

#include <optional>
#include <string>
#include <vector>

#include "io/file_lock.hpp"
#include "service/serve/job.hpp"

namespace acinus::runs {

class JobStore {
 public:
  /// Makes the folder where needed, closes it to other users, and holds it.
  /// @throws Error(kBadInput) if another service holds it or others may write in it, kFileError
  explicit JobStore(const std::string& folder);

  const std::string& folder() const { return folder_; }
  std::string run_folder(const std::string& id) const { return folder_ + "/runs/" + id; }
  std::string results_folder() const { return folder_ + "/results"; }
  /// Folder of the laws that runs calibrate.
  std::string cache_folder() const { return folder_ + "/cache"; }

  /// All jobs by id, as a service that ended in whatever way left them: those that were running
  /// wait. Removes folders of runs that were never accepted. What is damaged is told in `warnings`.
  std::vector<RunJob> load(std::vector<std::string>& warnings);

  /// A new id with its folder.
  std::string make_run_folder();
  /// Accepts a job whose folder is complete, as waiting.
  void accept(const RunJob& job);
  /// Writes the job's record, then moves it in the queue. @post job.state == to
  void move(RunJob& job, JobState to);
  /// Forgets a job and removes its folder.
  void remove(const RunJob& job);

  /// Bytes of a folder and all below.
  static double size_of(const std::string& folder);

 private:
  std::string folder_;
  io::FileLock lock_;
};

}  // namespace acinus::runs
