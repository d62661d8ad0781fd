#include "runs/commands/cli.hpp"
#include "runs/commands/wall_time.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

struct Outcome {
  int code;
  std::string text;  ///< stdout and stderr
};

Outcome call(const std::string& arguments) {
  FILE* pipe = popen((std::string(ACINUS_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {-1, "popen failed"};
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) {
    text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

/// The commands, as the program's help lists them.
std::vector<std::string> command_names() {
  std::istringstream help(call("--help").text);
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(help, line) && !(listed && line.empty());) {
    if (listed && line.size() > 2 && line[2] != ' ')
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    listed = listed || line == "Subcommands:";
  }
  return names;
}

const std::string kScene = ACINUS_SOURCE_DIR "/runs/scenes/two_cells.json";

TEST(Cli, WallTimes) {
  EXPECT_EQ(parse_wall_time("10min"), 600);
  EXPECT_EQ(parse_wall_time("23h30m"), 84600);
  EXPECT_EQ(parse_wall_time("600 s"), 600);
  EXPECT_EQ(parse_wall_time(" 1d 2h 3min 4.5s "), 93784.5);
  for (const char* text : {"", " ", "10", "10 x", "h", "-1h", "1e999h", "nan s", "inf s", "1h30"}) {
    EXPECT_THROW(parse_wall_time(text), Error) << text;
  }
}

TEST(Cli, HelpOfEveryCommandHasAnExample) {
  const std::vector<std::string> commands = command_names();
  EXPECT_GE(commands.size(), 10U);
  for (const std::string& command : commands) {
    const Outcome outcome = call(command + " --help");
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_NE(outcome.text.find("Example: acinus " + command), std::string::npos) << outcome.text;
  }
  EXPECT_EQ(call("--help").code, 0);
}

TEST(Cli, UsageErrorsExitWithTwo) {
  for (const std::string& arguments : std::vector<std::string>{
           "", "rnu", "run", "run " + kScene + " --no-such-flag", "run " + kScene + " --threads 0",
           "run " + kScene + " --threads x", "run " + kScene + " --resume --overwrite",
           "run " + kScene + " --until-cells 0", "run " + kScene + " --until-cells 1.5",
           "run " + kScene + " --until 5", "run " + kScene + " --max-walltime 5",
           "run " + kScene + " --progress xml", "check " + kScene + " --set time.end=5",
           "explain cell.raduis", "explain radius --markdown", "bench no-such-bench",
           "new no_such_scene /tmp/x"}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.text;
    EXPECT_NE(outcome.text, "") << arguments;
  }
}

TEST(Cli, AFolderOfThatNameDoesNotHideAShippedScene) {
  EXPECT_EQ(call("check calibration").code, 0) << "the source tree has a folder calibration";
}

TEST(Cli, MissingFilesExitWithFour) {
  EXPECT_EQ(call("check /no/such/scene.json").code, 4);
  EXPECT_EQ(call("run /no/such/scene.json").code, 4);
  const Outcome misspelt = call("run twocells");
  EXPECT_EQ(misspelt.code, 4);
  EXPECT_NE(misspelt.text.find("Did you mean \"two_cells\"?"), std::string::npos) << misspelt.text;
}

TEST(Cli, ReadersExitWithZero) {
  for (const std::string& arguments : std::vector<std::string>{
           "check " + kScene, "check " + kScene + " --resolved", "schema", "explain",
           "explain cell.radius", "list", "--version", "bench",
           "check " + kScene + " --set time.end=3h --set 'cells.list.0.radius=11 um'",
           "check --set time.end=3h " + kScene, "check two_cells"}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.text;
    EXPECT_NE(outcome.text, "") << arguments;
  }
}

TEST(Cli, CheckPrintsTheReportOfTheReader) {
  const Outcome outcome = call("check " + kScene + " --set cells.mode=dcm");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.text,
            "--set cells.mode=dcm: /cells/mode: unknown key. Did you mean \"model\"? "
            "(acinus explain cells.model)\n");
}

}  // namespace
}  // namespace acinus::runs
