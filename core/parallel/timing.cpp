#include "core/parallel/timing.hpp"

#include "core/parallel/clock.hpp"

namespace acinus {

Timings::Scope::Scope(Timings& timings, std::string_view stage)
    : timings_(timings),
      stage_(timings.find_or_add(stage)),
      wall_(wall_seconds()),
      cpu_(cpu_seconds()) {}

Timings::Scope::~Scope() {
  if (stage_ >= timings_.stages_.size()) return;  // cleared while this scope was open
  StageTime& stage = timings_.stages_[stage_];
  stage.cpu += cpu_seconds() - cpu_;
  stage.wall += wall_seconds() - wall_;
  ++stage.calls;
}

StageTime Timings::stage(std::string_view name) const {
  for (const StageTime& stage : stages_) {
    if (stage.name == name) return stage;
  }
  return {std::string(name), 0.0, 0.0, 0};
}

std::size_t Timings::find_or_add(std::string_view name) {
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (stages_[i].name == name) return i;
  }
  stages_.push_back({std::string(name), 0.0, 0.0, 0});
  return stages_.size() - 1;
}

}  // namespace acinus
