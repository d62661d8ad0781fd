#pragma once
/// Keys as a registry shows them: name, dimension, unit, range, choices, meaning and effects of
/// each, one call of a visitor per key.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/units/dimension.hpp"
#include "core/vec.hpp"
#include "runs/scene/json_text.hpp"

namespace acinus::runs {

/// Allowed values of a number, in base units.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;  ///< the bound itself is not allowed
  bool contains(double value) const;
};

/// Bounds as text, in the preferred unit: "> 0 um", "0 to 0.5", "" when unbounded.
std::string range_text(const Range& range, Dimension dimension, const char* unit);

/// Earliest part of a run that a key acts on. A change of the key makes that part and the later
/// ones void.
enum class Affects : std::uint8_t {
  kStart,    ///< the cells at t = 0
  kAges,     ///< those of types whose cells start at any age; the steps of other types
  kStep,     ///< the steps: those after t = 0, and the way to rest before
  kOutput,   ///< the end of the run and its files
  kNothing,  ///< no result
};

/// Part of a key in the calibration of spheres.
enum class InLaw : std::uint8_t {
  kNo,
  kDcm,     ///< constant of the deformable cells that a law is found for
  kCbm,     ///< constant of the spheres that it corrects
  kBoth,    ///< constant of both
  kSetting  ///< numerical setting of the contact that it is found with
};

/// Entry of the registry for one key. All texts are literals.
struct Key {
  const char* name = "";
  const char* meaning = "";
  Dimension dimension{};  ///< of a real number or vector
  const char* unit = "";  ///< preferred unit; "" = plain number
  bool any_unit = false;  ///< another key decides the dimension: a number or a quantity
  Range range{};
  const char* choices = "";  ///< "dcm|cbm|zoom"; "" = any
  const char* symbol = "";   ///< in the paper
  bool required = false;
  const char* automatic = "";        ///< meaning of "auto"; "" = "auto" is not allowed
  bool is_file = false;              ///< a text that is a path, or one of the choices
  const char* shipped = "";          ///< folder of shipped files that a name without ".json" finds
  bool is_run = false;               ///< a text that is the path of a run folder
  bool is_name = false;              ///< a text that is a name: letters, digits, _ and -
  bool is_label = false;             ///< the same with spaces inside
  const char* item = "";             ///< lists and maps: name of one element in `explain`
  std::optional<Affects> affects{};  ///< empty: as the block around, kStart outside all blocks
  /// false: may differ between runs of one scene that `compare` sets side by side. Empty: as the
  /// block around, true outside all blocks.
  std::optional<bool> compared{};
  bool softens = false;  ///< scaled by death.softening while a cell dissolves
  InLaw in_law = InLaw::kNo;
  const char* law_name = "";  ///< of a constant in law files, with its unit
};

/// Parts of Key::choices.
std::vector<std::string> choices_of(const Key& key);

class Visitor;

/// List or map of blocks as a visitor sees it.
struct Elements {
  std::function<std::size_t()> size;
  std::function<void(std::size_t)> resize;           ///< lists
  std::function<std::vector<std::string>()> names;   ///< maps
  std::function<void(const std::string&)> add;       ///< maps
  std::function<void(Visitor&, std::size_t)> visit;  ///< element by number
  std::function<void(Visitor&)> visit_sample;        ///< an element with defaults
};

/// Visits every key of a scene in canonical order.
class Visitor {
 public:
  using Members = std::function<void(Visitor&)>;
  virtual ~Visitor() = default;
  virtual void real(const Key& key, double& value) = 0;
  virtual void optional_real(const Key& key, std::optional<double>& value) = 0;
  virtual void integer(const Key& key, int& value) = 0;
  virtual void seed(const Key& key, std::uint64_t& value) = 0;
  virtual void flag(const Key& key, bool& value) = 0;
  virtual void text(const Key& key, std::string& value) = 0;
  virtual void vector(const Key& key, Vec3& value) = 0;
  /// Two opposite corners or null.
  virtual void box(const Key& key, std::optional<std::array<Vec3, 2>>& value) = 0;
  virtual void counts(const Key& key, std::array<int, 3>& value) = 0;
  /// List of whole numbers of any length.
  virtual void integers(const Key& key, std::vector<std::int64_t>& values) = 0;
  /// List of texts of any length.
  virtual void texts(const Key& key, std::vector<std::string>& values) = 0;
  /// Value whose type another key decides, with the place it was written; empty = not given.
  virtual void value(const Key& key, std::optional<Node>& value) = 0;
  virtual void values(const Key& key, std::vector<Node>& values) = 0;
  /// Values by names that no registry of this visitor knows.
  virtual void settings(const Key& key, std::vector<JsonMember>& members) = 0;
  /// Block that is always there.
  virtual void object(const Key& key, const Members& members) = 0;
  /// Block that may be absent; `members` may be called only while it is present.
  virtual void optional_object(const Key& key, bool present,
                               const std::function<void(bool)>& set_present,
                               const Members& members) = 0;
  virtual void list(const Key& key, const Elements& elements) = 0;
  virtual void map(const Key& key, const Elements& elements) = 0;
  /// Keys that exist only under a condition on a key visited before, such as the shape of a region.
  virtual void when(bool holds, const char* condition, const Members& members) = 0;
};

}  // namespace acinus::runs
