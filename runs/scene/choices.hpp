#pragma once
/// Keys whose value is one of a few names: their types, and the names in the order of the values.

#include <cstddef>
#include <string>
#include <vector>

#include "contact/surface.hpp"
#include "coupling/generate/domain.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/world/cycle.hpp"
#include "coupling/world/world.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/scene/experiment_list.hpp"
#include "runs/scene/substance_blocks.hpp"

namespace acinus::runs {

/// Model of cells. kZoom: deformable inside the zoom regions.
enum class CellModel { kDcm, kCbm, kZoom };
enum class CellSource { kList, kClump, kBox, kFill, kLobule, kMeshes };
/// Cause of a pull: a prescribed force, or a spring whose far end is moved.
enum class PullBy { kForce, kSpring };

/// Surface of vessels that cells touch: a round cone a segment, or one closed surface about them.
enum class VesselWalls { kCones, kMesh };

/// Named accuracies; kByKey: every key has its own default.
enum class Accuracy { kByKey, kFast, kBalanced, kFine };

template <class E>
inline constexpr const char* kChoices = nullptr;
template <>
inline constexpr const char* kChoices<Experiment> = kExperimentNames;
template <>
inline constexpr const char* kChoices<Accuracy> = "by-key|fast|balanced|fine";
template <>
inline constexpr const char* kChoices<CellModel> = "dcm|cbm|zoom";
template <>
inline constexpr const char* kChoices<CellSource> = "list|clump|box|fill|lobule|meshes";
template <>
inline constexpr const char* kChoices<PullBy> = "force|spring";
template <>
inline constexpr const char* kChoices<coupling::RegionKind> =
    "sphere|box|half_space|axis_distance|all|front|cells|vessel|pressure";
template <>
inline constexpr const char* kChoices<coupling::LobuleShape> = "pie|hexagon";
template <>
inline constexpr const char* kChoices<VesselWalls> = "cones|mesh";
template <>
inline constexpr const char* kChoices<coupling::VesselAnchors> = "ends|none";
template <>
inline constexpr const char* kChoices<contact::Quadrature> = "3-point|nodes|nodes-and-edges";
template <>
inline constexpr const char* kChoices<dcm::ContactLaw> = "cohesive|maugis-dugdale";
template <>
inline constexpr const char* kChoices<dcm::FrictionForm> = "surface|nodes";
template <>
inline constexpr const char* kChoices<coupling::Integrator> =
    "linearly-implicit|explicit-euler|newton";
template <>
inline constexpr const char* kChoices<coupling::Leaders> = "foremost|front|border|sector|nearest";
template <>
inline constexpr const char* kChoices<coupling::DivisionAxis> = "random|plane|given|vessel";
template <>
inline constexpr const char* kChoices<coupling::InhibitedBy> = "none|pressure|volume|density";
template <>
inline constexpr const char* kChoices<substances::FaceKind> = "no_flux|fixed|exchange";
template <>
inline constexpr const char* kChoices<CellPassage> = "pass|keep_out|membrane";
template <>
inline constexpr const char* kChoices<BoxFace> = "x_low|x_high|y_low|y_high|z_low|z_high";
template <>
inline constexpr const char* kChoices<coupling::Behaviour> =
    "growth|death|motility|chemotaxis|secretion|uptake|adhesion";
template <>
inline constexpr const char* kChoices<coupling::Signal> =
    "concentration|pressure|volume|contact_area|neighbours|layer|age";
template <>
inline constexpr const char* kChoices<coupling::Lattice> = "fcc|bcc";

/// Parts of "dcm|cbm|zoom".
std::vector<std::string> split_choices(const char* choices);

/// Part `index` of "dcm|cbm|zoom"; "" beyond its end.
std::string choice_name(const char* choices, int index);

/// Index of a name among the parts of "dcm|cbm|zoom"; -1: it is none of them.
int choice_index(const char* choices, const std::string& name);

/// Name of a value, as scenes write it.
template <class E>
std::string name_of_choice(E value) {
  return choice_name(kChoices<E>, static_cast<int>(value));
}

}  // namespace acinus::runs
