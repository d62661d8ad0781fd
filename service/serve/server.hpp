#pragma once
/// `acinus serve`: simulations over HTTP.

#include "service/serve/serve_options.hpp"

namespace acinus::runs {

/// Serves until SIGTERM or SIGINT. Runs then end with a checkpoint, and go on when it is started
/// again.
/// @throws Error(kBadInput) for an address that cannot be listened to, or a data folder that
///         another service holds; kFileError
void serve(ServeOptions options);

}  // namespace acinus::runs
