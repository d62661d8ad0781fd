#pragma once
/// Agreement of several processes before they step: if one fails, all end and one reports why.

#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"

namespace acinus::runs {

/// Exception on the processes that did not fail; another one reports the cause.
class FailedElsewhere : public std::exception {
 public:
  explicit FailedElsewhere(int code) : code_(code) {}
  int code() const { return code_; }
  const char* what() const noexcept override { return "another process failed"; }

 private:
  int code_;
};

/// Calls f on every process and returns when all have finished.
/// @return result of f on this process
/// @throws exception of f on the first process where it failed; FailedElsewhere on all others
template <class F>
auto together(const Ranks& ranks, const F& f) {
  using Result = decltype(f());
  std::exception_ptr failed;
  int code = 0;
  const auto attempt = [&](const auto& work) {
    try {
      work();
    } catch (const Error& error) {
      failed = std::current_exception();
      code = static_cast<int>(error.code());
    } catch (...) {
      failed = std::current_exception();
      code = static_cast<int>(Exit::kInternal);
    }
  };
  const auto agree = [&] {
    if (ranks.is_alone()) {
      if (failed) std::rethrow_exception(failed);
      return;
    }
    const int worst = ranks.agree_worst(code);
    if (worst == 0) return;
    if (ranks.min(failed ? ranks.rank() : ranks.size()) == ranks.rank())
      std::rethrow_exception(failed);
    throw FailedElsewhere(worst);
  };
  if constexpr (std::is_void_v<Result>) {
    attempt(f);
    agree();
  } else {
    std::optional<Result> result;
    attempt([&] { result.emplace(f()); });
    agree();
    return std::move(*result);
  }
}

/// Checks that all processes have the same text, such as the scene they read.
/// @param what  name of the text in messages
/// @throws Error
void check_alike(const Ranks& ranks, const std::string& text, const std::string& what);

/// Text of the first process that has one; empty if none has.
std::string first_text(const Ranks& ranks, const std::string& text);

/// Number of threads of this process, by default its share of the processors it may use, the number
/// of processes on its machine, and a warning if threads outnumber processors.
struct ThreadShare {
  int threads = 1;
  int processes = 1;  ///< on this machine
  std::string warning;
};
ThreadShare share_processors(const Ranks& ranks, int wanted);

}  // namespace acinus::runs
