#include "cli/cli.hpp"

#include "runs/program.hpp"

int main(int argc, char** argv) {
  return acinus::runs::run_program([&] { return acinus::cli::run_cli(argc, argv); });
}
