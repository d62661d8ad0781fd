#pragma once
/// A law read off a squeeze moment by moment. Confluent deformable cells hardly push until they
/// fill their room, then as hard as their bulk: no power of the overlap follows both.

#include "calibration/clump.hpp"
#include "calibration/law.hpp"

namespace acinus::calibration {

/// The mean force on the inner ones of spheres with a law in the places of a moment, nN.
double force_with(const Law& law, const Moment& moment, const cbm::Params& sphere,
                  const Squeeze& squeeze);

/// The law whose table makes spheres push as the cells did, from the moment on at which these push
/// least after the first tenth of the squeeze. a0 is the modulus at which spheres rest where the
/// deformable cells do. Moduli never fall with d. First all spheres get the modulus that the moment
/// asks for, at the mean d; then what they lack or have too much with moduli after their own d is
/// made up for.
/// @param known  what the law has besides: a1, range and what it was found for
/// @return `known` itself where the squeeze says too little for a table
Law tabulate_law(const Squeeze& squeeze, const cbm::Params& sphere, const Law& known);

}  // namespace acinus::calibration
