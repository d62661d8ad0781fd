#pragma once
/// Reads and checks one value of a document; faults go into the report.

#include <cstdint>
#include <string>

#include "core/vec.hpp"
#include "runs/scene/document.hpp"
#include "runs/scene/fault_report.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Reader of single values. Functions that return a bool return false, and leave the field as it
/// is, where they report a fault.
class ValueReader {
 public:
  ValueReader(const Document& document, Report& report) : document_(document), report_(report) {}

  bool is_object(const Node& node, const std::string& pointer) const;
  bool has_three(const Node& node, const std::string& pointer, const Key& key) const;
  bool read_real(const Key& key, const Node& node, const std::string& pointer, double& value) const;
  void read_vector(const Key& key, const Node& node, const std::string& pointer, Vec3& value) const;
  void read_integer(const Key& key, const Node& node, const std::string& pointer, int& value) const;
  /// Reads a whole number too large for an int, such as a lineage number.
  bool read_long(const Key& key, const Node& node, const std::string& pointer,
                 std::int64_t& value) const;
  void read_file_name(const Key& key, const Node& node, const std::string& pointer,
                      std::string& value) const;
  void read_run_name(const Node& node, const std::string& pointer, std::string& value) const;

 private:
  const Document& document_;
  Report& report_;
};

}  // namespace acinus::runs
