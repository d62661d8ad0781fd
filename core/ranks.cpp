#include "core/ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"

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
  return std::getenv("PMIX_RANK") != nullptr;  // tells no size: let MPI say
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
  return Ranks(rank, size, MPI_Comm_c2f(session.communicator()));
}

void Ranks::sum(std::span<double> values) const {
  if (size_ == 1) return;
#ifdef ACINUS_ENABLE_ASSERTS
  const auto length = static_cast<double>(values.size());
  ACINUS_ASSERT(max(length) == length && max(-length) == -length);
#endif
  constexpr std::size_t kChunk = 65536;  // bounds the root's memory; MPI counts are int
  std::vector<double> gathered;
  for (std::size_t begin = 0; begin < values.size(); begin += kChunk) {
    const std::span<double> part = values.subspan(begin, std::min(kChunk, values.size() - begin));
    const int count = static_cast<int>(part.size());
    if (is_root()) gathered.resize(part.size() * size_);
    MPI_Gather(part.data(), count, MPI_DOUBLE, gathered.data(), count, MPI_DOUBLE, 0,
               handle(communicator_));
    if (is_root()) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        double total = gathered[i];
        for (int other = 1; other < size_; ++other) {
          total += gathered[other * part.size() + i];
        }
        part[i] = total;
      }
    }
    MPI_Bcast(part.data(), count, MPI_DOUBLE, 0, handle(communicator_));
  }
}

double Ranks::sum(double value) const {
  sum(std::span(&value, 1));
  return value;
}

double Ranks::max(double value) const {
  if (size_ == 1) return value;
  // MPI_MAX leaves the treatment of NaN open, so NaN travels as a second number.
  std::array<double, 2> both = {
      std::isnan(value) ? -std::numeric_limits<double>::infinity() : value,
      std::isnan(value) ? 1.0 : 0.0};
  MPI_Allreduce(MPI_IN_PLACE, both.data(), 2, MPI_DOUBLE, MPI_MAX, handle(communicator_));
  return both[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[0];
}

bool Ranks::any(bool value) const { return max(value ? 1.0 : 0.0) > 0.5; }

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

void Halo::update(std::span<double> x) const {
  static_cast<void>(x);
  if (ranks.size() > 1) throw Error("Halo::update: no distribution over ranks", Exit::kInternal);
}

void Halo::add_back(std::span<double> y) const {
  static_cast<void>(y);
  if (ranks.size() > 1) throw Error("Halo::add_back: no distribution over ranks", Exit::kInternal);
}

}  // namespace acinus
