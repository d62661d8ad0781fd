#include "core/parallel/threads.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>

#include "core/parallel/clock.hpp"
#endif

namespace acinus {
namespace {

thread_local bool t_within_part = false;

/// Marks the calling thread as within a part while it lives: nested work is not shared again.
struct WithinPart {
  WithinPart() { t_within_part = true; }
  ~WithinPart() { t_within_part = false; }
  WithinPart(const WithinPart&) = delete;
  WithinPart& operator=(const WithinPart&) = delete;
};

void pause() {
#if defined(__x86_64__)
  _mm_pause();
#else
  std::this_thread::yield();
#endif
}

/// Spins for a moment until the number changes: most gaps in a solve are short, and waking a thread
/// takes as long.
/// @return true if it changed
bool changes_soon(const std::atomic<std::uint32_t>& number, std::uint32_t old) {
  constexpr int kPauses = 10000;  // some 150 us
  for (int k = 0; k < kPauses; ++k) {
    if (number.load() != old) return true;
    pause();
  }
  return false;
}

/// Parts assigned to one thread, the same each time so that their data are still in its cache. Idle
/// threads take over some of them.
struct alignas(64) Run {
  std::atomic<std::size_t> next = 0;
  std::size_t end = 0;
};

struct Job {
  const void* work;
  threads::Part part;
  std::size_t n_thread = 1;
};

/// Pool of helper threads for the thread that shares work. Helpers are never joined: they hold
/// nothing, and end with the process. A forked process has none and does all work alone.
class Team {
 public:
  void resize(int n) { size_ = std::max(n, 1); }
  int size() const { return size_.load(std::memory_order_relaxed); }
  void share(std::size_t n_part, Job job);

 private:
  void help(std::size_t number);
  void take_parts(const Job& job, std::size_t number);
  void start_helpers(std::size_t n);
  void wait_for_helpers();
  double helper_seconds() const;

  std::atomic<int> size_ = 1;
  std::mutex in_use_;
  std::vector<Run> run_;                 ///< [thread] assigned parts
  std::vector<clockid_t> helper_clock_;  ///< [helper] CPU clocks
  double alone_until_ = 0;  ///< s; the caller works alone until then, as helpers got no processor
  std::atomic<const Job*> job_ = nullptr;  ///< null: no part may be begun
  std::atomic<std::uint32_t> posted_ = 0;  ///< number of jobs so far; helpers wait for the next one
  std::atomic<std::uint32_t> inside_ = 0;  ///< helpers that may still use the job
  std::mutex failed_;
  std::exception_ptr failure_;
};

// Not destroyed: helpers may outlive static objects.
Team& team() {
  static Team& the_team = *new Team;
  return the_team;
}

void Team::take_parts(const Job& job, std::size_t number) {
  const WithinPart within;
  try {
    for (std::size_t k = 0; k < job.n_thread; ++k) {
      Run& run = run_[(number + k) % job.n_thread];
      for (std::size_t part; (part = run.next.fetch_add(1)) < run.end;) job.part(job.work, part);
    }
  } catch (...) {
    const std::scoped_lock lock(failed_);
    failure_ = std::current_exception();
  }
}

void Team::help(std::size_t number) {
  for (std::uint32_t seen = 0;;) {
    if (!changes_soon(posted_, seen)) posted_.wait(seen);
    seen = posted_.load();
    ++inside_;
    // From here on the job, if there still is one, waits for this thread.
    if (const Job* job = job_.load(); job != nullptr && number < job->n_thread)
      take_parts(*job, number);
    --inside_;
    inside_.notify_one();
  }
}

void work_alone(std::size_t n_part, const Job& job) {
  for (std::size_t part = 0; part < n_part; ++part) job.part(job.work, part);
}

void Team::start_helpers(std::size_t n) {
  while (helper_clock_.size() < n) {
    std::thread helper([this, number = helper_clock_.size() + 1] { help(number); });
    pthread_getcpuclockid(helper.native_handle(), &helper_clock_.emplace_back());
    helper.detach();
  }
}

double Team::helper_seconds() const {
  double sum = 0;
  for (const clockid_t clock : helper_clock_) sum += read_clock(clock);
  return sum;
}

/// Waits until no helper uses the job. On a busy machine a helper may lose its processor in the
/// middle of a part. The pool then pauses for so long that such losses cost a twentieth of the time
/// at most.
void Team::wait_for_helpers() {
  constexpr double kRest = 20;
  const auto at_work = [&] { return inside_.load(); };
  for (std::uint32_t n; (n = at_work()) != 0 && changes_soon(inside_, n);) {
  }
  if (at_work() == 0) return;
  const double start = wall_seconds(), worked = helper_seconds();
  for (std::uint32_t n; (n = at_work()) != 0;) inside_.wait(n);
  const double now = wall_seconds();
  const double lost = now - start - (helper_seconds() - worked);
  if (lost > 0.5 * (now - start)) alone_until_ = now + kRest * lost;
}

void Team::share(std::size_t n_part, Job job) {
  const std::size_t n = std::min<std::size_t>(size(), n_part);
  if (n < 2) return work_alone(n_part, job);
  const std::unique_lock lock(in_use_, std::try_to_lock);
  if (!lock.owns_lock() || (alone_until_ > 0 && wall_seconds() < alone_until_)) {
    const WithinPart within;
    return work_alone(n_part, job);
  }
  alone_until_ = 0;
  job.n_thread = n;
  if (run_.size() < n) run_ = std::vector<Run>(n);
  for (std::size_t k = 0; k < n; ++k) {
    run_[k].next.store(k * n_part / n, std::memory_order_relaxed);
    run_[k].end = (k + 1) * n_part / n;
  }
  start_helpers(n - 1);
  job_ = &job;
  ++posted_;
  posted_.notify_all();
  take_parts(job, 0);
  job_ = nullptr;
  wait_for_helpers();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace

void set_threads(int n) { team().resize(n); }
int thread_count() { return team().size(); }

int processor_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::size_t count_threads(std::size_t n_row) {
  return worth_threads(n_row) && !t_within_part ? thread_count() : 1;
}

void threads::share(std::size_t n_part, const void* work, Part part) {
  if (t_within_part)
    work_alone(n_part, {work, part});
  else
    team().share(n_part, {work, part});
}

}  // namespace acinus
