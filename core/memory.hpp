#pragma once
/// How much memory there is.

namespace acinus {

/// Memory of this machine, or of the control group the process runs in if that has less, bytes.
double machine_memory();

}  // namespace acinus
