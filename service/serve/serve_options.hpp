#pragma once
/// What `acinus serve` is told.

#include <string>
#include <vector>

namespace acinus::runs {

struct ServeOptions {
  std::string data = "acinus_service";  ///< folder of everything that is kept
  std::string address = "127.0.0.1";    ///< to listen on
  int port = 8642;                      ///< 0 = any that is free
  std::vector<std::string> names;       ///< further names by which browsers may call this machine
  bool token = true;                    ///< whoever asks must have the token
  int jobs = 0;                         ///< runs at a time; 0 = one a core
  int threads = 1;                      ///< of each run
  double checkpoint_every_s = 60;       ///< wall time that a kill may cost
  double max_walltime_s = 86400;        ///< of one run
  double max_memory = 0;                ///< bytes, of one run; 0 = its share of the machine's
  double max_run_bytes = 4e9;           ///< on disk, of one run
  double max_disk = 50e9;               ///< of the data folder; then nothing more is accepted
  int max_cells = 20000;                ///< of one run
  int max_waiting = 10000;              ///< runs in the queue
  double max_body = 16e6;               ///< bytes of one request
  bool quiet = false;
};

}  // namespace acinus::runs
