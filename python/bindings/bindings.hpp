#pragma once
// The extension module: the public interface with numpy arrays. Arrays go in and out without a copy. The package in corpuscle/ adds what
// is easier to say in Python. There is one file for each topic; module.cpp calls them all.

#include <pybind11/complex.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <vector>

#include "corpuscle.hpp"

namespace corpuscle::python {

namespace py = pybind11;

void bind_errors(py::module_&);
void bind_force(py::module_&);
void bind_respond(py::module_&);
void bind_measures(py::module_&);
void bind_catalogue(py::module_&);
void bind_live(py::module_&);
void bind_fit(py::module_&);
void bind_trials(py::module_&);
void bind_circuit(py::module_&);
void bind_compare(py::module_&);
void bind_sweep(py::module_&);
void bind_model_export(py::module_&);
void bind_nir(py::module_&);

/// The origin of a force, which Python only hands on.
struct OriginHandle {
    std::shared_ptr<const ForceOrigin> origin = {};
};

/// An array that shows memory of `owner`, and keeps it alive.
template <class T>
py::array view_of(const std::vector<T>& values, py::handle owner) {
    py::array_t<T> out(static_cast<py::ssize_t>(values.size()), values.data(), owner);
    py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return out;
}

/// The force of an array with a row for each sample and a column for each channel, or with one channel. It must be of aligned doubles.
ForceView view_of_array(const py::array_t<double>&, double rate, double start, std::vector<std::string> channels, std::string name);

/// Notices Ctrl-C, and calls a progress function of Python, or None. False: the function asks to stop. Needs Python's lock.
bool call_progress(const py::object& function, double fraction);

/// An array that owns these values.
template <class T>
py::array_t<T> owned_array(std::vector<T>&& values) {
    auto* const held = new std::vector<T>(std::move(values));
    const py::capsule owner(held, [](void* p) { delete static_cast<std::vector<T>*>(p); });
    return py::array_t<T>(static_cast<py::ssize_t>(held->size()), held->data(), owner);
}

/// The progress function of Python, called at most 20 times a second, and Ctrl-C.
std::function<bool(double)> progress_of(const py::object& function);

}  // namespace corpuscle::python
