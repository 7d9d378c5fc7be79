#include "bindings/bindings.hpp"

namespace corpuscle::python {

void bind_catalogue(py::module_& m) {
    m.def("catalogues", &catalogues);
    m.def("catalogue", [](const std::string& name) {
        py::list out;
        for (const auto& e : catalogue(name)) {
            py::list parameters;
            for (const auto& p : e.parameters)
                parameters.append(py::make_tuple(p.name, p.unit, p.default_value, p.low, p.high, p.description, p.source));
            out.append(py::make_tuple(e.name, e.detail, e.description, e.source, parameters));
        }
        return out;
    });
}

}  // namespace corpuscle::python
