#include "bindings/bindings.hpp"

namespace corpuscle::python {
namespace {

py::list samples_of(const Force& force, py::handle owner) {
    py::list out;
    for (const auto& channel : force.samples) out.append(view_of(channel, owner));
    return out;
}

}  // namespace

ForceView view_of_array(const py::array_t<double>& array, double rate, double start, std::vector<std::string> channels, std::string name) {
    if (array.ndim() != 1 && array.ndim() != 2)
        throw InputError("force: the array has " + std::to_string(array.ndim()) +
                         " dimensions; it must have one, or two: [sample, channel]");
    constexpr auto size = static_cast<py::ssize_t>(sizeof(double));
    if (array.strides(0) % size != 0) throw InputError("force: the array is not aligned");
    ForceView out;
    out.name = std::move(name), out.rate = rate, out.start = start, out.channels = std::move(channels);
    out.count = static_cast<std::size_t>(array.shape(0));
    out.stride = array.strides(0) / size;
    if (out.count == 0) return out;  // refused by respond(); data() would be outside the array
    const auto columns = array.ndim() == 2 ? array.shape(1) : 1;
    for (py::ssize_t c = 0; c < columns; ++c) out.samples.push_back(array.ndim() == 2 ? array.data(0, c) : array.data());
    return out;
}

void bind_force(py::module_& m) {
    py::class_<OriginHandle>(m, "Origin")
        .def(py::pickle([](const OriginHandle& handle) { return save_origin(*handle.origin); },
                        [](const std::string& text) { return OriginHandle{load_origin(text)}; }));
    py::class_<Force>(m, "Force")
        .def_property_readonly("origin", [](const Force& force) { return OriginHandle{force.origin}; })
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
