#pragma once
/// Text attributes of other programs' HDF5 files, of fixed or variable length.

#include <string>
#include <vector>

#include "io/hdf5.hpp"

namespace acinus::io {

/// Texts of an attribute; empty where the object has none of that name, or it is no text. Throws
/// Error(kFileError) at lengths that the file cannot contain: HDF5 allocates the stated length of a
/// variable text, up to 4 GB each, before it reads the text.
std::vector<std::string> read_attribute_texts(const std::string& path, const h5::Handle& object,
                                              const char* name);

}  // namespace acinus::io
