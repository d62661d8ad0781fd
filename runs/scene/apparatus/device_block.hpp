#pragma once
/// Interface of a device in a scene: its keys, its rules, and the device made of them.

#include <string_view>

#include "coupling/world/world.hpp"
#include "runs/scene/apparatus/device_list.hpp"
#include "runs/scene/fault_report.hpp"
#include "runs/scene/scene.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

struct DeviceBlock {
  std::string_view key;                                    ///< of its block in the scene
  void (*describe)(Visitor&, Scene&) = nullptr;            ///< null: its keys are in another block
  void (*check)(const Scene&, Report&) = nullptr;          ///< rules between its keys and others
  void (*add)(const Scene&, coupling::Params&) = nullptr;  ///< if the scene has it; after the types
};

#define ACINUS_BLOCK(name) extern const DeviceBlock k##name##Block;
ACINUS_DEVICES(ACINUS_BLOCK)
#undef ACINUS_BLOCK

}  // namespace acinus::runs
