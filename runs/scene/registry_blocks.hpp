#pragma once
/// Parts of the registry: one function per scene block, defined in the registry_*.cpp files.

#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "runs/scene/choices.hpp"
#include "runs/scene/scene.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

inline constexpr Range kPositive{.low = 0, .low_open = true};
inline constexpr Range kNotNegative{.low = 0};
inline constexpr Range kFraction{.low = 0, .high = 1};
inline constexpr Range kAtLeastOne{.low = 1};

template <class Block>
using Describe = void (*)(Visitor&, Block&);

template <class Block>
void block(Visitor& visitor, const Key& key, Block& value, Describe<Block> members) {
  visitor.object(key, [&value, members](Visitor& inner) { members(inner, value); });
}

template <class Block>
void blocks(Visitor& visitor, const Key& key, std::vector<Block>& list, Describe<Block> members) {
  Elements elements;
  elements.size = [&list] { return list.size(); };
  elements.resize = [&list](std::size_t n) { list.resize(n); };
  elements.visit = [&list, members](Visitor& inner, std::size_t i) { members(inner, list[i]); };
  elements.visit_sample = [members](Visitor& inner) {
    Block sample;
    members(inner, sample);
  };
  visitor.list(key, elements);
}

/// Keys of an entry of a course over time; kValue is the key of the value.
template <const Key& kValue>
void describe_course_point(Visitor& visitor, Schedule::Point& point) {
  visitor.real({.name = "time",
                .meaning = "time after t = 0; the value runs straight from one entry to the next, "
                           "and two entries of one time are a jump",
                .dimension = kTime,
                .unit = "s"},
               point.time);
  visitor.real(kValue, point.value);
}

template <class Block>
void named_blocks(Visitor& visitor, const Key& key, std::map<std::string, Block>& map,
                  Describe<Block> members) {
  Elements elements;
  elements.size = [&map] { return map.size(); };
  elements.names = [&map] {
    std::vector<std::string> names;
    for (const auto& [name, value] : map) names.push_back(name);
    return names;
  };
  elements.add = [&map](const std::string& name) { map.try_emplace(name); };
  elements.visit = [&map, members](Visitor& inner, std::size_t i) {
    members(inner, std::next(map.begin(), static_cast<std::ptrdiff_t>(i))->second);
  };
  elements.visit_sample = [members](Visitor& inner) {
    Block sample;
    members(inner, sample);
  };
  visitor.map(key, elements);
}

template <class Block>
void optional_block(Visitor& visitor, const Key& key, std::optional<Block>& value,
                    Describe<Block> members) {
  visitor.optional_object(
      key, value.has_value(),
      [&value](bool present) { value = present ? std::optional(Block{}) : std::nullopt; },
      [&value, members](Visitor& inner) {
        Block sample;
        members(inner, value ? *value : sample);
      });
}

/// Shows a choice among names: an enum of choices.hpp, or false and true with two names in the key.
template <class E>
void choice(Visitor& visitor, Key key, E& value) {
  if constexpr (!std::is_same_v<E, bool>)
    if (key.choices[0] == '\0') key.choices = kChoices<E>;
  std::string name = choice_name(key.choices, static_cast<int>(value));
  visitor.text(key, name);
  if (const int index = choice_index(key.choices, name); index >= 0) value = static_cast<E>(index);
}

/// Shows a choice, with "auto" for no value.
template <class E>
void choice(Visitor& visitor, Key key, std::optional<E>& value) {
  if (key.choices[0] == '\0') key.choices = kChoices<E>;
  std::string name = value ? name_of_choice(*value) : "";
  visitor.text(key, name);
  const int index = choice_index(key.choices, name);
  value = index >= 0 ? std::optional(static_cast<E>(index)) : std::nullopt;
}

/// Shows a number that is `automatic` where none is given.
inline void real_or_auto(Visitor& visitor, const Key& key, double& value, double automatic = 0) {
  std::optional<double> given;
  if (value != automatic) given = value;
  visitor.optional_real(key, given);
  value = given.value_or(automatic);
}

inline constexpr double kNever = std::numeric_limits<double>::infinity();

void describe_contact(Visitor& v, ContactBlock& b);
void describe_cell_type(Visitor& v, CellType& b);
void describe_cycle(Visitor& v, coupling::CycleParams& b);
void describe_inhibition(Visitor& v, coupling::Inhibition& b);
void describe_death(Visitor& v, CellType& b);
void describe_life(Visitor& v, LifeBlock& b);
void describe_contraction(Visitor& v, ContractionBlock& b);
void describe_nucleus(Visitor& v, dcm::Nucleus& b);
void describe_cells(Visitor& v, CellsBlock& b);
void describe_region(Visitor& v, Region& b);
void describe_moving_zoom(Visitor& v, MovingZoomBlock& b);
void describe_friction(Visitor& v, Scene& s);
void describe_motility(Visitor& v, MotilityBlock& b);
void describe_lobule(Visitor& v, LobuleBlock& b);
void describe_vessels(Visitor& v, VesselBlock& b);
void describe_wall(Visitor& v, WallEntry& b);
void describe_capsule(Visitor& v, CapsuleEntry& b);
void describe_substance(Visitor& v, SubstanceBlock& b);
void describe_substance_grid(Visitor& v, SubstanceGridBlock& b);
void describe_exchange(Visitor& v, ExchangeEntry& b);
void describe_signal_rule(Visitor& v, SignalRuleEntry& b);
void describe_static_mesh(Visitor& v, StaticMeshEntry& b);

}  // namespace acinus::runs
