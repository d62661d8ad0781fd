#pragma once
/// Data folder of the service. All requests and their progress are kept in files:
///
///     runs/ID/        run folder, with job.json and the client's files in input/
///     queue/STATE/ID  empty file, renamed from state to state
///     results/KEY     result of an evaluation
///     cache/          stiffness laws calibrated by runs
///
/// A run exists from the creation of its file in the queue.

#include <optional>
#include <string>
#include <vector>

#include "io/file_lock.hpp"
#include "service/serve/job.hpp"

namespace acinus::service {

/// Reader and writer of the data folder, which it keeps locked.
class JobStore {
 public:
  /// Creates the folder if needed, restricts it to this account and locks it.
  /// @throws Error(kBadInput) if another service holds it or other accounts may write in it,
  /// kFileError
  explicit JobStore(const std::string& folder);

  const std::string& folder() const { return folder_; }
  std::string run_folder(const std::string& id) const { return folder_ + "/runs/" + id; }
  std::string results_folder() const { return folder_ + "/results"; }
  /// Folder of the stiffness laws calibrated by runs.
  std::string cache_folder() const { return folder_ + "/cache"; }

  /// Loads all jobs by id after any end of the previous service: running jobs become waiting, and
  /// folders of never accepted runs are removed.
  /// @param warnings  receives descriptions of damaged entries
  std::vector<RunJob> load(std::vector<std::string>& warnings);

  /// Creates a run folder with a new id.
  /// @return the id
  std::string make_run_folder();
  /// Accepts a job whose folder is complete, as waiting.
  void accept(const RunJob& job);
  /// Writes the job's record, then moves it in the queue.
  /// @post job.state == to
  void move(RunJob& job, JobState to);
  /// Removes a job and its folder.
  void remove(const RunJob& job);

  /// Size of a folder tree, bytes.
  static double size_of(const std::string& folder);

 private:
  std::string folder_;
  io::FileLock lock_;
};

}  // namespace acinus::service
