#pragma once
/// Reference of all observables, by experiment.

#include <string>

namespace acinus::runs {

/// Name, unit and definition of every observable, one a line; numbered ones stand for all alike.
std::string explain_observables();

/// The same as a Markdown page, docs/reference/observables.md.
std::string explain_observables_markdown();

}  // namespace acinus::runs
