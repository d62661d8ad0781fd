/// acinus._native: the simulator for Python.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/world/cell.hpp"
#include "python/bindings/stepped_scene.hpp"
#include "runs/assemble/substance_file.hpp"
#include "runs/calibrate/calibrate_scene.hpp"
#include "runs/calibrate/law_cache.hpp"
#include "runs/compare/compare.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/run_scene.hpp"

namespace py = pybind11;

namespace acinus::python {
namespace {

/// Errors of the program become those of the package, which Python sees as acinus.errors has them.
void raise(const Error& error) {
  const py::module_ errors = py::module_::import("acinus.errors");
  const char* name = error.code() == Exit::kCannotContinue ? "CannotContinue"
                     : error.code() == Exit::kFileError    ? "FileError"
                                                           : "BadInput";
  PyErr_SetString(errors.attr(name).ptr(), error.what());
}

/// Raises KeyboardInterrupt for a signal that stopped the work: Python knows only the user's
/// Ctrl-C.
void check_interrupt(bool went_on) {
  if (went_on) return;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

/// Read-only view of numbers that the loan keeps alive.
py::array view(const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& strides,
               const double* data, std::shared_ptr<const Loan> loan) {
  auto* kept = new std::shared_ptr<const Loan>(std::move(loan));
  const py::capsule owner(kept,
                          [](void* p) { delete static_cast<std::shared_ptr<const Loan>*>(p); });
  py::array_t<double> array(shape, strides, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

constexpr py::ssize_t kNumber = sizeof(double);

/// (n_node, 3) um of a deformable cell.
py::array nodes_of(SteppedScene& simulation, std::int64_t cell) {
  const dcm::State& s = simulation.state().dcm;
  for (std::size_t lane = 0; lane < s.n_lane(); ++lane) {
    if (s.lineage[lane] != cell) continue;
    const dcm::Group& group = s.group[lane / kLanes];
    const double* first = s.position.data() + group.first_row * kPointStride + lane % kLanes;
    return view({group.topology->n_node, 3}, {kPointStride * kNumber, kLanes * kNumber}, first,
                simulation.lend_positions());
  }
  throw Error("there is no deformable cell " + std::to_string(cell) + " now");
}

/// (n_row, 8, 3) um: sphere k is [k / 8, k % 8]; the places after the last one are unused.
py::array rows_of_spheres(SteppedScene& simulation) {
  const cbm::State& s = simulation.state().cbm;
  return view({static_cast<py::ssize_t>(s.n_row()), static_cast<py::ssize_t>(kLanes), 3},
              {kPointStride * kNumber, kNumber, kLanes * kNumber}, s.position.data(),
              simulation.lend_positions());
}

/// (n_triangle, 3): corners as numbers of nodes.
py::array triangles_of(SteppedScene& simulation, std::int64_t cell) {
  const dcm::State& s = simulation.state().dcm;
  for (std::size_t lane = 0; lane < s.n_lane(); ++lane) {
    if (s.lineage[lane] != cell) continue;
    const auto& triangle = s.group[lane / kLanes].topology->triangle;
    py::array_t<std::int64_t> corner({static_cast<py::ssize_t>(triangle.size()), py::ssize_t{3}});
    auto out = corner.mutable_unchecked<2>();
    for (std::size_t t = 0; t < triangle.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) out(t, k) = triangle[t][k];
    return corner;
  }
  throw Error("there is no deformable cell " + std::to_string(cell) + " now");
}

/// Fields of substances: origin and spacing (um), then name, unit and values (nz, ny, nx) of each.
py::tuple fields_of(const SteppedScene& simulation) {
  const io::FieldFrame frame = runs::make_field_frame(simulation.world(), simulation.time());
  const auto three = [](const Vec3& v) { return py::make_tuple(v.x(), v.y(), v.z()); };
  py::list fields;
  for (const io::VoxelField& f : frame.field) {
    py::array_t<float> value({frame.n[2], frame.n[1], frame.n[0]});
    std::ranges::copy(f.value, value.mutable_data());
    fields.append(py::make_tuple(f.name, f.unit, value));
  }
  return py::make_tuple(three(frame.origin), three(frame.spacing), fields);
}

template <class Get>
py::array column(const std::vector<coupling::CellMeasure>& cells, Get get) {
  using Value = decltype(get(cells[0]));
  py::array_t<Value> values(static_cast<py::ssize_t>(cells.size()));
  for (std::size_t k = 0; k < cells.size(); ++k) values.mutable_at(k) = get(cells[k]);
  return values;
}

/// Adds columns of substances: mean concentration in each cell, and secretion minus uptake.
void add_substances(const SteppedScene& simulation, const std::vector<coupling::CellMeasure>& cells,
                    py::dict& t) {
  const coupling::World& world = simulation.world();
  const std::vector<std::vector<double>> mean = coupling::cell_concentrations(world),
                                         rate = coupling::cell_exchange_rates(world);
  const coupling::CellIndex index = coupling::index_cells(world.state);
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const std::string& name = world.params.substances.substance[k].name;
    for (const auto& [kind, value] :
         {std::pair("concentration_", &mean[k]), {"exchange_", &rate[k]}})
      t[py::str(kind + name)] = column(cells, [&, of = value](const coupling::CellMeasure& m) {
        return (*of)[index.at(m.id).index];
      });
  }
}

/// Columns of the run file's table /cells.
py::dict cells_of(SteppedScene& simulation) {
  using Measure = coupling::CellMeasure;
  const std::vector<Measure> cells = simulation.measure();
  py::dict t;
  t["id"] = column(cells, [](const Measure& m) { return m.id; });
  t["parent"] = column(cells, [](const Measure& m) { return m.parent; });
  t["kind"] = column(cells, [](const Measure& m) { return std::int64_t{m.deformable ? 0 : 1}; });
  t["type"] = column(cells, [](const Measure& m) { return std::int64_t{m.type}; });
  t["leader"] = column(cells, [](const Measure& m) { return std::int64_t{m.leader}; });
  for (int axis = 0; axis < 3; ++axis)
    t[py::str(std::string("center_") + "xyz"[axis])] =
        column(cells, [axis](const Measure& m) { return m.center[axis]; });
  t["radius"] = column(cells, [](const Measure& m) { return m.radius; });
  t["volume"] = column(cells, [](const Measure& m) { return m.volume; });
  t["area"] = column(cells, [](const Measure& m) { return m.area; });
  t["pressure"] = column(cells, [](const Measure& m) { return m.pressure; });
  t["cytosol_pressure"] = column(cells, [](const Measure& m) { return m.cytosol_pressure; });
  t["contact_area"] = column(cells, [](const Measure& m) { return m.contact_area; });
  t["contacts"] = column(cells, [](const Measure& m) { return std::int64_t{m.contacts}; });
  t["contact_force"] = column(cells, [](const Measure& m) { return m.contact_force; });
  t["normal_force"] = column(cells, [](const Measure& m) { return m.normal_force; });
  t["migration_force"] = column(cells, [](const Measure& m) { return m.migration_force; });
  add_substances(simulation, cells, t);
  return t;
}

/// Runs a scene like `acinus run`.   @return its exit code
int run(const std::string& scene_name, const std::string& out, const std::vector<std::string>& set,
        int threads, bool overwrite, bool resume) {
  runs::RunOptions options;
  options.scene_file = scene_name;
  options.set = set;
  options.out = out;
  options.threads = threads;
  options.overwrite = overwrite;
  options.resume = resume;
  options.quiet = true;
  options.is_part = true;
  options.command_line = "acinus.simulate of Python";
  runs::Scene scene = runs::read_scene(runs::find_scene_file(scene_name), set);
  runs::check_folder(options.out, options);
  if (const int stop = runs::resolve_corrections(scene, threads, true)) return stop;
  return runs::run_scene(scene, options);
}

int calibrate(const std::string& scene_name, const std::string& out,
              const std::vector<std::string>& set, int cells, bool relaxation, int threads) {
  runs::CalibrateOptions options;
  options.out = out;
  options.threads = threads;
  options.quiet = true;
  options.clump.cells = cells;
  options.calibration.relaxation = relaxation;
  options.command_line = "acinus.calibrate of Python";
  return runs::calibrate(runs::read_scene(runs::find_scene_file(scene_name), set), options);
}

/// Rows of the table, and what is to be known about them.
py::tuple compare(const std::vector<std::string>& folders) {
  const runs::Comparison c = runs::compare_runs(folders, {});
  py::list rows;
  for (std::size_t r = 0; r < c.difference.size(); ++r)
    for (const runs::Difference& d : c.difference[r])
      rows.append(py::make_tuple(c.runs[r + 1], d.name, d.unit, d.reference, d.value, d.difference,
                                 d.absolute, d.not_measured, d.change(), d.rms()));
  return py::make_tuple(rows, c.notes);
}

using Release = py::call_guard<py::gil_scoped_release>;

void bind_simulation(py::module_& m) {
  py::class_<SteppedScene>(m, "Simulation")
      .def(py::init<const std::string&, const std::vector<std::string>&, int>(), Release())
      .def("run_until",
           [](SteppedScene& s, double end) {
             const bool went_on = [&] {
               const py::gil_scoped_release release;
               return s.run_until(end);
             }();
             check_interrupt(went_on);
           })
      .def("step",
           [](SteppedScene& s) {
             const bool went_on = [&] {
               const py::gil_scoped_release release;
               return s.step();
             }();
             check_interrupt(went_on);
           })
      .def_property_readonly("time", &SteppedScene::time)
      .def_property_readonly("is_running", &SteppedScene::is_running)
      .def_property_readonly("end", [](const SteppedScene& s) { return s.scene().time.end; })
      .def_property_readonly("name", [](const SteppedScene& s) { return s.scene().name; })
      .def_property_readonly("scene_text",
                             [](const SteppedScene& s) { return s.scene().resolved_json; })
      .def_property_readonly("steps",
                             [](const SteppedScene& s) { return s.state().clock.accepted; })
      .def_property_readonly("last_step",
                             [](const SteppedScene& s) { return s.state().clock.last_step; })
      .def_property_readonly("n_cell",
                             [](const SteppedScene& s) { return coupling::count_cells(s.state()); })
      .def_property_readonly("type_names", &SteppedScene::type_names)
      .def_property_readonly("hash", &SteppedScene::hash)
      .def("cells", &cells_of)
      .def("fields", &fields_of)
      .def("nodes", &nodes_of)
      .def("triangles", &triangles_of)
      .def("sphere_rows", &rows_of_spheres)
      .def_property_readonly("sphere_ids",
                             [](const SteppedScene& s) { return s.state().cbm.lineage; })
      .def("move",
           [](SteppedScene& s, std::int64_t cell,
              const py::array_t<double, py::array::c_style | py::array::forcecast>& point) {
             check(point.ndim() == 2 && point.shape(1) == 3, "points have the shape (n, 3)");
             std::vector<Vec3> x;
             for (py::ssize_t k = 0; k < point.shape(0); ++k)
               x.emplace_back(point.at(k, 0), point.at(k, 1), point.at(k, 2));
             s.move(cell, x);
           })
      .def("pull", [](SteppedScene& s, std::int64_t cell, const std::array<double, 3>& force) {
        s.set_pull(cell, Vec3(force[0], force[1], force[2]));
      });
}

}  // namespace

PYBIND11_MODULE(_native, m) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
  m.attr("version") = ACINUS_VERSION;
  bind_simulation(m);
  m.def("run", &run, Release());
  m.def("calibrate", &calibrate, Release());
  m.def("compare", &compare);
}

}  // namespace acinus::python
