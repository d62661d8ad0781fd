#pragma once
/// Collects the mistakes of a scene while it is read, so that they can be reported together.

#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "runs/scene/document.hpp"

namespace acinus::runs {

class Report {
 public:
  explicit Report(const Document& document) : document_(document) {}

  /// Adds a mistake at a place of the text. Its pointer counts as bad from now on.
  void add(TextPlace origin, const std::string& pointer, const std::string& message);

  /// Adds a mistake of a value: "pointer = value: message".
  void add_value(const Node& node, const std::string& pointer, const std::string& message);

  /// Adds a broken relation between keys. Stands at the first of them that the text contains, else
  /// at the nearest block around; left out if one of them is already known to be bad.
  /// @param value  how the first key's value is shown, for keys left at their default
  void add_relation(std::initializer_list<std::string> pointers, const std::string& value,
                    const std::string& message);

  /// True if this value, a component of it or a block around it is bad.
  bool is_bad(const std::string& pointer) const;

  /// Value at a pointer, nullptr if the text has none.
  const Node* find(const std::string& pointer) const;

  /// Throws everything collected as one Error; returns if there is nothing.
  void finish() const;

 private:
  void keep(Complaint complaint);

  const Document& document_;
  std::vector<Complaint> complaints_;
  std::set<std::string> bad_;
};

}  // namespace acinus::runs
