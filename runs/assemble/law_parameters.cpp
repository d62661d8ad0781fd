#include "runs/assemble/law_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <variant>

#include "runs/assemble/build_params.hpp"
#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

/// Text of a value to its last digit; -1 for "auto".
std::string exact_text(const KeyValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:a}", *number);
  if (const auto* number = std::get_if<std::optional<double>>(&value))
    return fmt::format("{:a}", number->value_or(-1));
  if (const auto* number = std::get_if<int>(&value)) return std::to_string(*number);
  return std::get<bool>(value) ? "true" : "false";
}

}  // namespace

LawParameters law_parameters(const Scene& scene, const CellType& type) {
  LawParameters out;
  const auto add = [&out](const Key& key, const KeyField& field) {
    if (key.in_law == InLaw::kDcm || key.in_law == InLaw::kBoth)
      out.dcm[key.law_name] = number_in(field);
    if (key.in_law == InLaw::kCbm || key.in_law == InLaw::kBoth)
      out.cbm[key.law_name] = number_in(field);
  };
  CellType cell = type;
  cell.cbm.young = make_cbm_params(scene, type).young;  // where it is "auto"
  ContactBlock contact = scene.contact;
  for_each_value([&cell](Visitor& visitor) { describe_cell_type(visitor, cell); }, add);
  for_each_value([&contact](Visitor& visitor) { describe_contact(visitor, contact); }, add);
  return out;
}

bool may_have_spheres(const Scene& scene) {
  if (model_of(scene) != CellModel::kDcm) return true;
  return !scene.model && std::ranges::any_of(scene.cells.list, [](const CellEntry& cell) {
    return cell.model == CellModel::kCbm;
  });
}

std::vector<KeyValue> take_contact(ContactBlock contact,
                                   const std::function<bool(const Key&)>& chosen) {
  return take_values([&contact](Visitor& visitor) { describe_contact(visitor, contact); }, chosen);
}

std::vector<std::string> law_settings(const ContactBlock& contact) {
  std::vector<std::string> settings;
  for (const KeyValue& value :
       take_contact(contact, [](const Key& key) { return key.in_law == InLaw::kSetting; }))
    settings.push_back(exact_text(value));
  return settings;
}

}  // namespace acinus::runs
