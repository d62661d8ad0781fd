#include "service/serve/preparation.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/inside.hpp"
#include "runs/session/child.hpp"
#include "service/serve/submission.hpp"

namespace acinus::service {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

constexpr int kMostConcurrent = 2;
constexpr double kPreparationTimeLimit = 60;        ///< wall time and processor time, s
constexpr double kPreviewTimeLimit = 30;            ///< the same for a picture of the start, s
constexpr double kPreparationMemory = 4e9;          ///< address space, bytes
constexpr std::size_t kMostMessageBytes = 200'000;  ///< bytes of the error messages
constexpr auto kPreparationPoll = std::chrono::milliseconds(4);
constexpr const char* kMessageFile = "prepare.txt";

/// Guard that removes the run folder of a refused submission.
struct RemoveUnlessKept {
  std::string folder;
  bool keep = false;
  ~RemoveUnlessKept() {
    std::error_code ignored;
    if (!keep) fs::remove_all(folder, ignored);
  }
};

/// Counter of preparations in progress that also decrements when the client disconnects.
struct Counted {
  explicit Counted(std::shared_ptr<int> count) : n(std::move(count)) { ++*n; }
  ~Counted() { --*n; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  std::shared_ptr<int> n;
};

/// Faults of a submission as printed, without the path of its run folder.
std::string read_faults(const std::string& folder) {
  std::string text;
  try {
    text = io::read_text_inside(folder, kMessageFile, kMostMessageBytes);
  } catch (const Error&) {
    return "the submission is refused";
  }
  const std::string place = folder + "/input/";
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at))
    text.erase(at, place.size());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

[[noreturn]] void fail(const runs::ChildEnd& end, const std::string& folder, double limit_s) {
  if (end.timed_out || end.signal == SIGXCPU)
    throw Error(
        fmt::format("to check this submission takes longer than {:.0f} s. Take fewer or "
                    "smaller files, or fewer cells.",
                    limit_s));
  if (end.signal != 0)
    throw Error(
        "a file of this submission cannot be read: it is damaged, or takes more memory "
        "than this service allows.");
  throw Error(read_faults(folder));
}

}  // namespace

Task<RunJob> Preparation::prepare(const std::string& body) {
  return prepare_file(kRequestFile, body);
}

Task<RunJob> Preparation::prepare_evaluation(const std::string& text) {
  return prepare_file(kEvaluationFile, text);
}

Task<std::string> Preparation::check_submission(const std::string& body) {
  return read_result("--prepare", "scene.json", kPreparationTimeLimit, body);
}

Task<std::string> Preparation::preview(const std::string& body) {
  return read_result("--preview", kPreviewFile, kPreviewTimeLimit, body);
}

/// Work of a child process on a submission.
struct Preparation::Work {
  std::string folder;       ///< exists
  const char* flag;         ///< of `acinus serve`
  const char* name;         ///< of the file with the submission
  const std::string& text;  ///< of that file
  double limit_s;           ///< wall time and processor time
};

/// Waits until another child process may start.
Task<void> Preparation::wait_for_turn() {
  asio::steady_timer timer(co_await asio::this_coro::executor);
  while (*n_running_ >= kMostConcurrent) {
    timer.expires_after(kPreparationPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
}

/// @throws Error(kBadInput) if the child failed
Task<void> Preparation::call_child(const Work& work) {
  asio::steady_timer timer(co_await asio::this_coro::executor);
  io::write_text_file(work.folder + "/" + work.name, work.text);
  runs::Child child(
      {"serve", work.flag, work.folder, "--max-cells", std::to_string(options_.max_cells),
       "--max-memory", fmt::format("{} MB", 1e-6 * options_.max_memory)},
      {.output = work.folder + "/" + kMessageFile,
       .limit_s = work.limit_s,
       .follows_parent = true,
       .most_memory = kPreparationMemory,
       .most_cpu_s = work.limit_s,
       .largest_file = 4 * options_.max_body + 64e6});
  // Not the descriptor: the coroutine may go before the child does.
  while (!runs::wait_for_any({&child}, 0)) {
    timer.expires_after(kPreparationPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
  const runs::ChildEnd end = child.collect();
  if (end.code != 0) fail(end, work.folder, work.limit_s);
}

Task<RunJob> Preparation::prepare_file(const char* name, const std::string& text) {
  co_await wait_for_turn();
  const Counted counted(n_running_);
  const std::string folder = store_.run_folder(store_.make_run_folder());
  RemoveUnlessKept guard{folder};
  const Work work{folder, "--prepare", name, text, kPreparationTimeLimit};
  co_await call_child(work);
  RunJob job = read_job(folder);
  job.id = fs::path(folder).filename().string();
  std::error_code ignored;
  for (const char* made : {name, kMessageFile}) fs::remove(folder + "/" + made, ignored);
  job.bytes = JobStore::size_of(folder);
  guard.keep = true;
  co_return job;
}

Task<std::string> Preparation::read_result(const char* flag, const char* file, double limit_s,
                                           const std::string& body) {
  co_await wait_for_turn();
  const Counted counted(n_running_);
  const std::string folder = store_.run_folder(store_.make_run_folder());
  const RemoveUnlessKept guard{folder};
  const Work work{folder, flag, kRequestFile, body, limit_s};
  co_await call_child(work);
  co_return io::read_text_inside(folder, file, static_cast<std::size_t>(2 * kMostPreviewBytes));
}

}  // namespace acinus::service
