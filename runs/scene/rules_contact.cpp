#include "dcm/contact/contact_params.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
void check_contact_law(const Scene& scene, Report& report) {
  if (scene.contact.law == dcm::ContactLaw::kCohesive) return;
  const std::string law = "\"" + name_of_choice(scene.contact.law) + "\"";
  if (scene.contact.quadrature != contact::Quadrature::kThreePoint)
    report.add_relation({"/contact/law", "/contact/quadrature"}, law,
                        "acts between triangles. Set /contact/quadrature to \"3-point\"");
}

}  // namespace acinus::runs
