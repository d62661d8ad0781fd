#pragma once
/// How much memory there is, and what becomes of it.

namespace acinus {

/// Memory of this machine, or of the control group the process runs in if that has less, bytes.
double machine_memory();

/// Large arrays that a step frees and the next one asks for again stay with the process from now
/// on: to get fresh memory from the system costs as much as what is then written to it.
void keep_freed_memory();

}  // namespace acinus
