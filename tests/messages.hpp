#pragma once
/// Messages of errors, tested by their path, rule and remedy rather than their full wording.

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "core/error.hpp"

namespace acinus::test {

/// Presence of a part. " ... " in it stands for anything: all its pieces must follow one another.
inline bool contains(std::string_view text, std::string_view part) {
  constexpr std::string_view kAnything = " ... ";
  for (std::size_t end = 0; end != part.npos;) {
    end = part.find(kAnything);
    const std::string_view piece = part.substr(0, end);
    const std::size_t at = text.find(piece);
    if (at == text.npos) return false;
    text.remove_prefix(at + piece.size());
    if (end != part.npos) part.remove_prefix(end + kAnything.size());
  }
  return true;
}
#define EXPECT_CONTAINS(text, part) \
  EXPECT_PRED2(::acinus::test::contains, std::string(text), std::string(part))

/// Message of the Error that `call` throws, "" if it throws none; checks the exit code.
template <class Call>
std::string fault_of(const Call& call, Exit code = Exit::kBadInput) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "";
}

/// Message of the Error that `call` must throw; checks the exit code.
template <class Call>
std::string message_of(const Call& call, Exit code = Exit::kBadInput) {
  const std::string fault = fault_of(call, code);
  EXPECT_NE(fault, "") << "no Error was thrown";
  return fault;
}

}  // namespace acinus::test
