#pragma once
/// Standard output streams whose failure does not end the program.

namespace acinus::runs {

/// Makes printing never fail for the rest of the process. Lost output is dropped: silently if the
/// reader has gone (EPIPE), else with a message on stderr and the exit code of finish_printing(). A
/// stream closed at the start is connected to /dev/null, so that no file of a run gets its
/// descriptor, and counts as lost.
void guard_standard_streams();

/// Flushes the standard streams.
/// @return `code`; that of a file error if `code` is 0 and output was lost
int finish_printing(int code);

/// True if lines of the standard output can be overwritten: a terminal that knows control
/// sequences, which TERM=dumb denies.
bool can_rewrite_lines();

}  // namespace acinus::runs
