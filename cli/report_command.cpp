/// Command `acinus report`.

#include "service/report/make_report.hpp"

#include <fmt/ranges.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/sizes.hpp"
#include "runs/session/guarded.hpp"

namespace acinus::cli {
namespace {

struct ReportArguments {
  service::ReportOptions report;
  std::string limit;
  bool quiet = false;
};

int run(ReportArguments& arguments) {
  if (!arguments.limit.empty())
    arguments.report.bytes =
        static_cast<std::size_t>(flag_value("--limit", arguments.limit, parse_size));
  const std::string file = service::write_report(arguments.report);
  if (!arguments.quiet) fmt::print("{}\n", file);
  return 0;
}

}  // namespace

Command add_report(CLI::App& app) {
  CLI::App* command =
      add_command(app, "report", "one page to open in a browser: 3D, plots, checks, comparison",
                  "acinus report lobule_hybrid.run --out lobule.html");
  const auto arguments = std::make_shared<ReportArguments>();
  service::ReportOptions& o = arguments->report;
  command
      ->add_option("WHAT", o.what,
                   "run folders (also of runs that go on), law files, folders of studies")
      ->type_name("PATH")
      ->required();
  command->add_option("--out", o.out, "the page (default: named after the first)")
      ->type_name("FILE.html");
  command->add_option("--png", o.png, "also a picture of it; needs Chromium or Chrome")
      ->type_name("FILE.png");
  command
      ->add_option("--title", o.titles,
                   "headline instead of the file's name; repeated: of the first, the second ...")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->add_option("--frames", o.most_frames, "most frames of a run (default: 50)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--limit", arguments->limit,
                   "size of the page; frames are left out to keep it (default: 8MB)")
      ->type_name("SIZE");
  command->add_flag("--quiet", arguments->quiet, "errors only");
  return {command, [arguments] {
            return runs::run_guarded(fmt::format("{}", fmt::join(arguments->report.what, ", ")),
                                     [&] { return cli::run(*arguments); });
          }};
}

}  // namespace acinus::cli
