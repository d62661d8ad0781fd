#pragma once
/// List of the devices of a scene.

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

/// Devices in the order in which they were added, which is that of their actions. A copy shares
/// them: worlds that are cut out of one another have the same, and none is changed once it is here.
class Apparatus {
 public:
  template <class D>
  void add(D device) {
    devices_.push_back(std::make_shared<const D>(std::move(device)));
  }

  /// First device of a kind; without one, a device of that kind as it is by default, which does
  /// nothing.
  template <class D>
  const D& get() const {
    static const D none{};
    for (const auto& device : devices_)
      if (const D* found = dynamic_cast<const D*>(device.get())) return *found;
    return none;
  }

  /// Leaves out devices that drive cells from place to place.
  void remove_drives();

  // The same as of a single device, for all of them; see Device.
  double next_change(double time) const;
  void set_params(double time, std::span<dcm::Params> types) const;
  void add_cell_forces(double time, const ForcedCells& cells) const;
  /// @pre the last count_rank_one() rank-one families of the system are theirs
  void add_loads(double time, const LoadedCells& cells) const;
  std::size_t count_rank_one() const;

 private:
  std::vector<std::shared_ptr<const Device>> devices_;
};

}  // namespace acinus::coupling
