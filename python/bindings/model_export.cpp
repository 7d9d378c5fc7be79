#include "bindings/bindings.hpp"

namespace corpuscle::python {

void bind_model_export(py::module_& m) {
    m.def("export_target_names", &export_target_names);
    m.def(
        "export_model",
        [](const std::string& subject, const std::string& target, const std::vector<std::string>& settings) {
            auto model = export_model(subject, target, settings);
            return py::make_tuple(py::bytes(model.text), model.warnings, model.is_text);
        },
        py::arg("subject"), py::arg("target"), py::arg("settings"));
}

}  // namespace corpuscle::python
