#pragma once
/// Streams of random numbers of a random scene. Each part has its own, so that a change of one
/// leaves the others as they were.

#include <cstdint>

namespace acinus::bench {

enum SceneStream : std::uint64_t {
  kSceneStream,
  kLifeStream,
  kZoomStream,
  kSubstanceStream,
  kLawStream
};

}  // namespace acinus::bench
