#pragma once
/// Rules between keys of a scene; what concerns one key alone stands in the registry.

#include <string>

#include "runs/scene/fault_report.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Adds every broken rule to the report. Rules about keys that are already reported are left out.
void check_rules(const Scene& scene, Report& report);

/// The part about steps and the times between frames and other events. @pre called by check_rules
void check_times(const Scene& scene, Report& report);

/// The part about the scene's experiment. It stands in the row of the experiment and so is defined
/// with the table of experiments (runs/experiments/experiment.cpp). @pre called by check_rules
void check_experiment(const Scene& scene, Report& report);

/// The part about growth, division and death. @pre called by check_rules
void check_life(const Scene& scene, Report& report);

/// The times of a course, the list at `pointer`, must never fall.
void check_course(const Schedule& course, const std::string& pointer, Report& report);

/// Rule of experiments on one deformable cell: there is one.
void check_one_cell(const Scene& scene, Report& report);

/// The part about cortices that flow. @pre called by check_rules
void check_single_cell(const Scene& scene, Report& report);

/// The part about the law of contact. @pre called by check_rules
void check_contact_law(const Scene& scene, Report& report);

/// The part about what acts within deformable cells. @pre called by check_rules
void check_inside(const Scene& scene, Report& report);

/// True if the pipette ever sucks.
bool has_suction(const PipetteBlock& pipette);

/// Model of a listed cell.
CellModel model_of(const Scene& scene, const CellEntry& cell);

/// The part about the zoom. @pre called by check_rules
void check_zoom(const Scene& scene, Report& report);

/// The part about one region, which stands at `pointer`; one that moves is for the zoom only.
void check_region(const Region& region, const std::string& pointer, Report& report);

}  // namespace acinus::runs
