#pragma once
/// Options of the service (`acinus serve`).

#include <string>
#include <vector>

namespace acinus::service {

/// Options and limits of the service.
struct ServeOptions {
  std::string data = "acinus_service";  ///< data folder
  std::string address = "127.0.0.1";    ///< to listen on
  int port = 8642;                      ///< 0 = any free port
  std::vector<std::string>
      names;          ///< additional host names under which browsers may access the service
  bool token = true;  ///< require the token
  int jobs = 0;       ///< concurrent runs; 0 = one per core
  int threads = 1;    ///< per run
  double checkpoint_every_s = 60;  ///< wall time between checkpoints
  double max_walltime_s = 86400;   ///< per run
  double max_memory = 0;           ///< bytes per run; 0 = its share of the machine's
  double max_run_bytes = 4e9;      ///< disk space per run
  double max_disk = 50e9;   ///< disk space of the data folder, beyond which no run is accepted
  int max_cells = 20000;    ///< per run
  int max_waiting = 10000;  ///< queued runs
  double max_body = 16e6;   ///< bytes per request
  bool quiet = false;
};

}  // namespace acinus::service
