#include "bindings/bindings.hpp"

namespace corpuscle::python {
namespace {

/// The values of a column: real or complex.
py::array values_of(const CircuitColumn& column, py::handle owner) {
    return column.complex_values.empty() ? view_of(column.values, owner) : view_of(column.complex_values, owner);
}

/// The array and unit of a curve: of a column in memory of `plot`, or computed.
py::tuple curve_of(const py::object& plot, const std::string& name) {
    const auto& self = plot.cast<const CircuitPlot&>();
    if (const auto* column = self.find(name)) return py::make_tuple(values_of(*column, plot), column->unit);
    auto column = self.column(name);
    auto array = column.complex_values.empty() ? py::array(owned_array(std::move(column.values)))
                                               : py::array(owned_array(std::move(column.complex_values)));
    return py::make_tuple(array, column.unit);
}

py::list analyses_of(const CircuitResult& result) {
    py::list out;
    for (const auto& a : result.analyses) {
        const py::object spikes = a.spikes ? py::object(owned_array(std::vector(*a.spikes))) : py::object(py::none());
        out.append(py::make_tuple(a.name, a.report, a.counters, spikes));
    }
    return out;
}

py::list expectations_of(const CircuitResult& result) {
    py::list out;
    for (const auto& e : result.expectations) out.append(py::make_tuple(e.name, e.actual, e.expected, e.tolerance, e.is_met));
    return out;
}

std::vector<std::string> column_texts(const CircuitPlot& plot, std::string CircuitColumn::* member) {
    std::vector<std::string> out;
    for (const auto& c : plot.columns) out.push_back(c.*member);
    return out;
}

/// For copy and pickle.
py::tuple plot_state(const CircuitPlot& plot) {
    py::list columns;
    for (const auto& c : plot.columns) columns.append(py::make_tuple(c.name, c.unit, c.values, c.complex_values));
    return py::make_tuple(plot.name, plot.analysis, plot.has_sweep, plot.is_complex, plot.inner_points, columns);
}

CircuitPlot plot_of(const py::tuple& state) {
    CircuitPlot plot{state[0].cast<std::string>(), state[1].cast<std::string>(), state[2].cast<bool>(), state[3].cast<bool>(),
                     state[4].cast<std::size_t>()};
    for (const auto& c : state[5].cast<py::list>()) {
        const auto fields = c.cast<py::tuple>();
        plot.columns.push_back({fields[0].cast<std::string>(), fields[1].cast<std::string>(), fields[2].cast<std::vector<double>>(),
                                fields[3].cast<std::vector<std::complex<double>>>()});
    }
    const auto points = plot.points();
    for (const auto& c : plot.columns)
        if (c.size() != points) throw InputError("not a saved plot");
    return plot;
}

}  // namespace

void bind_circuit(py::module_& m) {
    py::class_<CircuitPlot>(m, "CircuitPlot")
        .def_readonly("name", &CircuitPlot::name)
        .def_readonly("analysis", &CircuitPlot::analysis)
        .def_readonly("has_sweep", &CircuitPlot::has_sweep)
        .def_readonly("is_complex", &CircuitPlot::is_complex)
        .def_readonly("inner_points", &CircuitPlot::inner_points)
        .def_property_readonly("names", [](const CircuitPlot& p) { return column_texts(p, &CircuitColumn::name); })
        .def_property_readonly("units", [](const CircuitPlot& p) { return column_texts(p, &CircuitColumn::unit); })
        .def("curve", &curve_of)
        .def(py::pickle(&plot_state, &plot_of));
    py::class_<CircuitResult>(m, "CircuitResult")
        .def_readonly("title", &CircuitResult::title)
        .def_readonly("step", &CircuitResult::step)
        .def_readonly("error", &CircuitResult::error)
        .def_readonly("warnings", &CircuitResult::warnings)
        .def_readonly("measures", &CircuitResult::measures)
        .def_property_readonly("analyses", &analyses_of)
        .def_property_readonly("expectations", &expectations_of)
        .def_property_readonly("plots",
                               [](const py::object& self) {
                                   py::list out;
                                   for (const auto& plot : self.cast<const CircuitResult&>().plots)
                                       out.append(py::cast(plot, py::return_value_policy::reference_internal, self));
                                   return out;
                               })
        .def_property_readonly("steps", [](const py::object& self) {
            py::list out;
            for (const auto& step : self.cast<const CircuitResult&>().steps)
                out.append(py::cast(step, py::return_value_policy::reference_internal, self));
            return out;
        });

    using Settings = std::vector<std::string>;
    py::class_<Circuit>(m, "Circuit")
        .def(py::init([](const std::string& name, Settings settings, Settings probes) {
                 return Circuit(name, {std::move(settings), std::move(probes)});
             }),
             py::call_guard<py::gil_scoped_release>())
        .def_static(
            "from_text",
            [](const std::string& text, Settings settings, Settings probes, const std::string& name) {
                return Circuit::from_text(text, {std::move(settings), std::move(probes)}, name);
            },
            py::call_guard<py::gil_scoped_release>())
        .def("run",
             [](const Circuit& circuit, const py::object& progress) {
                 const auto go_on = progress_of(progress);
                 py::gil_scoped_release released;
                 return circuit.run(go_on);
             })
        .def("analyse",
             [](const Circuit& circuit, const std::string& analysis, const Settings& words, const py::object& progress) {
                 const auto go_on = progress_of(progress);
                 py::gil_scoped_release released;
                 return circuit.analyse(analysis, words, go_on);
             })
        .def_property_readonly("name", &Circuit::name)
        .def_property_readonly("title", &Circuit::title)
        .def_property_readonly("nodes", &Circuit::nodes)
        .def_property_readonly("elements", &Circuit::elements);
    m.def("circuit_analyses", [] {
        py::list out;
        for (const auto& a : circuit_analyses()) out.append(py::make_tuple(a.name, a.usage, a.description));
        return out;
    });
}

}  // namespace corpuscle::python
