#include "runs/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

template <class T>
std::vector<std::int64_t> as_integers(const std::vector<T>& v) {
  return {v.begin(), v.end()};
}
std::vector<double> flatten(const std::vector<Ramp>& ramps) {
  std::vector<double> v;
  for (const Ramp& r : ramps) v.insert(v.end(), {r.from, r.to, r.start, r.end});
  return v;
}
std::vector<Ramp> unflatten(const std::vector<double>& v) {
  std::vector<Ramp> ramps;
  for (std::size_t k = 0; k + 3 < v.size(); k += 4)
    ramps.push_back({v[k], v[k + 1], v[k + 2], v[k + 3]});
  return ramps;
}

void check_same(const io::CheckpointData& data, const std::string& what, std::size_t found,
                std::size_t expected) {
  check(found == expected,
        fmt::format("{}: {} has {} entries, this scene makes {}. The checkpoint belongs to another "
                    "scene; resume with the scene it was made from.",
                    data.source(), what, found, expected));
}

}  // namespace

void put_state(const coupling::State& s, io::CheckpointData& d) {
  d.put("dcm/position", s.dcm.position);
  d.put("dcm/lineage", s.dcm.lineage);
  d.put("dcm/volume", flatten(s.dcm.volume));
  d.put("cbm/position", s.cbm.position);
  d.put("cbm/lineage", s.cbm.lineage);
  d.put("cbm/volume", flatten(s.cbm.volume));
  d.put("cbm/young", s.cbm.young);
  std::vector<std::int64_t> touching;
  for (const auto& [a, b] : s.cbm.touching) touching.insert(touching.end(), {a, b});
  d.put("cbm/touching", touching);
  const coupling::Clock& c = s.clock;
  d.put("clock/times", std::vector<double>{c.time, c.origin, c.phase_start, c.step, c.last_step});
  d.put("clock/counts",
        std::vector<std::int64_t>{static_cast<std::int64_t>(c.phase), c.accepted, c.rejected,
                                  c.cg_iterations, c.coarse ? 1 : 0, c.solves});
  d.put("balance",
        std::vector<double>{s.balance.momentum, s.balance.torque, s.balance.friction_torque});
  d.put("solver/last_move", s.last_move);
  d.put("leaders/cell", as_integers(s.leader));
  d.put_count("leaders/interval", s.leader_interval);
  d.put("settle/pressure", s.settle_pressure);
  d.put_number("settle/time", s.settle_time);
}

void get_state(const io::CheckpointData& d, coupling::State& s) {
  check_same(d, "dcm/position", d.numbers("dcm/position").size(), s.dcm.position.size());
  check_same(d, "cbm/position", d.numbers("cbm/position").size(), s.cbm.position.size());
  check(d.integers("dcm/lineage") == s.dcm.lineage && d.integers("cbm/lineage") == s.cbm.lineage,
        d.source() +
            ": the cells are not those of this scene. Resume with the scene the checkpoint was "
            "made from.");
  s.dcm.position = d.numbers("dcm/position");
  s.dcm.volume = unflatten(d.numbers("dcm/volume"));
  s.cbm.position = d.numbers("cbm/position");
  s.cbm.volume = unflatten(d.numbers("cbm/volume"));
  s.cbm.young = d.numbers("cbm/young");
  s.cbm.touching.clear();
  const std::vector<std::int64_t>& t = d.integers("cbm/touching");
  for (std::size_t k = 0; k + 1 < t.size(); k += 2)
    s.cbm.touching.emplace_back(static_cast<int>(t[k]), static_cast<int>(t[k + 1]));
  const std::vector<double>& times = d.numbers("clock/times");
  const std::vector<std::int64_t>& counts = d.integers("clock/counts");
  const std::vector<double>& balance = d.numbers("balance");
  check_same(d, "clock/times", times.size(), 5);
  check_same(d, "clock/counts", counts.size(), 6);
  check_same(d, "balance", balance.size(), 3);
  s.clock = {times[0],       times[1],  static_cast<coupling::Phase>(counts[0]),
             times[2],       times[3],  times[4],
             counts[1],      counts[2], counts[3],
             counts[4] != 0, counts[5]};
  s.balance = {balance[0], balance[1], balance[2]};
  s.last_move = d.numbers("solver/last_move");
  const std::vector<std::int64_t>& leader = d.integers("leaders/cell");
  s.leader.assign(leader.begin(), leader.end());
  s.leader_interval = d.count("leaders/interval");
  s.settle_pressure = d.numbers("settle/pressure");
  s.settle_time = d.number("settle/time");
}

}  // namespace acinus::runs
