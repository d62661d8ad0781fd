#pragma once
/// A law read off a compression snapshot by snapshot. Confluent deformable cells hardly push until
/// they fill their room, then as hard as their bulk: no power of the overlap follows both.

#include "calibration/compression.hpp"
#include "calibration/law.hpp"

namespace acinus::calibration {

/// The mean force on the inner ones of spheres with a law in the places of a snapshot, nN.
double force_with(const Law& law, const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                  const std::vector<std::size_t>& inner);

/// The law whose table makes spheres push as the cells did, from the snapshot on at which these
/// push least after the first tenth of the compression. a0 is the modulus at which spheres rest
/// where the deformable cells do. Moduli never fall with d. First all spheres get the modulus that
/// the snapshot asks for, at the mean d; then what they lack or have too much with moduli after
/// their own d is made up for.
/// @param known  what the law has besides: a1, range and what it was found for
/// @return `known` itself where the compression says too little for a table
Law tabulate_law(const Compression& compression, const cbm::Params& sphere, const Law& known);

}  // namespace acinus::calibration
