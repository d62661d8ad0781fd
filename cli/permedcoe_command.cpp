/// Command `acinus permedcoe`.

#include "runs/openvt/permedcoe.hpp"

#include <memory>

#include "cli/published_case.hpp"

namespace acinus::cli {
namespace {

int push(const runs::OpenVtOptions& o) {
  runs::Pushing found;
  const int code = runs::run_pushing(o, found);
  if (code == 0 && !o.quiet)
    fmt::print("distance of the centres {:.3g} um at the start, {:.3g} um after {:.3g} min\n",
               found.distance.front(), found.distance.back(), found.time.back());
  return code;
}

int grow(const std::string& what, const runs::OpenVtOptions& o) {
  runs::Growth found;
  const int code = runs::run_growth(what, o, found);
  if (code == 0 && !o.quiet)
    fmt::print("{:.0f} cells, {:.0f} um across after {:.4g} h\n", found.cells.back(),
               found.diameter.back(), found.time.back());
  return code;
}

int run_permedcoe(const std::string& what, const runs::OpenVtOptions& o) {
  return what == "pushing" ? push(o) : grow(what, o);
}

}  // namespace

Command add_permedcoe(CLI::App& app, const std::string& command_line) {
  CLI::App* command = add_command(app, "permedcoe", "cases of PerMedCoE's benchmark with their CSV",
                                  "acinus permedcoe pushing --model dcm --csv distance.csv");
  const auto arguments = std::make_shared<CaseArguments>();
  command
      ->add_option("WHAT", arguments->what,
                   "pushing: two cells pushed together; monolayer: a layer after Bru et al.; "
                   "spheroid: a spheroid after Freyer and Sutherland")
      ->required()
      ->check(CLI::IsMember({"pushing", "monolayer", "spheroid"}));
  add_case_options(*command, "permedcoe", "CSV file of the result", *arguments);
  return {command, [arguments, &command_line] {
            arguments->options.command_line = command_line;
            return run_case("permedcoe", *arguments, run_permedcoe);
          }};
}

}  // namespace acinus::cli
