#include "core/parallel/ranks.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/pages.hpp"
#include "core/parallel/stop.hpp"

namespace acinus {

namespace {

// MPI allows one start and one end per process; this object is that pair.
class MpiSession {
 public:
  MpiSession() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    check(provided >= MPI_THREAD_FUNNELED,
          "MPI does not support a threaded process (MPI_THREAD_FUNNELED): use another MPI build",
          Exit::kCannotContinue);
    // An own communicator: no library's message can be taken for ours.
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator_);
  }
  ~MpiSession() {
    MPI_Comm_free(&communicator_);
    MPI_Finalize();
  }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  MPI_Comm communicator() const { return communicator_; }

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
};

bool started_by_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* value = std::getenv(name)) return std::atoi(value) > 1;
  }
  return std::getenv("PMIX_RANK") != nullptr;  // without the size, which MPI knows
}

constexpr std::size_t kLargestCount = std::size_t{1} << 30;  ///< bytes in one MPI call

Traffic g_traffic;

/// Adds the duration of a call to the time spent waiting.
class Waiting {
 public:
  Waiting() : started_(MPI_Wtime()) {}
  ~Waiting() { g_traffic.wait_s += MPI_Wtime() - started_; }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  double started_;
};

/// Counts of a line, which has one file name for all of its calls.
std::map<std::pair<const char*, std::uint_least32_t>, TrafficPlace> g_places;

TrafficPlace& count_at(const Ranks::Place& place, std::size_t bytes) {
  TrafficPlace& at = g_places[{place.file_name(), place.line()}];
  ++at.calls;
  at.bytes += static_cast<std::int64_t>(bytes);
  return at;
}

void count_reduction(std::size_t bytes, const Ranks::Place& place) {
  ++g_traffic.reductions;
  g_traffic.reduction_bytes += static_cast<std::int64_t>(bytes);
  count_at(place, bytes);
}

MPI_Comm handle(int communicator) { return MPI_Comm_f2c(communicator); }

int severity(int exit_code) {
  constexpr std::array kMildToGrave = {Exit::kDone,           Exit::kStopped,   Exit::kBadInput,
                                       Exit::kCannotContinue, Exit::kFileError, Exit::kInternal};
  int grade = 0;
  for (const Exit exit : kMildToGrave) {
    if (static_cast<int>(exit) == exit_code) return grade;
    ++grade;
  }
  return grade;
}

}  // namespace

Ranks Ranks::world() {
  if (!started_by_launcher()) return serial();
  static const MpiSession session;
  int rank = 0, size = 1;
  MPI_Comm_rank(session.communicator(), &rank);
  MPI_Comm_size(session.communicator(), &size);
  if (size > 1) use_small_pages();
  return Ranks(rank, size, MPI_Comm_c2f(session.communicator()));
}

void Ranks::sum(std::span<ExactSum> sums, Place place) const {
  if (size_ == 1) return;
  // One word more says whether this process is asked to stop.
  thread_local std::vector<std::int64_t> words;
  words.clear();
  for (ExactSum& s : sums) {
    const auto w = s.words();
    words.insert(words.end(), w.begin(), w.end());
  }
  words.push_back(is_asked_to_stop() ? 1 : 0);
  const Waiting waiting;
  MPI_Allreduce(MPI_IN_PLACE, words.data(), static_cast<int>(words.size()), MPI_INT64_T, MPI_SUM,
                handle(communicator_));
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::copy_n(words.data() + k * ExactSum::kWords, ExactSum::kWords, sums[k].words().data());
  agree_to_stop(words.back() > 0);
  count_reduction(words.size() * sizeof(words[0]), place);
}

double Ranks::max(double value, Place place) const {
  if (size_ == 1) return value;
  // MPI_MAX leaves the treatment of NaN open, so NaN travels as a second number.
  std::array<double, 2> both = {
      std::isnan(value) ? -std::numeric_limits<double>::infinity() : value,
      std::isnan(value) ? 1.0 : 0.0};
  const Waiting waiting;
  MPI_Allreduce(MPI_IN_PLACE, both.data(), 2, MPI_DOUBLE, MPI_MAX, handle(communicator_));
  count_reduction(sizeof both, place);
  return both[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[0];
}

void Ranks::max(std::span<double> values, Place place) const {
  if (size_ == 1) return;
  const Waiting waiting;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                handle(communicator_));
  count_reduction(values.size_bytes(), place);
}

std::int64_t Ranks::min(std::int64_t value, Place place) const {
  if (size_ == 1) return value;
  const Waiting waiting;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_MIN, handle(communicator_));
  count_reduction(sizeof value, place);
  return value;
}

bool Ranks::any(bool value, Place place) const { return max(value ? 1.0 : 0.0, place) > 0.5; }

void Ranks::barrier() const {
  if (size_ > 1) MPI_Barrier(handle(communicator_));
}

int Ranks::agree_worst(int exit_code) const {
  if (size_ == 1) return exit_code;
  std::vector<int> codes(size_);
  MPI_Allgather(&exit_code, 1, MPI_INT, codes.data(), 1, MPI_INT, handle(communicator_));
  return *std::max_element(codes.begin(), codes.end(),
                           [](int a, int b) { return severity(a) < severity(b); });
}

std::vector<std::size_t> Ranks::gather_sizes(std::size_t own_bytes) const {
  const Waiting waiting;
  std::vector<std::size_t> bytes(size_);
  MPI_Allgather(&own_bytes, sizeof own_bytes, MPI_BYTE, bytes.data(), sizeof own_bytes, MPI_BYTE,
                handle(communicator_));
  std::vector<std::size_t> start{0};
  for (const std::size_t n : bytes) start.push_back(start.back() + n);
  return start;
}

void Ranks::gather_bytes(const void* own, const std::vector<std::size_t>& start, bool at_root,
                         void* all) const {
  const Waiting waiting;
  // MPI counts in int. What is longer goes in rounds, each with a part of what every rank has.
  const std::size_t most = kLargestCount / size_;
  std::size_t longest = 0;
  for (int r = 0; r < size_; ++r) longest = std::max(longest, start[r + 1] - start[r]);
  std::vector<int> count(size_), place(size_);
  std::vector<std::byte> buffer;
  for (std::size_t done = 0; done < longest; done += most) {
    int n = 0;
    for (int r = 0; r < size_; ++r) {
      const std::size_t length = start[r + 1] - start[r];
      count[r] = static_cast<int>(done < length ? std::min(most, length - done) : 0);
      place[r] = n;
      n += count[r];
    }
    const bool whole = longest <= most, receives = !at_root || is_root();
    if (!whole && receives) buffer.resize(n);
    auto* to = static_cast<std::byte*>(all);
    const std::byte* const from = static_cast<const std::byte*>(own) + done;
    std::byte* const into = whole ? to : buffer.data();
    if (at_root)
      MPI_Gatherv(from, count[rank_], MPI_BYTE, into, count.data(), place.data(), MPI_BYTE, 0,
                  handle(communicator_));
    else
      MPI_Allgatherv(from, count[rank_], MPI_BYTE, into, count.data(), place.data(), MPI_BYTE,
                     handle(communicator_));
    for (int r = 0; r < size_ && !whole && receives; ++r)
      std::copy_n(buffer.data() + place[r], count[r], to + start[r] + done);
  }
}

void Ranks::count_gathering(std::size_t own_bytes, std::size_t all_bytes, const Place& place) {
  ++g_traffic.gatherings;
  g_traffic.gathered_bytes += static_cast<std::int64_t>(own_bytes);
  count_at(place, own_bytes).received += static_cast<std::int64_t>(all_bytes);
}

void Ranks::exchange_bytes(const ExchangePlan& plan, std::size_t size, const void* out,
                           void* in) const {
  constexpr int kTag = 1;
  const Waiting waiting;
  thread_local std::vector<MPI_Request> request;
  request.clear();
  for (const ExchangePlan::Peer& p : plan.peer) {
    if (p.receive_begin == p.receive_end) continue;
    MPI_Irecv(static_cast<std::byte*>(in) + p.receive_begin * size,
              static_cast<int>((p.receive_end - p.receive_begin) * size), MPI_BYTE, p.rank, kTag,
              handle(communicator_), &request.emplace_back());
  }
  for (const ExchangePlan::Peer& p : plan.peer) {
    if (p.send_begin == p.send_end) continue;
    const std::size_t bytes = (p.send_end - p.send_begin) * size;
    MPI_Isend(static_cast<const std::byte*>(out) + p.send_begin * size, static_cast<int>(bytes),
              MPI_BYTE, p.rank, kTag, handle(communicator_), &request.emplace_back());
    ++g_traffic.messages;
    g_traffic.message_bytes += static_cast<std::int64_t>(bytes);
  }
  MPI_Waitall(static_cast<int>(request.size()), request.data(), MPI_STATUSES_IGNORE);
}

void Ranks::broadcast_bytes(void* bytes, std::size_t n) const {
  for (std::size_t done = 0; done < n; done += kLargestCount)
    MPI_Bcast(static_cast<std::byte*>(bytes) + done,
              static_cast<int>(std::min(kLargestCount, n - done)), MPI_BYTE, 0,
              handle(communicator_));
}

void Ranks::abort(int exit_code) const {
  if (size_ > 1) MPI_Abort(handle(communicator_), exit_code);
  std::_Exit(exit_code);
}

Traffic Ranks::traffic() { return g_traffic; }

std::vector<TrafficPlace> Ranks::traffic_by_place() {
  std::map<std::string, TrafficPlace> by_name;
  for (const auto& [at, counts] : g_places) {
    const std::string_view file = at.first;
    const std::string name = fmt::format("{}:{}", file.substr(file.rfind('/') + 1), at.second);
    TrafficPlace& sum = by_name[name];
    sum.place = name;
    sum.calls += counts.calls;
    sum.bytes += counts.bytes;
    sum.received += counts.received;
  }
  std::vector<TrafficPlace> places;
  for (const auto& [name, counts] : by_name) places.push_back(counts);
  std::ranges::stable_sort(places, std::greater(),
                           [](const TrafficPlace& p) { return std::max(p.bytes, p.received); });
  return places;
}

}  // namespace acinus
