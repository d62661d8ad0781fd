#pragma once
/// Reference of all observables, by experiment.

#include <string>

namespace acinus::runs {

/// Name, unit and definition of every observable, one a line; numbered ones stand for all alike.
std::string explain_observables();

/// The same of one observable, of every kind of scene that has it; empty: there is none of this
/// name.
std::string explain_observable(const std::string& name);

/// The same as a Markdown page, docs/reference/observables.md.
std::string explain_observables_markdown();

}  // namespace acinus::runs
