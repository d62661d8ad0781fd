#pragma once
/// Tabulated law, from a compression snapshot by snapshot. Confluent deformable cells hardly repel
/// each other until they fill the available volume, then as strongly as their bulk modulus: no
/// power of the overlap fits both.

#include "calibration/compression.hpp"
#include "calibration/law.hpp"

namespace acinus::calibration {

/// Mean force, nN, on the inner cells when spheres with this law stand at the positions of a
/// snapshot.
double force_with(const Law& law, const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                  const std::vector<std::size_t>& inner);

/// Tabulates the modulus over the relative overlap d so that spheres at the positions of a snapshot
/// carry the mean force of the deformable cells. Snapshots before the least force are left out; it
/// is searched after the first tenth of the compression. Its first modulus is that at which
/// spheres rest where the deformable cells do. Moduli never fall with d. Below the clump's rest the
/// table leads to its first entry, which holds for two cells alone: the modulus with which a pair
/// of spheres rests at the overlap of a pair of deformable cells. First all spheres get the modulus
/// that fits the snapshot, at the mean d; then the error that remains with moduli by each sphere's
/// own d is corrected.
/// @param compression  snapshots of the deformable cells
/// @param sphere       constants of the spheres without a law
/// @param known        other members of the law: a1, range and parameters
/// @return `known` itself where the compression gives too little data for a table
Law tabulate_law(const Compression& compression, const cbm::Params& sphere, const Law& known);

}  // namespace acinus::calibration
