/// Included before all else where the program knows MPI or a clock, for SimGrid to stand in for
/// both.

#include <smpi/smpi.h>
#include <smpi/smpi_helpers.h>

// SimGrid 3.32 knows no threads, and answers so; a simulated process has one.
#undef MPI_THREAD_FUNNELED
#define MPI_THREAD_FUNNELED MPI_THREAD_SINGLE
