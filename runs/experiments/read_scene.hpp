#pragma once
/// Reads scenes: JSON text -> checked Scene, with every mistake reported at once.

#include <string>
#include <vector>

#include "runs/scene/document.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Reads a scene file, what it extends, and the command line's replacements.
/// @param set  PATH=VALUE each, applied in order; relative file names in them start in the current
///             folder, those in a scene file in that file's folder
/// @throws Error: all mistakes, one a line, each "file:line:column /path = value: rule"; kFileError
///         if a scene file cannot be read at all
Scene read_scene(const std::string& path, const std::vector<std::string>& set = {});

/// Reads a scene from a text in memory.
/// @param label   stands for the file name in messages; its stem is the default scene name
/// @param folder  where relative file names start
Scene parse_scene(const std::string& text, const std::string& label,
                  const std::string& folder = ".", const std::vector<std::string>& set = {});

/// Reads a scene from a document that was read and changed before.
/// @param label  the scene's file in messages; its stem is the default scene name
Scene read_scene(const Document& document, const std::string& label);

}  // namespace acinus::runs
