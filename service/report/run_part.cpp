#include "service/report/run_part.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "runs/scene/bounded_json.hpp"
#include "service/report/checks.hpp"
#include "service/report/scene_part.hpp"
#include "service/report/thin.hpp"

namespace acinus::service {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson numbers(const std::vector<double>& values) {
  OrderedJson list = OrderedJson::array();
  for (const double v : values) list.push_back(short_number(v));
  return list;
}

OrderedJson curve(const std::vector<double>& time, const std::vector<double>& value) {
  const runs::TimeCurve thin = thin_curve({time, value}, kMostSamples);
  return {{"time", numbers(thin.time)}, {"value", numbers(thin.value)}};
}

/// Converts every column but the time to a curve of its own, so that thinning keeps its extremes.
OrderedJson curves(const std::map<std::string, std::vector<double>>& columns,
                   const std::map<std::string, std::string>& unit) {
  OrderedJson list = OrderedJson::object();
  const auto time = columns.find("time");
  if (time == columns.end()) return list;
  for (const auto& [name, value] : columns) {
    if (name == "time") continue;
    list[name] = curve(time->second, value);
    const auto at = unit.find(name);
    list[name]["unit"] = at == unit.end() ? "" : at->second;
  }
  return list;
}

/// Appends the quantiles of a cell property in one frame: 5, 25, 50, 75, 95 %.
void add_quantiles(OrderedJson& band, double time_s, std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });  // they have no order
  if (values.empty()) return;
  std::ranges::sort(values);
  band["time"].push_back(short_number(time_s));
  for (const auto& [name, share] :
       {std::pair("q05", 0.05), {"q25", 0.25}, {"q50", 0.5}, {"q75", 0.75}, {"q95", 0.95}})
    band[name].push_back(short_number(quantile(values, share)));
}

std::vector<double> relative_volumes(const io::Table& cells) {
  std::vector<double> volume = table_column(cells, "volume");
  const std::vector<double> radius = table_column(cells, "radius");
  if (radius.size() != volume.size()) return {};
  for (std::size_t k = 0; k < volume.size(); ++k) volume[k] /= sphere_volume(radius[k]);
  return volume;
}

/// Describes pressure and volume of the cells over time, from the cell tables alone.
OrderedJson describe_cells(RunRecord& run) {
  constexpr int kMostTables = 200;
  OrderedJson bands{{"pressure", OrderedJson::object()}, {"volume", OrderedJson::object()}};
  for (const int k : choose_evenly(run.n_frame(), kMostTables)) {
    const std::optional<io::Table> cells = read_cell_table(run, k);
    if (!cells) continue;
    const double time = run.reader->time_s(k);
    add_quantiles(bands["pressure"], time, table_column(*cells, "pressure"));
    add_quantiles(bands["volume"], time, relative_volumes(*cells));
  }
  return bands;
}

OrderedJson describe_interface(const PackedRun& packed) {
  OrderedJson j = OrderedJson::object();
  for (const InterfaceSample& s : packed.interface) {
    j["time"].push_back(s.time_s);
    j["pairs"].push_back(s.pairs);
    j["mean force"].push_back(short_number(s.mean_force));
    j["largest force"].push_back(short_number(s.largest_force));
    j["deepest"].push_back(short_number(s.deepest));
  }
  return j;
}

OrderedJson describe_events(const std::vector<io::Event>& events) {
  constexpr std::size_t kMostEvents = 500;
  OrderedJson counts = OrderedJson::object(), last = OrderedJson::array();
  for (const io::Event& e : events) counts[e.code] = counts.value(e.code, 0) + 1;
  const std::size_t first = events.size() > kMostEvents ? events.size() - kMostEvents : 0;
  for (std::size_t k = first; k < events.size(); ++k)
    last.push_back({events[k].time_s, events[k].code, events[k].message, events[k].cell_id});
  return {{"counts", counts}, {"last", last}, {"all", events.size()}};
}

/// Adds the scene recorded in the run file, or a line to `damage` if it is invalid.
void describe_scene(RunRecord& run, const std::string& text, OrderedJson& j) {
  OrderedJson scene = runs::parse_or_discard<OrderedJson>(text);
  std::string fault;
  try {
    check(scene.is_object(), "is no JSON object.", Exit::kFileError);
    j["changed"] = list_changed_values(scene);
    j["walls"] = list_walls(scene);
    j["scene"] = std::move(scene);
  } catch (const Error& error) {
    fault = error.what();
  } catch (const nlohmann::json::exception& error) {
    fault = error.what();
  }
  if (!fault.empty()) run.damage.push_back("scene: " + fault);
}

/// Single results of the experiment. Its curves come from the run file, with their times.
OrderedJson list_results(const OrderedJson& summary) {
  OrderedJson list = OrderedJson::object();
  const auto measures = summary.find("measures");
  if (measures == summary.end() || !measures->is_object()) return list;
  for (const auto& [name, value] : measures->items())
    if (value.is_number()) list[name] = value;
  return list;
}

OrderedJson describe_grid(const PackedGrid& grid) {
  const auto three = [](const Vec3& v) {
    return OrderedJson{short_number(v.x()), short_number(v.y()), short_number(v.z())};
  };
  return {{"n", grid.n},
          {"voxels", grid.n_voxel},
          {"low", three(grid.low)},
          {"size", three(grid.size)},
          {"spacing", three(grid.spacing)},
          {"names", grid.name},
          {"units", grid.unit}};
}

}  // namespace

OrderedJson describe_frames(const PackedRun& packed, int in_file) {
  OrderedJson j{{"in_file", in_file},
                {"id_columns", packed.id_column},
                {"columns", packed.column},
                {"units", packed.unit},
                {"meshes", OrderedJson::array()},
                {"still", OrderedJson::array()},
                {"list", OrderedJson::array()}};
  for (const PackedMesh& m : packed.mesh)
    j["meshes"].push_back({{"nodes", m.nodes}, {"triangles", m.triangles}, {"chunk", m.chunk}});
  for (const PackedStill& s : packed.still)
    j["still"].push_back({{"nodes", s.nodes}, {"triangles", s.triangles}, {"chunk", s.chunk}});
  for (const PackedFrame& f : packed.frame)
    j["list"].push_back({{"time", f.time_s},
                         {"number", f.number},
                         {"mesh", f.mesh},
                         {"still", f.still},
                         {"spheres", f.spheres},
                         {"cells", f.cells},
                         {"chunk", f.chunk}});
  if (!packed.grid.exists()) return j;
  j["grid"] = describe_grid(packed.grid);
  for (std::size_t k = 0; k < packed.frame.size(); ++k)
    if (!packed.frame[k].fields.empty()) j["list"][k]["fields"] = packed.frame[k].fields;
  return j;
}

OrderedJson short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

OrderedJson describe_run(RunRecord& run, const FrameLimits& limits) {
  OrderedJson summary = run.summary.empty() ? OrderedJson::object()
                                            : runs::parse_or_discard<OrderedJson>(run.summary);
  if (!summary.is_object()) {
    run.damage.push_back("summary.json: is no JSON object");
    summary = OrderedJson::object();
  }
  const PackedRun packed = pack_frames(run, limits);
  OrderedJson j;
  j["type"] = "run";
  j["folder"] = run.folder;
  j["name"] = std::filesystem::path(run.folder).lexically_normal().filename().string();
  j["going_on"] = run.going_on;
  j["results"] = list_results(summary);
  j["summary"] = std::move(summary);
  for (const char* key : {"measures", "measure_units"}) j["summary"].erase(key);
  j["provenance"] = run.provenance;
  j["provenance"].erase("scene");
  if (const auto scene = run.provenance.find("scene"); scene != run.provenance.end()) {
    describe_scene(run, scene->second, j);
  }
  j["checks"] = list_checks(j["summary"]);
  j["series"] = curves(run.series, {});
  j["observables"] = curves(run.observables, run.observable_unit);
  j["bands"] = describe_cells(run);
  j["interface"] = describe_interface(packed);
  j["events"] = describe_events(run.events);
  j["frames"] = describe_frames(packed, run.n_frame());
  j["damage"] = run.damage;
  return j;
}

}  // namespace acinus::service
