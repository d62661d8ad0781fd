#include "coupling/apparatus/temperature/temperature.hpp"

#include "runs/scene/apparatus/device_block.hpp"
#include "runs/scene/registry_blocks.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

constexpr Key kTemperatureThen{.name = "value",
                               .meaning = "temperature then",
                               .dimension = kTemperature,
                               .unit = "K",
                               .range = kPositive,
                               .required = true};

void describe_temperature(Visitor& v, coupling::Temperature& b) {
  v.real({.name = "activation",
          .meaning = "activation energy of the friction within the cortex (nodal_friction, "
                     "series_friction)",
          .dimension = kMolarEnergy,
          .unit = "kJ/mol",
          .range = kNotNegative,
          .symbol = "E_a"},
         b.activation);
  v.real({.name = "reference",
          .meaning = "temperature at which those frictions are as the cell type says",
          .dimension = kTemperature,
          .unit = "K",
          .range = kPositive,
          .symbol = "T_0"},
         b.reference);
  blocks(v, {.name = "course", .meaning = "temperature over time", .item = "temperature"},
         b.course.entry, describe_course_point<kTemperatureThen>);
}

void describe_temperature_block(Visitor& v, Scene& s) {
  optional_block(v,
                 {.name = "temperature",
                  .meaning = "temperature over time, on which the friction within the cortex of "
                             "deformable cells depends; null = none"},
                 s.temperature, describe_temperature);
}

void check_temperature(const Scene& scene, Report& report) {
  if (!scene.temperature) return;
  if (scene.temperature->course.entry.empty())
    report.add_relation({"/temperature/course", "/temperature"}, "",
                        "needs an entry: {\"time\": \"0 s\", \"value\": \"310 K\"}");
  check_course(scene.temperature->course, "/temperature/course", report);
}

void add_temperature(const Scene& scene, coupling::Params& params) {
  if (scene.temperature) params.apparatus.add(*scene.temperature);
}

}  // namespace

const DeviceBlock kTemperatureBlock{"temperature", describe_temperature_block, check_temperature,
                                    add_temperature};

}  // namespace acinus::runs
