#pragma once
/// Scenes that come with the program.

#include <string>
#include <vector>

#include "runs/scene/scene_folder.hpp"

namespace acinus::runs {

struct ShippedScene {
  std::string name;  ///< file name without ".json"
  std::string file;
  std::string description;
};

/// Paths of the shipped JSON files of a kind, "laws" or "studies", by name: those of the folder of
/// that name beside the scenes. Empty without the folder.
std::vector<std::string> shipped_files(const std::string& kind);

/// Names of those files, without folder and ending.
std::vector<std::string> shipped_names(const std::string& kind);

/// Path of the shipped file of a name; empty if there is none.
std::string find_shipped_file(const std::string& kind, const std::string& name);

/// All JSON files of a folder by name, with the text of their key "description". One that cannot be
/// parsed has its error as description.
std::vector<ShippedScene> list_documents(const std::string& folder);

/// All shipped scenes by name. A scene that cannot be parsed has its error as description.
std::vector<ShippedScene> shipped_scenes();

/// Path of a file, or of the shipped document of this name.
/// @param kind  "scene" or "study", for the message
/// @throws Error (kFileError) with a hint if there is neither
std::string find_document(const std::string& name, const std::string& kind,
                          std::vector<ShippedScene> (*shipped)());
inline std::string find_scene_file(const std::string& name) {
  return find_document(name, "scene", shipped_scenes);
}

/// Copies a shipped scene, the scenes it extends and the files they name into a new or existing
/// folder, which then works by itself.
/// @return paths written, the scene first
/// @throws Error: unknown scene (with a hint), a file that exists already, a file that cannot be
///         written (kFileError)
std::vector<std::string> copy_scene(const std::string& name, const std::string& folder);

}  // namespace acinus::runs
