/// Command `acinus import`.

#include <algorithm>
#include <map>
#include <memory>

#include "cli/command.hpp"
#include "cli/voxel_flag.hpp"
#include "core/parallel/clock.hpp"
#include "core/parallel/threads.hpp"
#include "core/units/dimension.hpp"
#include "runs/images/write_tissue.hpp"
#include "runs/session/guarded.hpp"
#include "runs/session/shell_quote.hpp"

namespace acinus::cli {
namespace {

struct ImportArguments {
  imaging::ImportOptions import;
  int nodes = runs::TissueScene{}.nodes;
  std::string out, voxel, unit, smallest, model = "dcm", border = "drop";
  int threads = 0;
  bool quiet = false;
};

imaging::ImportOptions options_of(const ImportArguments& a) {
  imaging::ImportOptions o = a.import;
  if (!a.voxel.empty()) o.read.voxel = parse_voxel(a.voxel);
  if (!a.unit.empty()) o.read.unit = quantity_of("--unit", a.unit, kLength);
  if (!a.smallest.empty()) {
    constexpr Dimension kVolume{3, 0, 0};
    o.smallest = quantity_of("--smallest", a.smallest, kVolume);
  }
  o.keep_border = a.border == "keep";
  return o;
}

runs::TissueScene scene_of(const ImportArguments& a) {
  return {
      static_cast<runs::CellModel>(runs::choice_index(runs::kChoices<runs::CellModel>, a.model)),
      a.nodes};
}

void print_left_out(const imaging::ImportedTissue& t, const std::string& folder) {
  constexpr std::size_t kMostNamed = 5;
  std::map<std::string, std::vector<const imaging::LeftOut*>> by_reason;
  for (const imaging::LeftOut& l : t.left_out) by_reason[l.why].push_back(&l);
  for (const auto& [why, all] : by_reason) {
    std::string names;
    for (std::size_t k = 0; k < std::min(kMostNamed, all.size()); ++k)
      names += fmt::format("{}{} near ({:.4g}, {:.4g}, {:.4g}) um", k == 0 ? "" : "; ",
                           all[k]->label, all[k]->center[0], all[k]->center[1], all[k]->center[2]);
    fmt::print("left out: {} ({}: label {}{})\n", why, all.size(), names,
               all.size() > kMostNamed ? "; ..." : "");
  }
  if (!t.left_out.empty()) fmt::print("all that is left out: {}/left_out.csv\n", folder);
}

void print_result(const ImportArguments& a, const imaging::ImportedTissue& t,
                  const std::vector<std::string>& written, double seconds) {
  for (const std::string& w : t.warnings) fmt::print(stderr, "acinus: warning: {}\n", w);
  if (a.quiet) return;
  double least = t.cell.front().volume, most = least, sum = 0;
  int at_vessel = 0;
  for (const imaging::ImportedCell& c : t.cell) {
    least = std::min(least, c.volume);
    most = std::max(most, c.volume);
    sum += c.volume;
    at_vessel += c.at_vessel ? 1 : 0;
  }
  fmt::print("{}: {} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} um\n", a.import.image, t.size[0],
             t.size[1], t.size[2], t.voxel[0], t.voxel[1], t.voxel[2]);
  fmt::print("{} cells of {:.4g} to {:.4g} um^3, mean {:.4g}; {} pairs touch\n", t.cell.size(),
             least, most, sum / static_cast<double>(t.cell.size()), t.touching.size());
  if (!t.vessel.empty())
    fmt::print("{} vessel surface{}, touched by {} cells\n", t.vessel.size(),
               t.vessel.size() == 1 ? "" : "s", at_vessel);
  print_left_out(t, a.out);
  fmt::print("{:.1f} s; run it with: acinus run {}\n", seconds,
             runs::quote_for_shell(written.front()));
}

int run(const ImportArguments& a) {
  set_threads(a.threads > 0 ? a.threads : processor_count());
  const imaging::ImportOptions o = options_of(a);
  const double before = wall_seconds();
  const imaging::ImportedTissue tissue = imaging::import_image(o);
  const std::vector<std::string> written = runs::write_tissue(tissue, o, scene_of(a), a.out);
  print_result(a, tissue, written, wall_seconds() - before);
  return 0;
}

/// Refuses options without effect in this combination.
void check_effects(const CLI::App& command, const ImportArguments& a) {
  check(command.count("--nodes") == 0 || a.model != "cbm",
        "--nodes is for deformable cells, and --model cbm makes none. Leave one out.");
  check(command.count("--unit") == 0 || command.count("--voxel") == 0,
        "--unit has no effect beside --voxel, which says all. Leave one out.");
}

void add_reading(CLI::App& command, ImportArguments& a) {
  command
      .add_option("--voxel", a.voxel,
                  "sides of a voxel, \"0.5 um\" or \"0.5 um, 0.5 um, 1 um\" (default: as the file "
                  "says)")
      ->type_name("LENGTHS");
  command.add_option("--unit", a.unit, "unit of the voxel sizes in the file, whatever it says")
      ->type_name("LENGTH");
  command
      .add_option("--channel", a.import.read.channel,
                  "which channel or time holds the labels, from 0")
      ->type_name("N")
      ->check(CLI::Range(0, 100000));
  command
      .add_option("--dataset", a.import.read.dataset,
                  "where in an HDF5 file or a folder of OME-Zarr the labels are")
      ->type_name("PATH");
  command
      .add_option("--level", a.import.read.level,
                  "which resolution of OME-Zarr, from 0, the finest (default: 0)")
      ->type_name("N")
      ->check(CLI::Range(0, 100));
  command
      .add_option("--background", a.import.background,
                  "the label that is background besides 0; 0: no other is (default: one that "
                  "encloses the image is asked about)")
      ->type_name("N")
      ->check(CLI::Range(0u, 4294967295u));
}

}  // namespace

Command add_import(CLI::App& app) {
  CLI::App* command = add_command(
      app, "import", "make a scene from a label image: cells and vessels as microscopy shows them",
      "acinus import labels.tif --out tissue --voxel \"0.5 um, 0.5 um, 1 um\"\n"
      "         acinus import labels.nii.gz --vessels vessels.nii.gz --border keep --out tissue");
  const auto arguments = std::make_shared<ImportArguments>();
  ImportArguments& a = *arguments;
  command
      ->add_option("IMAGE", a.import.image,
                   "label image, one number a cell: .tif (OME, ImageJ), .nii, .nii.gz, .mha, .mhd, "
                   ".nrrd, .nhdr, .h5, a folder of OME-Zarr")
      ->required();
  command->add_option("--out", a.out, "folder to make: scene.json, cells.vtk, cells.csv")
      ->type_name("FOLDER")
      ->required();
  add_reading(*command, a);
  CLI::Option* vessels = command
                             ->add_option("--vessels", a.import.vessels,
                                          "a second image of the same size, not 0 inside vessels")
                             ->type_name("IMAGE");
  command->add_option("--vessel-label", a.import.vessel_label, "the label that stands for vessels")
      ->type_name("N")
      ->excludes(vessels)
      ->check(CLI::Range(1u, 4294967295u));
  command
      ->add_option("--model", a.model, "dcm, cbm or zoom: deformable in the middle (default: dcm)")
      ->check(CLI::IsMember({"dcm", "cbm", "zoom"}));
  command->add_option("--nodes", a.nodes, "nodes of a cell's mesh (default: 162)")
      ->type_name("N")
      ->check(CLI::IsMember({42, 92, 162, 252, 362, 642, 1442, 2562}));
  command
      ->add_option("--border", a.border,
                   "cells that the border cuts off: drop, or keep between mirror walls (default: "
                   "drop)")
      ->check(CLI::IsMember({"drop", "keep"}));
  command
      ->add_option("--smallest", a.smallest,
                   "smaller labels are left out (default: a tenth of the usual volume)")
      ->type_name("VOLUME");
  command
      ->add_option("--smoothing", a.import.smoothing,
                   "how far walls are smoothed, in voxels, standard deviation (default: 0.7)")
      ->type_name("VOXELS")
      ->check(CLI::Range(0.3, 5.0));
  command->add_flag("--split", a.import.split, "every connected piece of a label is a cell");
  add_threads(*command, a.threads);
  command->add_flag("--quiet", a.quiet, "errors and warnings only");
  return {command, [arguments, command] {
            check_effects(*command, *arguments);
            return runs::run_guarded(arguments->import.image, [&] { return cli::run(*arguments); });
          }};
}

}  // namespace acinus::cli
