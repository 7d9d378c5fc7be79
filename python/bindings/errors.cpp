#include <cstring>

#include "bindings/bindings.hpp"

namespace corpuscle::python {

namespace {

/// Sets the exception; bytes of the message that are not UTF-8, such as those of a path, are escaped.
void set_exception(py::handle type, const char* message) {
    const auto text = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(message, static_cast<py::ssize_t>(std::strlen(message)), "backslashreplace"));
    if (text) PyErr_SetObject(type.ptr(), text.ptr());
}

}  // namespace

void bind_errors(py::module_& m) {
    static py::exception<InputError> input_error(m, "InputError", PyExc_ValueError);
    static py::exception<NotConvergedError> not_converged(m, "NotConvergedError", input_error.ptr());
    py::register_exception_translator([](std::exception_ptr p) {
        try {
            std::rethrow_exception(p);
        } catch (const NotConvergedError& e) {
            set_exception(not_converged, e.what());
        } catch (const InputError& e) {
            set_exception(input_error, e.what());
        } catch (const InterruptedError& e) {
            PyErr_SetString(PyExc_KeyboardInterrupt, e.what());
        }
    });
}

}  // namespace corpuscle::python
