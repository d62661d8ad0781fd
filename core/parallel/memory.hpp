#pragma once
/// Memory of the machine, and reuse of freed memory.

namespace acinus {

/// Memory of this machine, or of the control group of this process if that has less, bytes.
double machine_memory();

/// Makes the allocator keep large freed arrays for reuse by the next step: fresh memory from the
/// system costs as much as writing to it.
void keep_freed_memory();

}  // namespace acinus
