#pragma once
/// What several processes do before they step: where one of them fails, all end, and one says why.

#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"

namespace acinus::runs {

/// Another process failed and says why.
class FailedElsewhere : public std::exception {
 public:
  explicit FailedElsewhere(int code) : code_(code) {}
  int code() const { return code_; }
  const char* what() const noexcept override { return "another process failed"; }

 private:
  int code_;
};

/// Calls f on every process and comes back when all have done so.
/// @return what f returns here
/// @throws what f threw, on the first process where it did; FailedElsewhere on all others
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

/// Throws unless all processes have the same text, such as the scene they read.
/// @param what  named in the message
void check_alike(const Ranks& ranks, const std::string& text, const std::string& what);

/// The text that the first process with one has; empty if none has.
std::string first_text(const Ranks& ranks, const std::string& text);

/// The threads of this process, if they are not given: its share of the processors that it may use
/// with others. And what is wrong with how they are shared, or empty.
struct ThreadShare {
  int threads = 1;
  std::string warning;
};
ThreadShare share_processors(const Ranks& ranks, int wanted);

}  // namespace acinus::runs
