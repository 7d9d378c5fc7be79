#include <chrono>
#include <memory>

#include "bindings/bindings.hpp"

namespace corpuscle::python {

bool call_progress(const py::object& function, double fraction) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (function.is_none()) return true;
    const py::object go_on = function(fraction);
    if (go_on.is_none()) return true;
    const int truth = PyObject_IsTrue(go_on.ptr());
    if (truth < 0) throw py::error_already_set();
    return truth == 1;
}

// The run copies the function without Python's lock, so it is held by a pointer whose count needs no lock.
std::function<bool(double)> progress_of(const py::object& function) {
    const std::shared_ptr<py::object> shared(new py::object(function), [](py::object* f) {
        py::gil_scoped_acquire lock;
        delete f;
    });
    return [shared, last = std::chrono::steady_clock::now()](double fraction) mutable {
        const auto now = std::chrono::steady_clock::now();
        if (now - last < std::chrono::milliseconds(50) && fraction < 1) return true;
        last = now;
        py::gil_scoped_acquire lock;
        return call_progress(*shared, fraction);
    };
}

}  // namespace corpuscle::python
