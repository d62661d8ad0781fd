#pragma once
/// A law read off a squeeze moment by moment. Confluent deformable cells hardly push until they
/// fill their room, then as hard as their bulk: no power of the overlap follows both.

#include <vector>

#include "calibration/clump.hpp"
#include "calibration/law.hpp"

namespace acinus::calibration {

/// The force on the central one of spheres with a law in the places of a moment, nN.
double force_with(const Law& law, const Moment& moment, const cbm::Params& sphere,
                  const Vec3& point);

/// The law whose table makes spheres push as the cells did, from the moment on at which these push
/// least after the first tenth of the squeeze. a0 is the modulus at which spheres rest where the
/// deformable cells do. Moduli never fall with d.
/// @param known  what the law has besides: a1, range and what it was found for
/// @return `known` itself where the squeeze says too little for a table
Law tabulate_law(const std::vector<Moment>& squeeze, const cbm::Params& sphere, const Vec3& point,
                 const Law& known);

}  // namespace acinus::calibration
