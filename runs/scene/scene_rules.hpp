#pragma once
/// Rules between keys of a scene; those of one key alone stand in the registry.

#include <string>

#include "runs/scene/fault_report.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Adds the broken rules of some keys to the report.
using SceneRule = void (*)(const Scene& scene, Report& report);

/// Adds every broken rule to the report. Rules about keys that are already reported are left out.
/// @param of_experiment  rule of the scene's experiment (runs/experiments/experiment.hpp) or null
void check_rules(const Scene& scene, Report& report, SceneRule of_experiment);

/// Checks steps and the times between frames and other events. @pre called by check_rules
void check_times(const Scene& scene, Report& report);

/// Checks growth, division and death. @pre called by check_rules
void check_life(const Scene& scene, Report& report);

/// Checks substances, exchange and responses to them. @pre called by check_rules
void check_substances(const Scene& scene, Report& report);

/// Checks that the times of a course, the list at `pointer`, never fall.
void check_course(const Schedule& course, const std::string& pointer, Report& report);

/// Checks cortices that flow. @pre called by check_rules
void check_single_cell(const Scene& scene, Report& report);

/// Checks adhesions between cell types. @pre called by check_rules
void check_pair_adhesions(const Scene& scene, Report& report);

/// Checks the law of contact. @pre called by check_rules
void check_contact_law(const Scene& scene, Report& report);

/// Checks nuclei and contraction of deformable cells. @pre called by check_rules
void check_inside(const Scene& scene, Report& report);

/// Checks that the scene has a cell type of this name, the value at `pointer`; "" is no name.
void check_type_name(const Scene& scene, const std::string& type, const std::string& pointer,
                     Report& report);

/// True if the pipette ever sucks.
bool has_suction(const PipetteBlock& pipette);

/// Model of a listed cell.
CellModel model_of(const Scene& scene, const CellEntry& cell);

/// Checks the zoom. @pre called by check_rules
void check_zoom(const Scene& scene, Report& report);

/// Checks one region, the block at `pointer`; regions that move are for the zoom only.
void check_region(const Region& region, const std::string& pointer, Report& report);

}  // namespace acinus::runs
