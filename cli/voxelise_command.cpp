/// Command `acinus voxelise`.

#include <filesystem>
#include <memory>

#include "cli/command.hpp"
#include "cli/voxel_flag.hpp"
#include "core/parallel/threads.hpp"
#include "core/units/dimension.hpp"
#include "imaging/write_image.hpp"
#include "io/disk.hpp"
#include "runs/images/voxelise_run.hpp"
#include "runs/session/guarded.hpp"

namespace acinus::cli {
namespace {

struct VoxeliseArguments {
  runs::VoxeliseRun voxelise;
  std::string out, voxel = "1 um", blur;
  bool no_vessels = false, quiet = false;
  int threads = 0;
};

int run(const VoxeliseArguments& a) {
  imaging::check_image_file(a.out);
  set_threads(a.threads > 0 ? a.threads : processor_count());
  runs::VoxeliseRun o = a.voxelise;
  o.vessels = !a.no_vessels;
  o.how.voxel = parse_voxel(a.voxel);
  if (!a.blur.empty()) o.how.blur = quantity_of("--blur", a.blur, kLength);
  const runs::RunImage made = runs::voxelise_run(o);
  imaging::write_image(a.out, made.cells.image);
  const std::string table = std::filesystem::path(a.out).replace_extension(".csv").string();
  io::write_text_file(table, imaging::labels_text(made.cells));
  if (a.quiet) return 0;
  fmt::print("{}: frame {}, {} x {} x {} voxels, {} cells{}; which label is which cell: {}\n",
             a.out, made.frame, made.cells.image.size[0], made.cells.image.size[1],
             made.cells.image.size[2], made.cells.cell.size(),
             made.cells.vessels == 0 ? std::string()
                                     : fmt::format(", vessels have label {}", made.cells.vessels),
             table);
  return 0;
}

}  // namespace

Command add_voxelise(CLI::App& app) {
  CLI::App* command =
      add_command(app, "voxelise", "make a label image of a run, as a microscope would show it",
                  "acinus voxelise lobule_hybrid.run --voxel \"0.7 um, 0.7 um, 1 um\" --blur \"0.7 "
                  "um\" --noise 0.3 --out labels.tif");
  const auto arguments = std::make_shared<VoxeliseArguments>();
  VoxeliseArguments& a = *arguments;
  command->add_option("RUN", a.voxelise.folder, "folder of a run")->required();
  command->add_option("--out", a.out, "the image: .tif, .mha or .nrrd; a table .csv beside it")
      ->type_name("FILE")
      ->required();
  command->add_option("--frame", a.voxelise.frame, "which frame, from 0 (default: the last)")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000000));
  command
      ->add_option("--voxel", a.voxel,
                   "sides of a voxel, \"0.5 um\" or \"0.5 um, 0.5 um, 1 um\" (default: 1 um)")
      ->type_name("LENGTHS");
  command->add_option("--blur", a.blur, "standard deviation of the blur (default: none)")
      ->type_name("LENGTH");
  command
      ->add_option("--noise", a.voxelise.how.noise,
                   "standard deviation of the noise at walls, of the step there (default: 0)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 2.0));
  command->add_option("--seed", a.voxelise.how.seed, "seed of the noise (default: 1)")
      ->type_name("N");
  command->add_flag("--no-vessels", a.no_vessels, "cells only");
  add_threads(*command, a.threads);
  command->add_flag("--quiet", a.quiet, "errors only");
  return {command, [arguments, command] {
            check(command->count("--seed") == 0 || arguments->voxelise.how.noise > 0,
                  "--seed is that of the noise, and there is none. Give --noise, or leave it out.");
            return runs::run_guarded(arguments->voxelise.folder,
                                     [&] { return cli::run(*arguments); });
          }};
}

}  // namespace acinus::cli
