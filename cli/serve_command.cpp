/// Command `acinus serve`.

#include <filesystem>
#include <memory>
#include <new>

#include "cli/command.hpp"
#include "cli/sizes.hpp"
#include "cli/wall_time.hpp"
#include "service/serve/server.hpp"
#include "service/serve/submission.hpp"

namespace acinus::cli {
namespace {

struct ServeArguments {
  service::ServeOptions serve;
  bool no_token = false;
  std::string prepare;  ///< run folder of a submission to prepare; "" = none
  std::string preview;  ///< folder of a submission to draw; "" = none
  std::string checkpoint_every, max_walltime, max_memory, max_run_disk, max_disk, max_body;
};

int run(ServeArguments& a) {
  service::ServeOptions& o = a.serve;
  const auto read = [](double& value, const char* flag, const std::string& text, auto parse) {
    if (!text.empty()) value = flag_value(flag, text, parse);
  };
  read(o.checkpoint_every_s, "--checkpoint-every", a.checkpoint_every, parse_wall_time);
  read(o.max_walltime_s, "--max-walltime", a.max_walltime, parse_wall_time);
  read(o.max_memory, "--max-memory", a.max_memory, parse_size);
  read(o.max_run_bytes, "--max-run-disk", a.max_run_disk, parse_size);
  read(o.max_disk, "--max-disk", a.max_disk, parse_size);
  read(o.max_body, "--max-body", a.max_body, parse_size);
  o.token = !a.no_token;
  if (a.prepare.empty() && a.preview.empty()) {
    service::serve(o);
    return 0;
  }
  try {
    if (!a.preview.empty())
      service::write_preview(a.preview, o);
    else if (std::filesystem::exists(a.prepare + "/" + service::kEvaluationFile))
      service::prepare_evaluation(a.prepare, o);
    else
      service::prepare_submission(a.prepare, o);
  } catch (const std::bad_alloc&) {
    throw Error("to check this submission takes more memory than this service allows.");
  }
  return 0;
}

}  // namespace

Command add_serve(CLI::App& app) {
  CLI::App* command = add_command(app, "serve", "simulations over HTTP: a page, REST, UM-Bridge",
                                  "acinus serve --data service --jobs 2");
  const auto arguments = std::make_shared<ServeArguments>();
  ServeArguments& a = *arguments;
  service::ServeOptions& o = a.serve;
  command->add_option("--data", o.data, "folder of runs, queue and token (default: acinus_service)")
      ->type_name("DIR");
  command->add_option("--port", o.port, "port; 0: any that is free (default: 8642)")
      ->type_name("N")
      ->check(CLI::Range(0, 65535));
  command->add_option("--address", o.address, "address to listen on (default: 127.0.0.1)")
      ->type_name("IP");
  command
      ->add_option("--name", o.names, "additional host name accepted in requests; may be repeated")
      ->type_name("HOST")
      ->allow_extra_args(false);
  command->add_flag("--no-token", a.no_token, "whoever can reach the port may use it");
  command->add_option("--jobs", o.jobs, "runs at a time (default: one a core)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_option("--threads", o.threads, "threads of each run (default: 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command
      ->add_option("--checkpoint-every", a.checkpoint_every,
                   "wall time between checkpoints of a run (default: 60s)")
      ->type_name("WALL");
  command->add_option("--max-walltime", a.max_walltime, "most wall time of one run (default: 1d)")
      ->type_name("WALL");
  command
      ->add_option("--max-memory", a.max_memory,
                   "most memory of one run (default: its share of the machine's)")
      ->type_name("SIZE");
  command->add_option("--max-run-disk", a.max_run_disk, "most disk of one run (default: 4GB)")
      ->type_name("SIZE");
  command
      ->add_option("--max-disk", a.max_disk,
                   "size of the data folder from which on nothing is accepted (default: 50GB)")
      ->type_name("SIZE");
  command->add_option("--max-cells", o.max_cells, "most cells of one run (default: 20000)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  command->add_option("--max-waiting", o.max_waiting, "most runs in the queue (default: 10000)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  command->add_option("--max-body", a.max_body, "most of one request (default: 16MB)")
      ->type_name("SIZE");
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  // By the service itself; not for users.
  command->add_option("--prepare", a.prepare)->group("");
  command->add_option("--preview", a.preview)->group("");
  return {command, [arguments] { return cli::run(*arguments); }};
}

}  // namespace acinus::cli
