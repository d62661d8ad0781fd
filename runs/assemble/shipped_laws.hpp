#pragma once
/// Stiffness laws that come with the program, so that scenes with the cells of Table 1 need no
/// calibration of their own.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Files of the shipped laws, by name.
std::vector<std::string> shipped_laws();

/// File of a law that is given as a file or by the name of a shipped one.
/// @throws Error if there is neither
std::string law_file(const std::string& given);

/// Cells of a law in words, e.g. "cells of 12 um, 162 nodes, K_V = 2500 Pa, W = 1e-5 J/m^2"; the
/// error if the file cannot be read.
std::string describe_law(const std::string& file);

/// Shipped law for a cell type of a scene: of cells with the same constants, calibrated with the
/// same settings of contact, whatever the quadrature.
/// @return the law file; empty if there is none
std::string find_shipped_law(const Scene& scene, const CellType& type);

/// Replaces stiffness_correction "auto" of every cell type that a shipped law fits by its file.
void use_shipped_laws(Scene& scene);

/// Replaces the remaining "auto" by "none" if the scene may have spheres, for uses that never step
/// and need no calibration.
/// @return the cell types concerned
std::vector<std::string> leave_out_calibrations(Scene& scene);

}  // namespace acinus::runs
