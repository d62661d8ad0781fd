#include "coupling/apparatus/contraction/contraction.hpp"

#include <utility>

#include "runs/scene/apparatus/device_block.hpp"
#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/registry_blocks.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

constexpr Key kFactorThen{
    .name = "factor", .meaning = "factor then", .range = kNotNegative, .required = true};

void check_course_of_type(const Scene& scene, const std::string& dcm, const DcmBlock& b,
                          Report& report) {
  if (!b.contraction) return;
  const std::string pointer = dcm + "/contraction";
  if (!(b.cortex_tension > 0))
    report.add_relation({dcm + "/cortex_tension", pointer},
                        quoted_quantity(b.cortex_tension, kTension, "N/m"),
                        "leaves " + pointer + " nothing to vary. Give a tension above 0 N/m");
  if (b.contraction->axis.norm() == 0)
    report.add_relation({pointer + "/axis"}, "[0, 0, 0]", "has no direction");
  check_course(b.contraction->course, pointer + "/course", report);
  if (scene.life.sleep && !b.contraction->course.entry.empty())
    report.add_relation({pointer + "/course", "/life/sleep"}, "",
                        "is not for cells that may sleep: a tension that changes would not wake "
                        "them. Set /life/sleep to false");
}

void check_contraction(const Scene& scene, Report& report) {
  for (const auto& [name, type] : scene.cell_types)
    check_course_of_type(scene, "/cell_types/" + name + "/dcm", type.dcm, report);
}

/// Adds contraction. A cell that dissolves has another type and goes on contracting.
void add_contraction(const Scene& scene, coupling::Params& params) {
  coupling::Contraction contraction;
  contraction.course.resize(params.dcm.size());
  bool any = false;
  std::size_t k = 0;
  for (const auto& [name, type] : scene.cell_types) {
    const int dissolving = params.life.type[k].death.type;
    if (type.dcm.contraction && !type.dcm.contraction->course.entry.empty()) {
      any = true;
      contraction.course[k] = type.dcm.contraction->course;
      if (dissolving >= 0) contraction.course[dissolving] = contraction.course[k];
    }
    ++k;
  }
  if (any) params.apparatus.add(std::move(contraction));
}

}  // namespace

void describe_contraction(Visitor& v, ContractionBlock& b) {
  blocks(v,
         {.name = "course",
          .meaning = "factor on cortex_tension over time; none = 1",
          .item = "contraction"},
         b.course.entry, describe_course_point<kFactorThen>);
  v.real({.name = "ring",
          .meaning = "tension of a band about the equator beyond that of the poles, over the "
                     "latter; 0 = no band",
          .range = kNotNegative},
         b.excess);
  v.real({.name = "width",
          .meaning = "width of the band along the axis in cell radii: the standard deviation of a "
                     "Gaussian",
          .range = kPositive},
         b.width);
  v.vector({.name = "axis",
            .meaning = "direction from pole to pole, fixed in space: it does not turn with the "
                       "cell"},
           b.axis);
}

const DeviceBlock kContractionBlock{"contraction", nullptr, check_contraction, add_contraction};

}  // namespace acinus::runs
