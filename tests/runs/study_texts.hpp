#pragma once
/// Studies of two spheres as texts, and what is wrong with them.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "runs/study/plan.hpp"
#include "runs/study/read_study.hpp"
#include "tests/messages.hpp"

namespace acinus::runs {

/// Study of two spheres; `more` stands after its variants.
inline std::string text_with(const std::string& more, const std::string& variants = R"(
    "slow": { "set": { "motility.grid": "60 s" } },
    "fast": { "extends": "slow", "set": { "motility.grid": "30 s" }, "seeds": [7] })") {
  return R"({
  "scene": "two_cells",
  "set": { "cells.model": "cbm", "time.end": "2 h" },
  "seeds": [1, 2],
  "variants": {)" +
         variants + "\n  }" + (more.empty() ? "" : ",\n  " + more) + "\n}\n";
}

inline StudyPlan parse(const std::string& text) { return parse_study(text, "s.json"); }

inline std::string fault_of(const std::string& text) {
  return test::fault_of([&] { parse(text); });
}

inline void expect_fault(const std::string& text, const std::vector<std::string>& parts) {
  const std::string fault = fault_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(fault.find(part), std::string::npos) << part << "\nis not in\n" << fault;
}

}  // namespace acinus::runs
