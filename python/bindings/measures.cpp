#include "bindings/bindings.hpp"

namespace corpuscle::python {

void bind_measures(py::module_& m) {
    m.def("instantaneous_rates", [](const py::array_t<double, py::array::c_style | py::array::forcecast>& train) {
        return instantaneous_rates({train.data(), static_cast<std::size_t>(train.size())});
    });
    m.def("measure_catalogue", [] {
        py::list out;
        for (const auto& d : measure_catalogue()) out.append(py::make_tuple(d.name, d.unit, d.description));
        return out;
    });
    m.def("measure_train", [](const py::array_t<double, py::array::c_style | py::array::forcecast>& train, double from, double to) {
        return measure_train({train.data(), static_cast<std::size_t>(train.size())}, from, to);
    });
}

}  // namespace corpuscle::python
