#include "runs/assemble/cell_constants.hpp"

#include <variant>

#include "runs/scene/key_values.hpp"
#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {

CellType softened(const CellType& type) {
  CellType soft = type;
  for_each_value([&soft](Visitor& visitor) { describe_cell_type(visitor, soft); },
                 [&type](const Key& key, const KeyField& field) {
                   if (key.softens) *std::get<double*>(field) *= type.softening;
                 });
  return soft;
}

}  // namespace acinus::runs
