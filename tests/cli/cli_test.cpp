#include "cli/cli.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/wall_time.hpp"
#include "core/error.hpp"
#include "runs/session/shell_quote.hpp"
#include "tests/messages.hpp"
#include "tests/paths.hpp"

namespace acinus::cli {
namespace {

struct Outcome {
  int code;
  std::string text;  ///< stdout and stderr
};

Outcome call(const std::string& arguments) {
  FILE* pipe = popen((test::program_path() + " " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {-1, "popen failed"};
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) {
    text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

std::string output_of_bash(const std::string& line) {
  // popen() asks sh, which need not know $'...'.
  const std::string file = testing::TempDir() + "line" + std::to_string(getpid()) + ".sh";
  std::ofstream(file) << line;
  FILE* pipe = popen(("bash " + file).c_str(), "r");
  std::string text;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  std::remove(file.c_str());
  return text;
}

/// Commands, as the program's help lists them.
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

const std::string kScene = test::source_path("runs/scenes/two_cells.json");

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
    EXPECT_CONTAINS(outcome.text, "Example: acinus " + command);
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

TEST(Cli, AFirstWordThatIsNoCommandIsExplained) {
  EXPECT_CONTAINS(call("rnu").text, "Did you mean \"run\"?");
  EXPECT_CONTAINS(call("clump.json").text, "acinus run clump.json");
  EXPECT_CONTAINS(call("nonsense").text, "no such command");
  const Outcome help = call("help");
  EXPECT_EQ(help.code, 0);
  EXPECT_CONTAINS(help.text, "calibrate");
}

TEST(Cli, AFolderOfThatNameDoesNotHideAShippedScene) {
  EXPECT_EQ(call("check calibration").code, 0) << "the source tree has a folder calibration";
}

TEST(Cli, MissingFilesExitWithFour) {
  EXPECT_EQ(call("check /no/such/scene.json").code, 4);
  EXPECT_EQ(call("run /no/such/scene.json").code, 4);
  const Outcome misspelt = call("run twocells");
  EXPECT_EQ(misspelt.code, 4);
  EXPECT_CONTAINS(misspelt.text, "Did you mean \"two_cells\"?");
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

TEST(Cli, OptionsWithoutEffectAreRefused) {
  for (const std::string& arguments : std::vector<std::string>{
           "run " + kScene + " --until 900d", "run " + kScene + " --until-cells 50",
           "run " + kScene + " --out ''", "run ''", "new two_cells ''", "explain ''",
           "check " + kScene + " --set ''", "mesh vessels lobule_hybrid --out ''",
           "run " + kScene + " --sharing random", "run " + kScene + " --quiet --progress json",
           "openvt relax11 --cells 20",
           "calibrate --cells 15 --set 'capsule.min_radius=30 um' --out a.json",
           "explain --markdown radius", "explain --observables radius", "study example --tasks 2",
           "study example --task 1", "study example --dry-run --overwrite",
           "study example --report --jobs 2"}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.text;
    EXPECT_NE(outcome.text, "") << arguments;
  }
}

TEST(Cli, WordsInQuotesAreTheSameWordsToAShell) {
  for (const std::string& word : std::vector<std::string>{
           "", "plain", "a b", "it's", "$HOME", "`ls`", "a\\b", "line\nend", "\t",
           "Sch\xe4"
           "del",
           "\x7f",
           "na\xc3\xaf"
           "ve",
           "~", "-x", "#", "!", "a;b&c|d", "*?[x]{1,2}", "'\n\\\xff"}) {
    EXPECT_EQ(runs::quote_for_shell(word).find('\n'), std::string::npos) << "one line";
    EXPECT_EQ(output_of_bash("printf %s " + runs::quote_for_shell(word)), word);
  }
  EXPECT_EQ(without_flag("acinus calibrate --fresh --out a", "--fresh"),
            "acinus calibrate --out a");
  EXPECT_EQ(without_flag("acinus calibrate --fresh", "--fresh"), "acinus calibrate");
  EXPECT_EQ(without_flag("acinus calibrate --freshly", "--fresh"), "acinus calibrate --freshly");
}

TEST(Cli, PeriodsThatFillTheDiskOrNeverEndAreRefused) {
  const auto text_of = [](const std::string& set) {
    const Outcome outcome = call("check " + kScene + " --set time.end=1h --set '" + set + "'");
    EXPECT_EQ(outcome.code, 2) << set << "\n" << outcome.text;
    return outcome.text;
  };
  EXPECT_CONTAINS(text_of("output.every=1e-9 s"),
                  "/output/every = \"1e-9 s\": asks for 3.6e+12 frames until /time/end = \"3600 "
                  "s\"; at most 1e+06 are possible. Raise it to at least \"0.0036 s\"");
  for (const char* key : {"motility.random=true\' --set \'motility.grid", "life.grid",
                          "output.every", "time.min_step=1e-7 s\' --set \'time.step"})
    EXPECT_CONTAINS(text_of(std::string(key) + "=1e-7 s"), " asks for ") << key;
  EXPECT_EQ(call("check " + kScene + " --set time.end=1h --set 'output.every=0.0036 s'").code, 0);
}

TEST(Cli, ExplainsAnObservableAndABlockOfOneName) {
  const std::string text = call("explain cells").text;
  EXPECT_CONTAINS(text, "cells\n  number of cells\n");
  EXPECT_CONTAINS(text, "  type     block\n");
}

TEST(Cli, ManualPageHasEveryCommandAndNoStrayRequest) {
  const std::string page = call("explain --man").text;
  for (const char* command : {"run", "explain", "infer", "permedcoe", "bench"})
    EXPECT_CONTAINS(page, fmt::format("\n.SS acinus {}\n", command));
  EXPECT_CONTAINS(page, "\n.TP\n\\fB\\-\\-out\\fR DIR\nrun folder");
  EXPECT_CONTAINS(page, "Exit codes: 0 done");
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('.')) continue;
    const std::string request = line.substr(0, line.find(' '));
    EXPECT_CONTAINS(" .TH .ad .SH .SS .TP .PP .nf .fi .B .I ", " " + request + " ") << line;
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
}  // namespace acinus::cli
