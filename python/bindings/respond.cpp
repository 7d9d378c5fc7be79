#include "bindings/bindings.hpp"

namespace corpuscle::python {
namespace {

std::vector<std::string> column(const Response& response, std::string RespondingAfferent::* member) {
    std::vector<std::string> out;
    for (const auto& a : response.afferents) out.push_back(a.*member);
    return out;
}

/// The fields of a simulation for copy and pickle, without the progress function.
py::tuple state_of(const Simulation& s) {
    return py::make_tuple(s.afferents, s.population, s.contact, s.taxels, s.settings, s.copies, s.spreads, s.seed, s.noise,
                          s.backward_euler, s.sampled, s.single_precision, s.threads);
}

Simulation simulation_of(const py::tuple& state) {
    if (state.size() != 13) throw InputError("the saved simulation is of another version");
    Simulation s;
    std::size_t k = 0;
    const auto read = [&](auto& member) { member = state[k++].cast<std::remove_reference_t<decltype(member)>>(); };
    read(s.afferents), read(s.population), read(s.contact), read(s.taxels), read(s.settings), read(s.copies), read(s.spreads), read(s.seed);
    read(s.noise), read(s.backward_euler), read(s.sampled), read(s.single_precision), read(s.threads);
    return s;
}

}  // namespace

void bind_respond(py::module_& m) {
    py::enum_<ReportDetail>(m, "ReportDetail")
        .value("none", ReportDetail::none)
        .value("brief", ReportDetail::brief)
        .value("complete", ReportDetail::complete);
    m.def("check_report", &check_report);
    m.def("write_report", &write_report);

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
        .def_readwrite("threads", &Simulation::threads)
        .def_readwrite("report", &Simulation::report)
        .def(py::pickle(&state_of, &simulation_of));

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
        .def_property_readonly("skin_force",
                               [](const Response& r) { return r.skin_force ? py::cast(*r.skin_force) : py::object(py::none()); })
        .def_readonly("notes", &Response::notes)
        .def_readonly("warnings", &Response::warnings)
        .def("models",
             [](const Response& r) {
                 const auto all = r.models();
                 py::list parameters;
                 for (const auto& p : all.parameters)
                     parameters.append(py::make_tuple(p.name, p.unit, p.description,
                                                      py::array_t<double>(static_cast<py::ssize_t>(p.values.size()), p.values.data())));
                 return py::make_tuple(all.models, all.properties, parameters);
             })
        .def("silence_notes", [](const Response& r) { return r.silence_notes(); })
        .def("summary", [](const Response& r) { return r.summary(); })
        .def("report", [](const Response& r, const std::string& command) { return r.report(command); });

    m.def(
        "respond",
        [](const py::array_t<double>& force, double rate, double start, std::vector<std::string> channels, std::string name,
           const OriginHandle* origin, Simulation simulation, const py::object& progress) {
            auto view = view_of_array(force, rate, start, std::move(channels), std::move(name));
            if (origin) view.origin = origin->origin;
            simulation.progress = progress_of(progress);
            py::gil_scoped_release released;
            return respond(view, simulation);
        },
        py::arg("force").noconvert(), py::arg("rate"), py::arg("start"), py::arg("channels"), py::arg("name"), py::arg("origin"),
        py::arg("simulation"), py::arg("progress"));
    m.def(
        "write_nwb",
        [](const std::string& path, const Response& response, const py::object& force, const std::vector<std::string>& fields,
           const std::string& source, bool is_measured, double resolution, std::uint64_t seed,
           const std::vector<std::tuple<double, double, std::string>>& trials, bool overwrite) {
            NwbOptions options{fields, source, is_measured, resolution, seed, {}, overwrite};
            for (const auto& [start, stop, label] : trials) options.trials.push_back({start, stop, label});
            if (force.is_none()) return write_nwb(path, response, nullptr, options);
            const auto samples = force.attr("samples").cast<py::array_t<double>>();
            const auto view =
                view_of_array(samples, force.attr("rate").cast<double>(), force.attr("start").cast<double>(),
                              force.attr("channels").cast<std::vector<std::string>>(), force.attr("name").cast<std::string>());
            write_nwb(path, response, &view, options);
        },
        py::arg("path"), py::arg("response"), py::arg("force"), py::arg("fields"), py::arg("source"), py::arg("is_measured"),
        py::arg("resolution"), py::arg("seed"), py::arg("trials"), py::arg("overwrite"));
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
