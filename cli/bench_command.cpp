/// Command `acinus bench`: runs the program acinus-bench that stands beside this one.

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "cli/command.hpp"
#include "runs/session/child.hpp"

namespace acinus::cli {
namespace {

int start_bench(std::vector<std::string>& words) {
  std::string program = runs::program_beside("acinus-bench");
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw Error(fmt::format("{}: cannot be started ({}). It is built with the option ACINUS_BENCH.",
                          program, std::strerror(errno)));
}

}  // namespace

Command add_bench(CLI::App& app) {
  CLI::App* command = add_command(
      app, "bench", "measure speed and error (acinus-bench); without NAME, list the names",
      "acinus bench dcm27 --json dcm27.json");
  command->set_help_flag();  // acinus-bench has its own
  command->prefix_command();
  return {command, [command] {
            std::vector<std::string> words = command->remaining();
            return start_bench(words);
          }};
}

}  // namespace acinus::cli
