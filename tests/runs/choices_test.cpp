/// Keys whose values are one of a few names.

#include "runs/scene/choices.hpp"

#include <gtest/gtest.h>

#include "coupling/step/step.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/experiments/read_scene.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

/// Every name of a key's choices stands for the value of that name.
TEST(Scene, ChoicesAreReadInTheOrderOfTheirValues) {
  const auto scene = [](const std::string& set) {
    return parse_scene(kMinimal, "scene.json", ".", {set});
  };
  using contact::Quadrature, coupling::Integrator, coupling::Leaders;
  EXPECT_EQ(scene("contact.quadrature=3-point").contact.quadrature, Quadrature::kThreePoint);
  EXPECT_EQ(scene("contact.quadrature=nodes").contact.quadrature, Quadrature::kNodes);
  EXPECT_EQ(scene("contact.quadrature=nodes-and-edges").contact.quadrature,
            Quadrature::kNodesAndEdges);
  EXPECT_EQ(scene("contact.law=cohesive").contact.law, dcm::ContactLaw::kCohesive);
  EXPECT_EQ(scene("contact.law=maugis-dugdale").contact.law, dcm::ContactLaw::kMaugisDugdale);
  for (const Integrator i :
       {Integrator::kLinearlyImplicit, Integrator::kExplicitEuler, Integrator::kNewton})
    EXPECT_EQ(scene("time.integrator=" + name_of_choice(i)).numerics.integrator, i);
  EXPECT_EQ(scene("motility.leaders=foremost").motility.leaders, Leaders::kForemost);
  EXPECT_EQ(scene("motility.leaders=front").motility.leaders, Leaders::kFront);
  EXPECT_EQ(scene("motility.leaders=border").motility.leaders, Leaders::kBorder);
  EXPECT_EQ(scene("motility.leaders=sector").motility.leaders, Leaders::kSector);
  EXPECT_EQ(scene("motility.leaders=nearest").motility.leaders, Leaders::kNearest);
  EXPECT_EQ(scene("friction.form=nodes").contact.friction_form, dcm::FrictionForm::kNodes);
  EXPECT_EQ(scene("experiment=monolayer").experiment, Experiment::kMonolayer);
  EXPECT_EQ(scene("experiment=spheroid").experiment, Experiment::kSpheroid);
  EXPECT_EQ(scene("cells.lattice=bcc").cells.lattice, coupling::Lattice::kBcc);
  EXPECT_TRUE(scene("friction.medium=liquid").friction.liquid);
  EXPECT_TRUE(scene("motility.directions=plane").motility.in_plane);
  EXPECT_FALSE(scene("output.compression=none").output.compress);
  for (const Integrator i :
       {Integrator::kLinearlyImplicit, Integrator::kExplicitEuler, Integrator::kNewton})
    EXPECT_EQ(name_of_choice(i), coupling::name_of(i)) << "messages of a step say the same";
  EXPECT_EQ(choice_name("a|bc|d", 1), "bc");
  EXPECT_EQ(choice_name("a|bc|d", 3), "");
  EXPECT_EQ(choice_name("a|bc|d", -1), "");
  EXPECT_EQ(choice_index("a|bc|d", "d"), 2);
  EXPECT_EQ(choice_index("a|bc|d", "b"), -1);
  EXPECT_EQ(choice_index("a|bc|d", ""), -1);
}

}  // namespace
}  // namespace acinus::runs
