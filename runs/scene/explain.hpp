#pragma once
/// Descriptions of keys, as text made from the registry.

#include <string>
#include <vector>

#include "runs/scene/entries.hpp"

namespace acinus::runs {

/// Meaning, type, default, range, unit and paper symbol of one key or of all keys of that name.
/// @param query  "time.end", "cell.radius", "/cells/list/0/position" or just "radius"
/// @param entries  the registry: of scenes, or study_entries()
/// @throws Error for a key that does not exist, with the nearest ones.
std::string explain_key(const std::string& query,
                        const std::vector<Entry>& entries = all_entries());

/// One line per key: path, default, meaning.
std::string explain_all(const std::vector<Entry>& entries = all_entries());

/// All keys as a Markdown page, kept as docs/reference/scene_keys.md.
std::string explain_markdown();

}  // namespace acinus::runs
