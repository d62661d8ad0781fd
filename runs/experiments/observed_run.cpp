#include "runs/experiments/observed_run.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace acinus::runs {

void put_observed_run(const ObservedRun& o, io::CheckpointData& data) {
  for (const auto& [name, values] : o.measures) data.put("measures/" + name, values);
  for (const auto& [name, value] : o.start) data.put_number("observables/start/" + name, value);
  data.put_number("observables/last_time", o.last_time);
  data.put("observables/births", std::vector<double>(o.births.begin(), o.births.end()));
  std::vector<std::int64_t> ids;
  std::vector<double> centers;
  for (const auto& [id, track] : o.track) {
    ids.insert(ids.end(), {id, track.leader ? 1 : 0});
    for (const double x : track.center) centers.push_back(x);
  }
  data.put("observables/cells", ids);
  data.put("observables/centers", centers);
}

ObservedRun get_observed_run(const io::CheckpointData& data) {
  ObservedRun o;
  constexpr std::string_view kMeasures = "measures/", kStart = "observables/start/";
  for (const auto& [name, value] : data.all()) {
    if (name.starts_with(kMeasures)) o.measures[name.substr(kMeasures.size())] = data.numbers(name);
    if (name.starts_with(kStart)) o.start[name.substr(kStart.size())] = data.number(name);
  }
  o.last_time = data.number("observables/last_time");
  const std::vector<double>&births = data.numbers("observables/births"),
        &centers = data.numbers("observables/centers");
  const std::vector<std::int64_t>& ids = data.integers("observables/cells");
  check(births.size() == o.births.size() && 2 * centers.size() == 3 * ids.size(),
        data.source() +
            ": what the run remembers of its last frame is damaged. Resume from the "
            "previous checkpoint or start anew.",
        Exit::kFileError);
  std::ranges::copy(births, o.births.begin());
  for (std::size_t k = 0; 2 * k < ids.size(); ++k)
    o.track[ids[2 * k]] = {Vec3(centers[3 * k], centers[3 * k + 1], centers[3 * k + 2]),
                           ids[2 * k + 1] != 0};
  return o;
}

}  // namespace acinus::runs
