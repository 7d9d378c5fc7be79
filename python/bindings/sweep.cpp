#include "bindings/background_run.hpp"

namespace corpuscle::python {
namespace {

py::list tuples_of(const std::vector<SweepQuantity>& quantities) {
    py::list out;
    for (const auto& q : quantities) out.append(py::make_tuple(q.name, q.unit, q.description, q.labels, q.low, q.high));
    return out;
}

}  // namespace

void bind_sweep(py::module_& m) {
    py::class_<SweepRecords>(m, "SweepRecords")
        .def(py::init<const std::string&>(), py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("results", [](const SweepRecords& r) { return py::bytes(r.results()); })
        .def_property_readonly("title", &SweepRecords::title)
        .def_property_readonly("item_count", &SweepRecords::item_count)
        .def_property_readonly("items", [](const py::object& self) { return view_of(self.cast<const SweepRecords&>().items(), self); })
        .def_property_readonly("ends", &SweepRecords::ends)
        .def_property_readonly("failures", &SweepRecords::failures)
        .def_property_readonly("axes", [](const SweepRecords& r) { return tuples_of(r.axes()); })
        .def_property_readonly("measures", [](const SweepRecords& r) { return tuples_of(r.measures()); })
        .def("axis_values",
             [](const py::object& self, std::size_t k) { return view_of(self.cast<const SweepRecords&>().axis_values(k), self); })
        .def("measure_values",
             [](const py::object& self, std::size_t k) { return view_of(self.cast<const SweepRecords&>().measure_values(k), self); })
        .def("text", &SweepRecords::text, py::call_guard<py::gil_scoped_release>())
        .def("summary", &SweepRecords::summary, py::call_guard<py::gil_scoped_release>());
    m.def("sweep",
          [](const std::string& source, bool is_text, const std::string& results, const std::string& shard,
             std::optional<std::uint64_t> seed, std::optional<std::int64_t> samples, unsigned threads, const py::object& progress) {
              SweepSettings settings{results, shard, seed, samples, threads};
              return run_in_background(progress, [&](const auto& go_on) {
                  settings.progress = go_on;
                  return is_text ? sweep_text(source, settings) : sweep(source, settings);
              });
          });
}

}  // namespace corpuscle::python
