#include "bindings/bindings.hpp"

namespace corpuscle::python {
namespace {

std::vector<std::string> column(const Response& response, std::string RespondingAfferent::* member) {
    std::vector<std::string> out;
    for (const auto& a : response.afferents) out.push_back(a.*member);
    return out;
}

}  // namespace

void bind_respond(py::module_& m) {
    py::class_<Simulation>(m, "Simulation")
        .def(py::init<>())
        .def_readwrite("afferents", &Simulation::afferents)
        .def_readwrite("population", &Simulation::population)
        .def_readwrite("contact", &Simulation::contact)
        .def_readwrite("taxels", &Simulation::taxels)
        .def_readwrite("settings", &Simulation::settings)
        .def_readwrite("copies", &Simulation::copies)
        .def_readwrite("spreads", &Simulation::spreads)
        .def_readwrite("seed", &Simulation::seed)
        .def_readwrite("noise", &Simulation::noise)
        .def_readwrite("backward_euler", &Simulation::backward_euler)
        .def_readwrite("sampled", &Simulation::sampled)
        .def_readwrite("single_precision", &Simulation::single_precision)
        .def_readwrite("threads", &Simulation::threads);

    py::class_<Response>(m, "Response")
        .def_property_readonly("times", [](py::object self) { return view_of(self.cast<const Response&>().times, self); })
        .def_property_readonly("indices", [](py::object self) { return view_of(self.cast<const Response&>().indices, self); })
        .def_property_readonly("names", [](const Response& r) { return column(r, &RespondingAfferent::name); })
        .def_property_readonly("types", [](const Response& r) { return column(r, &RespondingAfferent::type); })
        .def_property_readonly("channels", [](const Response& r) { return column(r, &RespondingAfferent::channel); })
        .def_property_readonly("positions",
                               [](const Response& r) {
                                   py::array_t<double> out({static_cast<py::ssize_t>(r.afferents.size()), py::ssize_t{2}});
                                   for (std::size_t k = 0; k < r.afferents.size(); ++k)
                                       out.mutable_at(k, 0) = r.afferents[k].x, out.mutable_at(k, 1) = r.afferents[k].y;
                                   return out;
                               })
        .def_readonly("start", &Response::start)
        .def_readonly("duration", &Response::duration)
        .def_readonly("notes", &Response::notes)
        .def_readonly("warnings", &Response::warnings)
        .def("summary", [](const Response& r) { return r.summary(); });

    m.def(
        "respond",
        [](const py::array_t<double>& force, double rate, double start, std::vector<std::string> channels, std::string name,
           Simulation simulation, const py::object& progress) {
            const auto view = view_of_array(force, rate, start, std::move(channels), std::move(name));
            simulation.progress = progress_of(progress);
            py::gil_scoped_release released;
            return respond(view, simulation);
        },
        py::arg("force").noconvert(), py::arg("rate"), py::arg("start"), py::arg("channels"), py::arg("name"), py::arg("simulation"),
        py::arg("progress"));
    m.def(
        "respond_to",
        [](const std::string& name, Simulation simulation, double rate, const py::object& progress) {
            simulation.progress = progress_of(progress);
            py::gil_scoped_release released;
            return respond_to(name, simulation, rate);
        },
        py::arg("name"), py::arg("simulation"), py::arg("rate"), py::arg("progress"));
}

}  // namespace corpuscle::python
