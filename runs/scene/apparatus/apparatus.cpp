#include "runs/scene/apparatus/apparatus.hpp"

#include <algorithm>
#include <array>

#include "runs/scene/apparatus/device_block.hpp"

namespace acinus::runs {
namespace {

#define ACINUS_BLOCK(name) &k##name##Block,
constexpr std::array kDevices{ACINUS_DEVICES(ACINUS_BLOCK)};
#undef ACINUS_BLOCK

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
