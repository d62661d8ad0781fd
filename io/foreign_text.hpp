#pragma once
/// Text attributes of other programs' HDF5 files, of fixed or variable length.

#include <string>
#include <vector>

#include "io/hdf5.hpp"

namespace acinus::io {

/// Texts of an attribute; empty where the object has none of that name, or it is no text.
/// Throws Error(kFileError) at lengths that the file cannot hold: HDF5 reserves what a variable
/// length says, up to 4 GB a text, before it looks for the text.
std::vector<std::string> read_foreign_texts(const std::string& path, const h5::Handle& object,
                                            const char* name);

}  // namespace acinus::io
