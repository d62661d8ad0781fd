#pragma once
/// Copies the values of a document into fields, key by key of a registry; faults go into the
/// report.

#include <functional>
#include <string>

#include "runs/scene/document.hpp"
#include "runs/scene/fault_report.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Reads every key that `describe` shows; keys of the document that it does not show are reported.
/// @param prefix  stands before a key's name in hints: `acinus explain study.seeds`
void read_keys(const Document& document, Report& report,
               const std::function<void(Visitor&)>& describe, const std::string& prefix = "");

/// Name made of a file name: its stem with everything that cannot stand in a name replaced.
std::string default_name(const std::string& label);

/// Letters, digits, _ and -, at most 100.
bool is_name(const std::string& text);

}  // namespace acinus::runs
