#include "core/parallel/partition.hpp"

#include <mpi.h>
#include <trilinos/zoltan.h>

#include <cstddef>

#include "core/error.hpp"

namespace acinus {
namespace {

/// Points to partition, for Zoltan's queries. Each process contributes the run [first, last).
struct SharedPlaces {
  std::span<const Vec3> place;
  std::span<const double> cost;
  std::size_t first = 0, last = 0;
};
const SharedPlaces& of(void* data) { return *static_cast<const SharedPlaces*>(data); }

int count_points(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(of(data).last - of(data).first);
}

/// Arguments of Zoltan's query for the list of objects.
struct ListQuery {
  void* data;
  int n_global, n_local;
  ZOLTAN_ID_PTR global, local;
  int n_weight;
  float* weight;
  int* error;
};

/// Writes the numbers and costs of the points that this process contributes.
void list_points(const ListQuery& q) {
  const SharedPlaces& p = of(q.data);
  for (std::size_t k = p.first; k < p.last; ++k) {
    q.global[k - p.first] = static_cast<ZOLTAN_ID_TYPE>(k);
    q.weight[k - p.first] = static_cast<float>(p.cost[k]);
  }
  *q.error = ZOLTAN_OK;
}

int count_dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

/// Arguments of Zoltan's query for the coordinates of objects.
struct PlaceQuery {
  void* data;
  int n_global, n_local, n_object;
  ZOLTAN_ID_PTR global, local;
  int n_dimension;
  double* coordinate;
  int* error;
};

/// Writes the coordinates of points, um.
void locate_points(const PlaceQuery& q) {
  for (int k = 0; k < q.n_object; ++k)
    for (int c = 0; c < 3; ++c) q.coordinate[3 * k + c] = of(q.data).place[q.global[k]][c];
  *q.error = ZOLTAN_OK;
}

void require(int status, const char* what) {
  check(status == ZOLTAN_OK || status == ZOLTAN_WARN,
        std::string("cells cannot be shared among processes: Zoltan fails at ") + what,
        Exit::kInternal);
}

/// Zoltan instance with its parameters.
class Partitioner {
 public:
  Partitioner(const Ranks& ranks, SharedPlaces& places) {
    float version = 0;
    require(Zoltan_Initialize(0, nullptr, &version), "its start");
    zoltan_ = Zoltan_Create(MPI_Comm_f2c(ranks.communicator()));
    check(zoltan_ != nullptr, "Zoltan cannot be started", Exit::kInternal);
    constexpr const char* kSettings[][2] = {{"DEBUG_LEVEL", "0"},     {"LB_METHOD", "RCB"},
                                            {"NUM_GID_ENTRIES", "1"}, {"NUM_LID_ENTRIES", "0"},
                                            {"OBJ_WEIGHT_DIM", "1"},  {"RETURN_LISTS", "PARTS"},
                                            {"IMBALANCE_TOL", "1.02"}};
    for (const auto& [name, value] : kSettings)
      require(Zoltan_Set_Param(zoltan_, name, value), name);
    const ZOLTAN_OBJ_LIST_FN* list = [](auto... argument) { list_points({argument...}); };
    const ZOLTAN_GEOM_MULTI_FN* locate = [](auto... argument) { locate_points({argument...}); };
    Zoltan_Set_Num_Obj_Fn(zoltan_, count_points, &places);
    Zoltan_Set_Obj_List_Fn(zoltan_, list, &places);
    Zoltan_Set_Num_Geom_Fn(zoltan_, count_dimensions, &places);
    Zoltan_Set_Geom_Multi_Fn(zoltan_, locate, &places);
  }
  ~Partitioner() { Zoltan_Destroy(&zoltan_); }
  Partitioner(const Partitioner&) = delete;
  Partitioner& operator=(const Partitioner&) = delete;

  /// Partitions the points; calls f(point, rank) for those that this process contributed.
  template <class F>
  void run(F f) {
    int changes = 0, n_global = 0, n_local = 0, n_import = 0, n_export = 0;
    int *import_rank = nullptr, *import_part = nullptr, *rank = nullptr, *part = nullptr;
    ZOLTAN_ID_PTR import = nullptr, import_local = nullptr, place = nullptr, local = nullptr;
    require(Zoltan_LB_Partition(zoltan_, &changes, &n_global, &n_local, &n_import, &import,
                                &import_local, &import_rank, &import_part, &n_export, &place,
                                &local, &rank, &part),
            "partitioning");
    for (int k = 0; k < n_export; ++k) f(place[k], part[k]);
    Zoltan_LB_Free_Part(&import, &import_local, &import_rank, &import_part);
    Zoltan_LB_Free_Part(&place, &local, &rank, &part);
  }

 private:
  Zoltan_Struct* zoltan_ = nullptr;
};

}  // namespace

std::vector<int> partition(const Ranks& ranks, std::span<const Vec3> place,
                           std::span<const double> cost) {
  ACINUS_ASSERT(place.size() == cost.size());
  std::vector<int> owner(place.size(), 0);
  if (ranks.is_alone()) return owner;
  const std::size_t n_rank = ranks.size(), rank = ranks.rank();
  if (place.size() <= n_rank) {  // which Zoltan does not take
    for (std::size_t k = 0; k < place.size(); ++k) owner[k] = static_cast<int>(k);
    return owner;
  }
  SharedPlaces own{place, cost, rank * place.size() / n_rank, (rank + 1) * place.size() / n_rank};
  Partitioner(ranks, own).run([&](std::size_t k, int part) { owner[k] = part; });
  const std::vector<int> found(owner.begin() + static_cast<std::ptrdiff_t>(own.first),
                               owner.begin() + static_cast<std::ptrdiff_t>(own.last));
  ranks.gather<int>(found, owner);
  return owner;
}

}  // namespace acinus
