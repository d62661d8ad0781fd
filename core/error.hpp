#pragma once
/// Three kinds of failure, never mixed: the user's (Error with kBadInput or kFileError), ours
/// (ACINUS_ASSERT) and the numerics' (a returned Status that the step loop must handle).

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

namespace acinus {

/// Process exit codes, the contract with scripts.
enum class Exit : int {
  kDone = 0,
  kInternal = 1,
  kBadInput = 2,
  kCannotContinue = 3,
  kFileError = 4,
  kBeyond = 5,  ///< compared runs differ by more than was allowed
  kStopped = 75
};

/// Error for the user. Its message says where, the value found, the rule broken and what to do.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string message, Exit code = Exit::kBadInput)
      : std::runtime_error(std::move(message)), code_(code) {}
  Exit code() const { return code_; }

 private:
  Exit code_;
};

/// Throws Error(message, code) unless the condition holds. Always on.
inline void check(bool condition, const std::string& message, Exit code = Exit::kBadInput) {
  if (!condition) throw Error(message, code);
}

/// Outcome of a numerical stage. Not an exception: the step loop answers it by a smaller step.
struct [[nodiscard]] Status {
  bool ok = true;
  std::string cause;  ///< empty when ok
  static Status fine() { return {}; }
  static Status failed(std::string why) { return {false, std::move(why)}; }
};

}  // namespace acinus

#ifdef ACINUS_ENABLE_ASSERTS
#define ACINUS_ASSERT(condition)                                                           \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      std::fprintf(stderr, "%s:%d: internal error: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                        \
    }                                                                                      \
  } while (false)
#else
#define ACINUS_ASSERT(condition) static_cast<void>(0)
#endif
