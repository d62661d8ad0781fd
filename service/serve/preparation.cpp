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

[[noreturn]] void fail(const runs::ChildEnd& end, const std::string& folder) {
  if (end.timed_out || end.signal == SIGXCPU)
    throw Error(
        fmt::format("to check this submission takes longer than {:.0f} s. Take fewer or "
                    "smaller files.",
                    kPreparationTimeLimit));
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

Task<RunJob> Preparation::prepare_file(const char* name, const std::string& text) {
  asio::steady_timer timer(co_await asio::this_coro::executor);
  while (*n_running_ >= kMostConcurrent) {
    timer.expires_after(kPreparationPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
  const Counted counted(n_running_);
  const std::string folder = store_.run_folder(store_.make_run_folder());
  RemoveUnlessKept guard{folder};
  io::write_text_file(folder + "/" + name, text);
  runs::Child child(
      {"serve", "--prepare", folder, "--max-cells", std::to_string(options_.max_cells),
       "--max-memory", fmt::format("{} MB", 1e-6 * options_.max_memory)},
      {.output = folder + "/" + kMessageFile,
       .limit_s = kPreparationTimeLimit,
       .follows_parent = true,
       .most_memory = kPreparationMemory,
       .most_cpu_s = kPreparationTimeLimit,
       .largest_file = 4 * options_.max_body + 64e6});
  // Not the descriptor: the coroutine may go before the child does.
  while (!runs::wait_for_any({&child}, 0)) {
    timer.expires_after(kPreparationPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
  const runs::ChildEnd end = child.collect();
  if (end.code != 0) fail(end, folder);
  RunJob job = read_job(folder);
  job.id = fs::path(folder).filename().string();
  std::error_code ignored;
  for (const char* made : {name, kMessageFile}) fs::remove(folder + "/" + made, ignored);
  job.bytes = JobStore::size_of(folder);
  guard.keep = true;
  co_return job;
}

}  // namespace acinus::service
