#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "io/hdf5.hpp"
#include "io/hdf5_form.hpp"

namespace acinus::io::h5 {

void File::write_volume(const std::string& name, const std::array<std::int64_t, 3>& extent,
                        std::span<const float> value, bool filtered) {
  constexpr hsize_t kChunk = 1 << 20;  // numbers
  hsize_t size[3], chunk[3];
  for (int k = 0; k < 3; ++k) size[k] = chunk[k] = static_cast<hsize_t>(extent[k]);
  ACINUS_ASSERT(size[0] * size[1] * size[2] == value.size());
  chunk[0] = std::max<hsize_t>(1, std::min(size[0], kChunk / (size[1] * size[2])));
  const Handle space(H5Screate_simple(3, size, nullptr), H5Sclose);
  const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(list.id(), 3, chunk);
  H5Pset_obj_track_times(list.id(), false);
  if (filtered) {
    H5Pset_shuffle(list.id());
    H5Pset_deflate(list.id(), 1);
  }
  H5Pset_fletcher32(list.id());
  const Handle dataset(H5Dcreate2(id(), name.c_str(), H5T_IEEE_F32LE, space.id(), H5P_DEFAULT,
                                  list.id(), H5P_DEFAULT),
                       H5Dclose);
  if (!dataset.valid()) fail_here("create dataset " + name);
  if (H5Dwrite(dataset.id(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0)
    fail_here("write dataset " + name);
}

void File::write_numbers(const std::string& object, const std::string& name,
                         std::span<const double> value) {
  const Handle owner(H5Oopen(id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  const hsize_t n = value.size();
  const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose);
  const Handle attribute(
      H5Acreate2(owner.id(), name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, value.data()) < 0)
    fail_here("write attribute " + name + " of " + object);
}

std::vector<double> File::read_numbers(const std::string& object, const std::string& name) const {
  constexpr double kMost = 64;
  const Handle attribute = open_attribute(object, name);
  const Form form = form_of_attribute(attribute.id());
  if (form.type != H5T_FLOAT || form.width != sizeof(double) || form.n_value() > kMost)
    refuse(fmt::format("attribute {} of {} holds {}, where a few numbers are expected", name,
                       object, describe(form)));
  std::vector<double> value(static_cast<std::size_t>(form.n_value()));
  if (!value.empty() && H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, value.data()) < 0)
    fail_here("read attribute " + name + " of " + object);
  return value;
}

std::vector<float> File::read_volume(const std::string& name,
                                     const std::array<std::int64_t, 3>& extent) const {
  const Handle dataset = open_dataset(name);
  const Form form = form_of_dataset(dataset.id());
  if (form.type != H5T_FLOAT || form.width != sizeof(float) ||
      !std::ranges::equal(form.extent, extent))
    refuse(fmt::format("dataset {} holds {}, where {} x {} x {} numbers are expected", name,
                       describe(form), extent[0], extent[1], extent[2]));
  check_storage(dataset, name, form.n_value() * sizeof(float));
  std::vector<float> value(static_cast<std::size_t>(form.n_value()));
  if (H5Dread(dataset.id(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0)
    fail_here("read dataset " + name);
  return value;
}

}  // namespace acinus::io::h5
