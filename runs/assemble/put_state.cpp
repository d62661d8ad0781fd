#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "coupling/world/state_parts.hpp"
#include "runs/assemble/state_file.hpp"
#include "runs/assemble/state_numbers.hpp"
#include "runs/assemble/substance_file.hpp"
#include "runs/assemble/tree_file.hpp"

namespace acinus::runs {
namespace {

using io::ArraySource;
using io::TakePart;

/// State that is written. Sources refer to its state.
struct Written {
  Ranks ranks;
  const coupling::State& state;
  io::CheckpointSource& source;
};

/// Adds an array that every process has.
template <class T>
void put_array(const Written& w, const std::string& name, const std::vector<T>& values) {
  w.source.put(name,
               ArraySource<T>{values.size(), [&values](const TakePart<T>& take) { take(values); }});
}

/// Adds numbers of n items that every process has.
/// @param count   numbers of an item
/// @param append  append(k, out) adds those of item k
template <class T, class Append>
void put_items(const Written& w, const std::string& name, std::size_t n, std::size_t count,
               const Append& append) {
  w.source.put(name, ArraySource<T>{n * count, [n, append](const TakePart<T>& take) {
                                      io::PartBuffer<T> out(take);
                                      for (std::size_t k = 0; k < n; ++k) {
                                        append(k, out.values());
                                        out.hand_over_full();
                                      }
                                      out.hand_over();
                                    }});
}

/// Adds numbers of lanes, which their holders have.
/// @param n       of them all; read at the root
/// @param append  append(lane, out)
template <class T, class Append>
void put_lanes(const Written& w, const std::string& name, coupling::LaneRange range, std::size_t n,
               const Append& append) {
  w.source.put(name, ArraySource<T>{n, [w, range, append](const TakePart<T>& take) {
                                      io::PartBuffer<T> out(take);
                                      coupling::visit_lanes(
                                          w.ranks, w.state, range, append,
                                          [&out](std::size_t, std::span<const double> numbers) {
                                            for (const double x : numbers)
                                              out.values().push_back(static_cast<T>(x));
                                            out.hand_over_full();
                                          });
                                      out.hand_over();
                                    }});
}

/// Adds the birth shapes that are still remembered: lane, then weight, area, edges and triangles;
/// lengths of links with nuclei.
void put_birth_shapes(const Written& w) {
  const dcm::State& s = w.state.dcm;
  std::vector<std::int64_t> lanes;
  std::size_t n = 0, n_link = 0;
  coupling::visit_lanes(
      w.ranks, w.state, coupling::shell_lanes(w.state),
      [&s](std::size_t lane, std::vector<double>& out) {
        const dcm::BirthShape& b = s.birth[lane];
        for (const SharedNumbers* v : {&b.edge, &b.triangle, &b.link})
          out.push_back(static_cast<double>(v->size()));
      },
      [&](std::size_t lane, std::span<const double> sizes) {
        n_link += static_cast<std::size_t>(sizes[2]);
        if (sizes[0] == 0) return;
        lanes.push_back(static_cast<std::int64_t>(lane));
        n += 5 + static_cast<std::size_t>(sizes[0]) + static_cast<std::size_t>(sizes[1]);
      });
  w.source.whole.put("dcm/birth_lane", std::move(lanes));
  put_lanes<double>(w, "dcm/birth_shape", coupling::shell_lanes(w.state), n,
                    [&s](std::size_t lane, std::vector<double>& out) {
                      const dcm::BirthShape& b = s.birth[lane];
                      if (b.edge.empty()) return;
                      append_numbers(b.weight, out);
                      out.push_back(b.area);
                      out.insert(out.end(), b.edge.begin(), b.edge.end());
                      out.insert(out.end(), b.triangle.begin(), b.triangle.end());
                    });
  if (!dcm::has_nuclei(s)) return;
  put_lanes<double>(w, "dcm/birth_link", coupling::shell_lanes(w.state), n_link,
                    [&s](std::size_t lane, std::vector<double>& out) {
                      const SharedNumbers& link = s.birth[lane].link;
                      out.insert(out.end(), link.begin(), link.end());
                    });
}

/// Adds the nuclei by group: number of nodes (0: no nucleus) and size relative to the cell.
void put_nuclei(const dcm::State& s, io::CheckpointData& d) {
  if (!dcm::has_nuclei(s)) return;
  std::vector<std::int64_t> nodes;
  std::vector<double> size;
  for (const dcm::Group& g : s.group) {
    nodes.push_back(g.nucleus.n_node());
    size.push_back(g.nucleus.size);
  }
  d.put("dcm/nucleus_nodes", nodes);
  d.put("dcm/nucleus_size", size);
}

/// Adds the cortex tensions of the cells that have any: lane, then forces and lengths of their
/// edges.
void put_tensions(const dcm::State& s, io::CheckpointData& d) {
  std::vector<std::int64_t> lane;
  std::vector<double> numbers;
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    const dcm::EdgeTension& t = s.tension[l];
    if (t.is_new()) continue;
    lane.push_back(static_cast<std::int64_t>(l));
    numbers.insert(numbers.end(), t.force.begin(), t.force.end());
    numbers.insert(numbers.end(), t.length.begin(), t.length.end());
  }
  d.put("dcm/tension_lane", lane);
  d.put("dcm/tension", numbers);
}

void put_shells(const Written& w) {
  const coupling::State& all = w.state;
  const dcm::State& s = all.dcm;
  std::vector<std::int64_t> group;
  for (const dcm::Group& g : s.group)
    group.insert(group.end(), {g.type, static_cast<std::int64_t>(g.topology->n_node)});
  w.source.whole.put("dcm/group", group);
  w.source.put("dcm/position",
               ArraySource<double>{s.position.size(), [w](const TakePart<double>& take) {
                                     coupling::visit_shell_positions(w.ranks, w.state, take);
                                   }});
  put_array(w, "dcm/lineage", s.lineage);
  put_items<double>(w, "dcm/volume", s.volume.size(), 4,
                    [&s](std::size_t k, auto& out) { append_numbers(s.volume[k], out); });
  put_birth_shapes(w);
  put_nuclei(s, w.source.whole);
  put_tensions(s, w.source.whole);
  put_items<double>(w, "dcm/pull", s.pull.size(), 3,
                    [&s](std::size_t k, auto& out) { append_numbers(s.pull[k], out); });
}

void put_spheres(const Written& w) {
  const coupling::State& all = w.state;
  const cbm::State& s = all.cbm;
  const coupling::LaneRange lanes = coupling::sphere_lanes(all);
  const std::size_t n = s.n_cell(), first = lanes.first;
  w.source.put("cbm/position",
               ArraySource<double>{s.position.size(), [w](const TakePart<double>& take) {
                                     coupling::visit_sphere_positions(w.ranks, w.state, take);
                                   }});
  put_array(w, "cbm/lineage", s.lineage);
  put_items<std::int64_t>(w, "cbm/type", n, 1,
                          [&s](std::size_t k, auto& out) { out.push_back(s.type[k]); });
  put_lanes<double>(w, "cbm/volume", lanes, 4 * n, [&s, first](std::size_t lane, auto& out) {
    append_numbers(s.volume[lane - first], out);
  });
  put_lanes<double>(w, "cbm/strength", lanes, 4 * n, [&s, first](std::size_t lane, auto& out) {
    append_numbers(s.strength[lane - first], out);
  });
  put_lanes<double>(w, "cbm/young", lanes, n, [&s, first](std::size_t lane, auto& out) {
    out.push_back(s.young[lane - first]);
  });
  put_items<double>(w, "cbm/pull", n, 3,
                    [&s](std::size_t k, auto& out) { append_numbers(s.pull[k], out); });
  w.source.put("cbm/touching",
               ArraySource<std::int64_t>{2 * coupling::count_touching(w.ranks, all),
                                         [w](const TakePart<std::int64_t>& take) {
                                           io::PartBuffer<std::int64_t> out(take);
                                           coupling::visit_touching(
                                               w.ranks, w.state,
                                               [&out](std::span<const std::pair<int, int>> pairs) {
                                                 for (const auto& [a, b] : pairs) {
                                                   out.values().insert(out.values().end(), {a, b});
                                                   out.hand_over_full();
                                                 }
                                               });
                                           out.hand_over();
                                         }});
}

void put_life(const Written& w) {
  const coupling::State& s = w.state;
  const std::size_t n = s.cycle.size();
  const coupling::LaneRange lanes{0, n};
  const auto put = [&]<class T>(const std::string& name, T coupling::Cycle::*member) {
    using Stored = std::conditional_t<std::is_same_v<T, double>, double, std::int64_t>;
    put_lanes<Stored>(w, name, lanes, n, [&s, member](std::size_t lane, std::vector<double>& out) {
      out.push_back(static_cast<double>(s.cycle[lane].*member));
    });
  };
  put("life/parent", &coupling::Cycle::parent);
  put("life/founder", &coupling::Cycle::founder);
  put("life/fate", &coupling::Cycle::fate);
  put("life/birth", &coupling::Cycle::birth);
  put("life/birth_volume", &coupling::Cycle::birth_volume);
  put("life/duration", &coupling::Cycle::duration);
  put("life/wait_until", &coupling::Cycle::wait_until);
  put_items<std::int64_t>(w, "life/asleep", s.asleep.size(), 1,
                          [&s](std::size_t k, auto& out) { out.push_back(s.asleep[k]); });
  io::CheckpointData& d = w.source.whole;
  d.put_count("life/interval", s.life_interval);
  d.put_count("life/next_lineage", s.next_lineage);
  d.put_count("life/divisions", s.divisions);
  d.put_count("life/deaths", s.deaths);
  d.put_count("life/sleep_interval", s.sleep_interval);
}

void put_zoom(const coupling::State& s, io::CheckpointData& d) {
  std::vector<std::int64_t> cell;
  std::vector<Vec3> force, apart;
  std::vector<double> virial, reach;
  std::vector<Ramp> share;
  for (const coupling::FadingForce& f : s.fading) {
    cell.insert(cell.end(), {f.a, f.b});
    force.push_back(f.force);
    virial.push_back(f.virial);
    share.push_back(f.share);
    apart.push_back(f.apart);
    reach.push_back(f.reach);
  }
  d.put("zoom/fading/cell", cell);
  d.put("zoom/fading/force", flatten(force));
  d.put("zoom/fading/virial", virial);
  d.put("zoom/fading/share", flatten(share));
  d.put("zoom/fading/apart", flatten(apart));
  d.put("zoom/fading/reach", reach);
}

void put_clock(const coupling::State& s, io::CheckpointData& d) {
  d.put_count("clock/phase", static_cast<std::int64_t>(s.clock.phase));
  d.put_count("clock/coarse", s.clock.coarse ? 1 : 0);
  d.put_count("clock/events_due", static_cast<std::int64_t>(s.clock.due));
  visit_numbers(s.clock, s.balance,
                [&](const char* name, double value) { d.put_number(name, value); });
  visit_counts(s.clock, [&](const char* name, std::int64_t value) { d.put_count(name, value); });
  d.put_count("clock/shortened", s.clock.shortened);
  d.put_count("clock/longest_solve", s.clock.longest_solve);
}

}  // namespace

void put_state(const Ranks& ranks, const coupling::State& s, io::CheckpointSource& source) {
  const Written w{ranks, s, source};
  io::CheckpointData& whole = source.whole;
  put_shells(w);
  put_spheres(w);
  put_tree(s.tree, whole);
  put_life(w);
  put_array(w, "zoom/model_since", s.model_since);
  put_zoom(s, whole);
  put_substances(s, whole);
  put_clock(s, whole);
  source.put("solver/last_move",
             ArraySource<double>{s.last_move.size(), [w](const TakePart<double>& take) {
                                   coupling::visit_last_move(w.ranks, w.state, take);
                                 }});
  put_items<std::int64_t>(w, "leaders/cell", s.leader.size(), 1,
                          [&s](std::size_t k, auto& out) { out.push_back(s.leader[k]); });
  whole.put_count("leaders/interval", s.leader_interval);
  put_array(w, "settle/pressure", s.settle_pressure);
  whole.put_number("settle/time", s.settle_time);
}

io::CheckpointData state_data(const coupling::State& state) {
  io::CheckpointSource source;
  put_state(Ranks::serial(), state, source);
  return io::collect(source);
}

}  // namespace acinus::runs
