#pragma once
/// `acinus study` on the command line.

#include "runs/study/run_study.hpp"

namespace CLI {
class App;
}

namespace acinus::runs {

/// Adds the command; parsing it fills the options, which must live as long as the app.
void add_study_command(CLI::App& app, StudyOptions& options);

}  // namespace acinus::runs
