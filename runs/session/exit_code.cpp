#include "runs/session/exit_code.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "core/error.hpp"
#include "runs/session/together.hpp"

namespace acinus::runs {

int exit_code_of(const std::function<int()>& work) {
  try {
    return work();
  } catch (const FailedElsewhere& failed) {
    return failed.code();
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "internal error\n");
  }
  return static_cast<int>(Exit::kInternal);
}

}  // namespace acinus::runs
