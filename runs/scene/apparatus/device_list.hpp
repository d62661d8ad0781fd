#pragma once
/// List of the devices of scenes.

/// X(Name) of every device in the order in which they act. Forces are rounded in it: another order
/// is another result in the last digits. The source beside this header that describes a device
/// defines its block as `k<Name>Block` (device_block.hpp).
#define ACINUS_DEVICES(X) \
  X(Temperature)          \
  X(Contraction)          \
  X(Stretcher)            \
  X(Pipette)              \
  X(Pulls)                \
  /* further ones above this line */
