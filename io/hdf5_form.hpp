#pragma once
/// Shape, type and storage of the contents of a file, checked before anything is read into memory:
/// a damaged or hostile file may claim any size.

#include <hdf5.h>

#include <cstddef>
#include <string>
#include <vector>

namespace acinus::io::h5 {

/// Shape and type of a dataset or an attribute.
struct Form {
  H5T_class_t type = H5T_NO_CLASS;  ///< H5T_NO_CLASS: unreadable
  std::size_t width = 0;            ///< bytes of one value
  bool variable = false;            ///< texts of variable length
  std::vector<hsize_t> extent;      ///< empty: one value
  bool nothing = false;             ///< null space: no value at all

  double n_value() const;
  bool is_text() const { return type == H5T_STRING && !variable; }
};

Form form_of_dataset(hid_t dataset);
Form form_of_attribute(hid_t attribute);

/// Description for messages: "21 texts of 8 bytes".
std::string describe(const Form& form);

/// Checks the bytes that a dataset may yield, so that no file takes much more memory than disk:
/// those in its storage, or as many as a compressed chunk can hold.
/// @param wanted     bytes asked for; those that a file of this size holds anyway cost no search
/// @param file_size  bytes
/// @return reason why it cannot be read: its storage lies elsewhere (other files, virtual), its
/// filters are not those of this program, it claims more than is there; "" if it can be read
std::string fault_of_storage(hid_t dataset, double wanted, double file_size);

/// Upper bound of the bytes that all datasets of a file of this size can hold together.
double most_from_file(double file_size);

}  // namespace acinus::io::h5
