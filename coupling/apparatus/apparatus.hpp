#pragma once
/// List of the devices of a scene.

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

/// Devices in order of addition, which is the order of their actions. Copies share them, since
/// worlds cut out of each other have the same devices and none changes after its addition.
class Apparatus {
 public:
  template <class D>
  void add(D device) {
    devices_.push_back(std::make_shared<const D>(std::move(device)));
  }

  /// First device of a kind, else a default one without action.
  template <class D>
  const D& get() const {
    static const D none{};
    for (const auto& device : devices_)
      if (const D* found = dynamic_cast<const D*>(device.get())) return *found;
    return none;
  }

  /// Apparatus without the devices that displace whole cells.
  void remove_drives();

  // The actions of Device, for all devices.
  double next_change(double time) const;
  void set_params(double time, std::span<dcm::Params> types) const;
  void add_cell_forces(double time, const ForcedCells& cells) const;
  /// @pre the last count_rank_one() rank-one families of the system belong to the devices
  void add_loads(double time, const LoadedCells& cells) const;
  std::size_t count_rank_one() const;

 private:
  std::vector<std::shared_ptr<const Device>> devices_;
};

}  // namespace acinus::coupling
