#pragma once
/// JSON tree of a scene after merging the files it `extends` and the values replaced from the
/// command line (`--set`); every value still knows where it was written.

#include <cstddef>
#include <string>
#include <vector>

#include "runs/scene/json_text.hpp"

namespace acinus::runs {

struct Document {
  std::vector<Source> sources;
  Node root;
};

/// Reads a file and, below it, everything it `extends` (a path relative to that file); the names of
/// the extending file win, objects are merged, all else is replaced. "extends" and "$schema" are
/// taken out of the tree.
/// @throws Error (kFileError) if a file cannot be read, Error (kBadInput) for its contents and for
///         files that extend each other in a circle.
Document read_document(const std::string& path);

/// Parses a text in memory as read_document() does a file.
/// @param folder  start of its relative paths
Document parse_document(const std::string& text, const std::string& label,
                        const std::string& folder);

/// Applies one PATH=VALUE: names separated by . or /, list elements by number from 0, VALUE a JSON
/// text or, if it is none, a bare string. Objects on the way are made when missing.
/// @throws Error naming the flag.
void apply_set(Document& document, const std::string& assignment);

/// Puts a value at a path written as in PATH=VALUE, whatever was there. The origins of the value
/// must belong to the document's sources.
/// @param where  stands before what is wrong with the path
/// @throws Error starting with `where`
void put_value(Document& document, const std::string& path, const JsonMember& value,
               const std::string& where);

/// Bytes of a regular file of at most `limit` bytes. @throws Error (kFileError).
std::string read_file(const std::string& path, std::size_t limit);

}  // namespace acinus::runs
