#include "bindings/bindings.hpp"

namespace corpuscle::python {

void bind_model_export(py::module_& m) {
    m.def("export_target_names", &export_target_names);
    m.def(
        "export_model",
        [](const std::string& subject, const std::string& target, const std::vector<std::string>& settings,
           std::map<std::string, std::string> kit) {
            const ExportKit named{kit["card"], kit["map"], kit["nch"], kit["pch"], kit["hv_nch"], kit["hv_pch"], kit["deck"]};
            auto model = export_model(subject, target, settings, named);
            return py::make_tuple(py::bytes(model.text), model.warnings, model.is_text);
        },
        py::arg("subject"), py::arg("target"), py::arg("settings"), py::arg("kit"));
}

}  // namespace corpuscle::python
