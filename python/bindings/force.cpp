#include "bindings/bindings.hpp"

namespace corpuscle::python {
namespace {

py::list samples_of(const Force& force, py::handle owner) {
    py::list out;
    for (const auto& channel : force.samples) out.append(view_of(channel, owner));
    return out;
}

}  // namespace

void bind_force(py::module_& m) {
    py::class_<Force>(m, "Force")
        .def_readonly("name", &Force::name)
        .def_readonly("rate", &Force::rate)
        .def_readonly("start", &Force::start)
        .def_readonly("channels", &Force::channels)
        .def_readonly("notes", &Force::notes)
        .def_readonly("warnings", &Force::warnings)
        .def_property_readonly("samples", [](py::object self) { return samples_of(self.cast<const Force&>(), self); });
    m.def("stimulus", &stimulus, py::arg("name"), py::arg("settings"), py::arg("rate"), py::arg("seed"));
    m.def("read_recording", &read_recording, py::arg("path"), py::arg("options"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace corpuscle::python
