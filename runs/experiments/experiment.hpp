#pragma once
/// What a scene measures over time, by the name in its `experiment` key.

#include <map>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/experiments/snapshot.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Named series, one number per written frame; a profile holds the numbers of the last frame only.
/// Kept in checkpoints. What has no value at a frame is NaN, in files null.
using Measures = std::map<std::string, std::vector<double>>;

/// Shells (rings) of a profile of growing tissue.
inline constexpr int kShells = 10;

/// Adds the numbers of one frame that follow from it alone: time_s and cells of any experiment and
/// the series of the scene's own. What needs the frames before, or more than the snapshot, is added
/// by observe_frame (observe.hpp).
void sample_experiment(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                       Measures& measures);

/// A box cut in two halves across x, one of each model: pressure and density of each half.
/// Pressure is the mean contact pressure of the half's cells; density is their number per volume
/// between the walls on their side of the plane midway between the innermost layers of the two
/// models.
void sample_patch(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                  Measures& measures);

/// A clump in a capsule that shrinks and may open: capsule_radius_um, and of the cell
/// nearest its centre overlap (d, cbm::relative_overlap), shell_overlap (mean over the 14
/// nearest cells), contact_force_nN (sum of sizes), normal_force_nN (sum of normal forces, positive
/// pressing), contacts, pressure_Pa (contact) and volume_relative (to the reference volume).
/// Without a capsule the cell nearest the origin is looked at.
void sample_capsule(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                    Measures& measures);

/// A clump that is compressed, held and let go: overlap (mean relative overlap of a cell and
/// its 14 nearest, over all cells), height_um and width_um (extent of the clump along the axis of
/// the first wall that opens, z if none does, and across it: that of the even ellipsoid whose
/// points spread as the cells' centres do) and for each of the three, since the release
/// (calibration/recovery.hpp),
///   NAME_back_10s   share of the way that is done 10 s after the release
///   NAME_efold_h    time in which what is left then falls to 1/e
///   NAME_return_h   time until 1 % of the way is left; none while it goes on
///   NAME_recovered  the way over that from the first frame to the release
/// and relaxation_time_h, the return of the height if a wall opens, else of the overlap
/// [VanLiedekerke2020, Appendix 1, Fig. 12c].
void sample_relaxation(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                       Measures& measures);

/// A growing tissue: "spheroid" in space, "monolayer" in the plane z = const. Distances r are those
/// of the cells' centres from their mean, in a monolayer horizontally.
/// Series: mean_pressure_Pa (contact pressure), mean_cytosol_pressure_Pa (within; what the paper
/// calls pressure; a sphere's contact pressure again),
///   radius_of_gyration_um    sqrt(1/N sum |x_i - x_com|^2), always in space
///                            [VanLiedekerke2020, Sect. 3.2]
///   inner_*, outer_*         cells, their mean pressure_Pa (contact), cytosol_pressure_Pa and
///                            density, of those below 1/3 and from 2/3 of the largest r on; density
///                            per mm^3, in a monolayer per mm^2
///   shell_width_um, shell_<k>_*  cells, cytosol_pressure_Pa, contact_pressure_Pa and density of
///                            shell (ring) k = 1 .. 10 of equal width up to the largest r
///   sphericity               mean of pi^(1/3) (6 V)^(2/3) / A, 1 for a sphere, 0.99 for its mesh
///   height_um, height_to_width  monolayer: mean extent along z, and its ratio to the mean of those
///                            along x and y
/// The last three are for deformable cells only. Profiles of the last frame over the same shells:
/// profile_radius_um (middle), cytosol_pressure_profile_Pa (the paper's), pressure_profile_Pa
/// (contact), density_profile. A shell without cells has density 0 and no pressure; while all r are
/// 0 every shell holds all cells and there is no density.
void sample_growth(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                   Measures& measures);

/// A deformable cell in an optical stretcher: long_axis_um, its extent along the beams, and
/// short_axis_um, across them (mean over 36 directions); long_axis_strain and short_axis_strain,
/// their growth since the first frame relative to what they were there; stress_Pa on the surface
/// where the axis of the beams meets it, and cortex_friction_factor, that of the temperature.
/// [VanLiedekerke2020, Fig. 5 and 13]
void sample_stretcher(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                      Measures& measures);

}  // namespace acinus::runs
