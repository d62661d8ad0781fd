#pragma once
/// HTTP service for simulations (`acinus serve`).

#include "service/serve/serve_options.hpp"

namespace acinus::service {

/// Serves until SIGTERM or SIGINT. Runs then end with a checkpoint and continue with the next
/// service.
/// @throws Error(kBadInput) for an address that cannot be bound, or a data folder that another
/// service holds; kFileError
void serve(ServeOptions options);

}  // namespace acinus::service
