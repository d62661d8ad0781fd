#pragma once
/// Keys of a scene that a stiffness law depends on (Key::in_law).

#include <functional>
#include <string>
#include <vector>

#include "calibration/law.hpp"
#include "runs/scene/key_values.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Every constant of a cell type that a calibrated law depends on (Key::in_law).
struct LawParameters {
  calibration::Parameters dcm, cbm;
};
LawParameters law_parameters(const Scene& scene, const CellType& type);

/// True if a scene may have spheres at some time, so that their law matters.
bool may_have_spheres(const Scene& scene);

/// Values of the keys of the contact that `chosen` accepts.
std::vector<KeyValue> take_contact(ContactBlock contact,
                                   const std::function<bool(const Key&)>& chosen);

/// Values of the settings of contact, which are no constants of cells, to the last digit.
std::vector<std::string> law_settings(const ContactBlock& contact);

}  // namespace acinus::runs
