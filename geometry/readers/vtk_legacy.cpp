#include "geometry/readers/vtk_legacy.hpp"

#include "geometry/readers/vtk_parser.hpp"

namespace acinus::geometry {

VtkLegacy read_vtk_legacy(const std::string& path, const std::vector<std::string>& allowed,
                          const std::string& remedy) {
  VtkLegacy out(path);
  VtkParser parser(out);
  parser.header(allowed, remedy);
  parser.sections();
  return out;
}

}  // namespace acinus::geometry
