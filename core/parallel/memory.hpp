#pragma once
/// Memory of the machine and of this process, and reuse of freed memory.

#include <cstdint>

namespace acinus {

/// Memory of this machine, or of the control group of this process if that has less, bytes.
double machine_memory();

/// Resident memory of this process, bytes.
std::uint64_t rss_bytes();

/// Largest resident memory of this process so far, bytes.
std::uint64_t peak_rss_bytes();

/// Makes the allocator keep freed arrays of up to 4 MB for reuse by the next step, since fresh
/// memory from the system costs as much as writing to it. Larger arrays are mapped: as a tissue
/// grows they move, and would leave gaps that nothing else fits.
void keep_freed_memory();

/// Returns the pages of kept arrays to the system. As a tissue grows its small arrays move too, and
/// a twentieth of the memory of the process would be gaps. Takes 2 ms with 3000 deformable cells.
void return_freed_memory();

}  // namespace acinus
