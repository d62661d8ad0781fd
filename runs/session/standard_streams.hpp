#pragma once
/// The standard streams of a program, safe to print to whatever stands behind them.

namespace acinus::runs {

/// Makes printing never fail, for the rest of the process. What cannot be printed is dropped: in
/// silence when the reader has gone (EPIPE), else with a message on stderr and the exit code of
/// finish_printing(). A stream that was closed at the start leads to /dev/null, so that no file of
/// a run gets its descriptor, and counts as one that cannot be printed to.
void guard_standard_streams();

/// Prints what is still buffered.
/// @return `code`; that of a file error where `code` is 0 and something could not be printed
int finish_printing(int code);

/// Test for a standard output whose lines can be written over: a terminal that knows control
/// sequences, which TERM=dumb denies.
bool can_rewrite_lines();

}  // namespace acinus::runs
