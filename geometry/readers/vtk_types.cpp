#include "geometry/readers/vtk_types.hpp"

#include <charconv>

#include "geometry/readers/input_file.hpp"

namespace acinus::geometry {

namespace {

// vtkIdType is written as int by every legacy writer; long is 8 bytes on the machines that wrote
// the files one meets today.
constexpr VtkType kTypes[] = {
    {"float", 4, VtkType::kReal},          {"double", 8, VtkType::kReal},
    {"int", 4, VtkType::kSigned},          {"unsigned_int", 4, VtkType::kUnsigned},
    {"long", 8, VtkType::kSigned},         {"unsigned_long", 8, VtkType::kUnsigned},
    {"short", 2, VtkType::kSigned},        {"unsigned_short", 2, VtkType::kUnsigned},
    {"char", 1, VtkType::kSigned},         {"unsigned_char", 1, VtkType::kUnsigned},
    {"signed_char", 1, VtkType::kSigned},  {"vtkidtype", 4, VtkType::kSigned},
    {"vtktypeint64", 8, VtkType::kSigned}, {"vtktypeuint64", 8, VtkType::kUnsigned},
    {"long_long", 8, VtkType::kSigned},    {"vtktypeint32", 4, VtkType::kSigned}};

}  // namespace

const VtkType* find_vtk_type(std::string_view token) {
  const std::string lower = lower_case(token);
  for (const VtkType& type : kTypes) {
    if (lower == type.name) return &type;
  }
  return nullptr;
}

std::string decode_vtk_name(std::string_view token) {  // VTK writes blanks and % as %20, %25
  std::string name;
  for (std::size_t i = 0; i < token.size(); ++i) {
    int code = 0;
    if (token[i] == '%' && i + 2 < token.size() &&
        std::from_chars(token.data() + i + 1, token.data() + i + 3, code, 16).ptr ==
            token.data() + i + 3) {
      name += static_cast<char>(code);
      i += 2;
    } else {
      name += token[i];
    }
  }
  return name;
}

}  // namespace acinus::geometry
