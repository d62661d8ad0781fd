#pragma once
/// The variants of a study: those it names and those its sweeps make.

#include <cstdint>
#include <string>
#include <vector>

#include "runs/scene/fault_report.hpp"
#include "runs/study/study.hpp"

namespace acinus::runs {

/// One change to the scene, with the place it was written.
struct Setting {
  JsonMember value;     ///< name: the scene key
  std::string pointer;  ///< "/variants/III/set/time.end"
};

struct Variant {
  std::string name;  ///< "III", or "III/leader_force=0.3 nN"
  std::string title;
  std::string folder;        ///< the name with everything unsafe in it replaced
  std::string pointer;       ///< where it was written
  std::vector<Setting> set;  ///< in the order they are applied
  std::vector<std::int64_t> seeds;
  std::string start;  ///< "" = a start of its own
};

/// Part of a variant's name for a value of a sweep: "leader_force=0.3 nN".
std::string name_of_value(const StudySweep& sweep, const Node& value);

/// All variants in the order of their names, those of a sweep after the ones it is made of.
/// Unknown names, circles, doubled names and seeds go into the report.
std::vector<Variant> make_variants(const Study& study, Report& report);

/// The variants a name stands for: itself, or with * at its end all whose name begins so.
/// @return indices into `variants`; none if there is no such variant
std::vector<std::size_t> find_variants(const std::vector<Variant>& variants,
                                       const std::string& name);

/// What to say about a name that stands for no variant.
std::string unknown_variant(const std::vector<Variant>& variants, const std::string& name);

}  // namespace acinus::runs
