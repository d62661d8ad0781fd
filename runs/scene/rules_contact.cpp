#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "dcm/contact/contact_params.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {

void check_pair_adhesions(const Scene& scene, Report& report) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const auto& [name, type] : scene.cell_types)
    for (std::size_t k = 0; k < type.adhesion_with.size(); ++k) {
      const std::string& other = type.adhesion_with[k].type;
      const std::string pointer = fmt::format("/cell_types/{}/adhesion_with/{}/type", name, k),
                        found = "\"" + other + "\"";
      if (!scene.cell_types.contains(other))
        check_type_name(scene, other, pointer, report);
      else if (other == name)
        report.add_relation({pointer}, found,
                            fmt::format("is this type itself. Set /cell_types/{}/adhesion", name));
      else if (!seen.insert(std::minmax(name, other)).second)
        report.add_relation(
            {pointer}, found,
            "the adhesion of these two types is given twice. Give it at one of them");
    }
}

void check_contact_law(const Scene& scene, Report& report) {
  if (scene.contact.law == dcm::ContactLaw::kCohesive) return;
  const std::string law = "\"" + name_of_choice(scene.contact.law) + "\"";
  if (scene.contact.quadrature != contact::Quadrature::kThreePoint)
    report.add_relation({"/contact/law", "/contact/quadrature"}, law,
                        "acts between triangles. Set /contact/quadrature to \"3-point\"");
}

}  // namespace acinus::runs
