#pragma once
/// Times of frames besides the first and the last.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Next moment after `time`, s after t = 0, at which a wall or the capsule opens; infinity if
/// none does.
double next_opening(const Scene& scene, double time);

/// Next moment after `time` for which output.after_opening asks a frame: an opening, or 1 s
/// times a power of 10^(1 / after_opening) after the last one. Infinity if there is none.
double next_frame_of_opening(const Scene& scene, double time);

/// Next moment after `time` of a frame, output.every included: no step goes beyond it.
double next_frame(const Scene& scene, double time);

}  // namespace acinus::runs
