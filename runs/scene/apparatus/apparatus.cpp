#include "runs/scene/apparatus/apparatus.hpp"

#include <algorithm>
#include <array>

#include "runs/scene/apparatus/device_block.hpp"

namespace acinus::runs {
namespace {

/// All devices in the order in which they act. Forces are rounded in it: another order is another
/// result in the last digits.
constexpr std::array kDevices{&kTemperatureBlock, &kContractionBlock, &kStretcherBlock,
                              &kPipetteBlock, &kPullsBlock};

}  // namespace

void describe_apparatus(Visitor& visitor, Scene& scene) {
  // In the order of their names: that of the keys is part of a scene's hash.
  std::array devices = kDevices;
  std::ranges::sort(devices, {}, &DeviceBlock::key);
  for (const DeviceBlock* d : devices)
    if (d->describe) d->describe(visitor, scene);
}

void check_apparatus(const Scene& scene, Report& report) {
  for (const DeviceBlock* d : kDevices) d->check(scene, report);
}

void add_apparatus(const Scene& scene, coupling::Params& params) {
  for (const DeviceBlock* d : kDevices) d->add(scene, params);
}

}  // namespace acinus::runs
