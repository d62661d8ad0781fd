#include "runs/assemble/state_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "tests/coupling/worlds.hpp"
#include "tests/messages.hpp"

namespace acinus::runs {
namespace {

constexpr StateTypes kTypes{1, 1};  // of the worlds below

coupling::State two_spheres() {
  return coupling::make_test_world({{Vec3::Zero(), false}, {Vec3(23, 0, 0), false}}).state;
}

TEST(StateFile, KeepsTheStrengthOfNewBornSpheres) {
  coupling::State saved = two_spheres(), loaded = saved;
  saved.cbm.strength.set(1, {0, 1, 100, 8740});
  const io::CheckpointData data = state_data(saved);
  get_state(data, kTypes, loaded);
  EXPECT_EQ(coupling::hash_state(loaded), coupling::hash_state(saved));
  EXPECT_EQ(loaded.cbm.strength[1].at(100 + 2160), 0.25);
}

/// Equal numbers but for one.
std::vector<double> mixed(int n, double value, std::size_t at, double other) {
  std::vector<double> numbers(static_cast<std::size_t>(n), value);
  numbers[at] = other;
  return numbers;
}

/// One cell of each model in the middle of life.
coupling::State living() {
  coupling::State s =
      coupling::make_test_world({{Vec3::Zero()}, {Vec3(23, 0, 0), false}}, 60, 42).state;
  const std::size_t n = s.dcm.n_lane() + s.cbm.n_cell();
  s.cycle.assign(n, {});
  s.cycle[0] = {3, 1, coupling::Fate::kLyse, 10, 7000, 86000, 20};
  s.cycle[n - 1] = {4, 2, coupling::Fate::kRest, 11, 7001, 86001, 21};
  s.asleep.assign(n, 0);
  s.asleep[n - 1] = 1;
  s.life_interval = 5;
  s.sleep_interval = 6;
  s.next_lineage = 7;
  s.divisions = 8;
  s.deaths = 9;
  const geometry::Topology& t = *s.dcm.group[0].topology;
  s.dcm.birth[0] = {
      {1, 0, 60, 3660}, 1.2, mixed(t.n_edge, 1.1, 5, 0.7), mixed(t.n_triangle, 1.3, 6, 0.8), {}};
  s.dcm.tension[1] = {std::vector<double>(s.dcm.group[0].topology->edge.size(), 0.2),
                      std::vector<double>(s.dcm.group[0].topology->edge.size(), 3.1)};
  s.dcm.tension[1].force[4] = -0.3;
  s.dcm.volume[0] = {7000, 14000, 10, 86010};
  return s;
}

TEST(StateFile, KeepsNuclei) {
  coupling::World w = coupling::make_test_world({{Vec3::Zero()}, {Vec3(30, 0, 0)}}, 60, 162);
  w.params.dcm[0].nucleus = dcm::Nucleus{};
  coupling::give_nuclei(w);
  coupling::State& saved = w.state;
  saved.dcm.birth[1] = living().dcm.birth[0];
  const geometry::Topology& t = *saved.dcm.group[0].topology;
  saved.dcm.birth[1].edge = mixed(t.n_edge, 1.2, 5, 0.7);
  saved.dcm.birth[1].triangle = mixed(t.n_triangle, 1.2, 6, 0.8);
  saved.dcm.birth[1].link = std::vector<double>(42, 1.4);
  const io::CheckpointData data = state_data(saved);
  coupling::State s;
  get_state(data, kTypes, s);
  EXPECT_EQ(coupling::hash_state(s), coupling::hash_state(saved));
  EXPECT_EQ(s.dcm.group[0].nucleus, saved.dcm.group[0].nucleus);
  EXPECT_EQ(s.dcm.birth[1].link, saved.dcm.birth[1].link);
}

TEST(StateFile, KeepsLives) {
  const coupling::State saved = living();
  coupling::State s;
  const io::CheckpointData data = state_data(saved);
  get_state(data, kTypes, s);
  EXPECT_EQ(coupling::hash_state(s), coupling::hash_state(saved));
  ASSERT_EQ(s.cycle.size(), saved.cycle.size());
  for (std::size_t k = 0; k < s.cycle.size(); ++k) {
    const coupling::Cycle &a = s.cycle[k], &b = saved.cycle[k];
    EXPECT_EQ(
        std::tie(a.parent, a.founder, a.fate, a.birth, a.birth_volume, a.duration, a.wait_until),
        std::tie(b.parent, b.founder, b.fate, b.birth, b.birth_volume, b.duration, b.wait_until));
  }
  EXPECT_EQ(s.asleep, saved.asleep);
  EXPECT_EQ(std::tie(s.life_interval, s.sleep_interval, s.next_lineage, s.divisions, s.deaths),
            std::tie(saved.life_interval, saved.sleep_interval, saved.next_lineage, saved.divisions,
                     saved.deaths));
  const dcm::BirthShape &a = s.dcm.birth.at(0), &b = saved.dcm.birth[0];
  EXPECT_EQ(a.edge, b.edge);
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.area, b.area);
  for (double time : {0.0, 1000.0, 4000.0}) {
    EXPECT_EQ(a.weight.at(time), b.weight.at(time));
    EXPECT_EQ(s.dcm.volume[0].at(time), saved.dcm.volume[0].at(time));
  }
  EXPECT_TRUE(s.dcm.birth.at(1).edge.empty());
  EXPECT_EQ(s.dcm.tension.at(1).force, saved.dcm.tension[1].force);
  EXPECT_EQ(s.dcm.tension.at(1).length, saved.dcm.tension[1].length);
  EXPECT_TRUE(s.dcm.tension.at(0).is_new());
}

TEST(StateFile, RefusesArraysThatAreMissingOrOfAnotherLength) {
  const io::CheckpointData sound = state_data(living());
  for (const char* damaged :
       {"cbm/strength", "dcm/birth_shape", "dcm/tension", "life/parent", "life/birth",
        "life/divisions", "life/wait_until", "clock/phase", "life/asleep"})
    for (bool missing : {true, false}) {
      io::CheckpointData data;
      for (const auto& entry : sound.all()) {
        const std::string& name = entry.first;
        std::visit(
            [&](auto v) {
              if constexpr (requires { v.pop_back(); })
                if (name == damaged && !v.empty()) v.pop_back();
              if (name != damaged || !missing) data.put(name, v);
            },
            entry.second);
      }
      coupling::State state;
      try {
        get_state(data, kTypes, state);
        ADD_FAILURE() << damaged << (missing ? " is missing" : " is too short");
      } catch (const Error& error) {
        EXPECT_CONTAINS(std::string(error.what()), damaged) << error.what();
      }
    }
}

/// Data of a state with one array changed.
template <class T>
io::CheckpointData with(const coupling::State& state, const std::string& name, std::size_t at,
                        T value) {
  const io::CheckpointData sound = state_data(state);
  io::CheckpointData data;
  for (const auto& [other, array] : sound.all())
    std::visit(
        [&, &key = other](auto v) {
          if constexpr (std::is_same_v<decltype(v), std::vector<T>>)
            if (key == name) v.at(at) = value;
          data.put(key, v);
        },
        array);
  return data;
}

template <class T>
void expect_refused(const std::string& name, std::size_t at, T value) {
  coupling::State state;
  try {
    get_state(with(living(), name, at, value), kTypes, state);
    ADD_FAILURE() << name << " " << at << " is " << value;
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == Exit::kFileError || error.code() == Exit::kBadInput)
        << error.what();
  }
}

TEST(StateFile, RefusesPlacesThatAreNotThere) {
  for (const std::int64_t type : {1L, -1L, 1L << 40}) {
    expect_refused("dcm/group", 0, type);
    expect_refused("cbm/type", 0, type);
  }
  expect_refused<std::int64_t>("dcm/group", 1, 43);
  expect_refused<std::int64_t>("dcm/group", 1, (1L << 32) + 42);
  expect_refused<std::int64_t>("dcm/birth_lane", 0, 8);
  expect_refused<std::int64_t>("dcm/birth_lane", 0, -1);
  for (const std::int64_t phase : {-1L, 4L, 1L << 33}) expect_refused("clock/phase", 0, phase);
  for (const std::int64_t fate : {-1L, 5L, 256L}) expect_refused("life/fate", 0, fate);
  expect_refused<std::int64_t>("clock/events_due", 0, 5);
  expect_refused<std::int64_t>("cbm/lineage", 0, -1);
  expect_refused<std::int64_t>("clock/accepted", 0, -1);
}

TEST(StateFile, RefusesNumbersThatAreNone) {
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300})
    for (const char* name : {"dcm/position", "cbm/position", "clock/time", "clock/step"})
      expect_refused(name, 0, bad);
  for (const double bad : {std::nan(""), -HUGE_VAL})
    for (const char* name : {"dcm/volume", "cbm/volume", "cbm/young", "cbm/pull"})
      expect_refused(name, 0, bad);
  expect_refused("cbm/young", 0, -1.0);
  expect_refused("clock/step", 0, -1.0);
  expect_refused("life/wait_until", 0, std::nan(""));
}

TEST(StateFile, RefusesContactsOfSpheresThatAreNotThere) {
  coupling::State saved = two_spheres();
  saved.cbm.touching = {{0, 1}, {1, ~7}};
  coupling::State state;
  const io::CheckpointData sound = state_data(saved);
  get_state(sound, kTypes, state);
  EXPECT_EQ(state.cbm.touching, saved.cbm.touching);
  for (const std::int64_t partner : {2L, 1L << 40, -(1L << 40)})
    EXPECT_THROW(get_state(with(saved, "cbm/touching", 1, partner), kTypes, state), Error);
  EXPECT_THROW(get_state(with<std::int64_t>(saved, "cbm/touching", 0, -1), kTypes, state), Error);
}

}  // namespace
}  // namespace acinus::runs
