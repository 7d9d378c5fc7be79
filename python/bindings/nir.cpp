#include "bindings/background_run.hpp"

namespace corpuscle::python {
namespace {

py::list nodes_of(const NirGraph& graph) {
    py::list out;
    for (auto& n : graph.nodes()) {
        py::dict parameters;
        for (auto& [name, values] : n.parameters) parameters[py::str(name)] = owned_array(std::move(values));
        out.append(py::make_tuple(n.name, n.type, n.input_shape, n.output_shape, parameters));
    }
    return out;
}

/// `input`: [step, input], aligned doubles in row-major order. Returns [step, output] as one dimension.
py::array run(const NirGraph& graph, const py::array_t<double, py::array::c_style>& input, double rate, const std::string& method,
              const py::object& progress) {
    const std::span<const double> values(input.data(), static_cast<std::size_t>(input.size()));
    return owned_array(run_in_background(progress, [&](const auto& go_on) { return graph.run(values, rate, method, go_on); }));
}

}  // namespace

void bind_nir(py::module_& m) {
    py::class_<NirGraph>(m, "NirGraph")
        .def(py::init<const std::string&>())
        .def("nodes", &nodes_of)
        .def("edges", &NirGraph::edges)
        .def("version", &NirGraph::version)
        .def("input_nodes", &NirGraph::input_nodes)
        .def("output_nodes", &NirGraph::output_nodes)
        .def("input_count", &NirGraph::input_count)
        .def("output_count", &NirGraph::output_count)
        .def("run", &run);
}

}  // namespace corpuscle::python
