#include "bindings/bindings.hpp"

namespace corpuscle::python {

void bind_errors(py::module_& m) {
    static py::exception<InputError> input_error(m, "InputError", PyExc_ValueError);
    static py::exception<NotConvergedError> not_converged(m, "NotConvergedError", input_error.ptr());
    py::register_exception_translator([](std::exception_ptr p) {
        try {
            std::rethrow_exception(p);
        } catch (const NotConvergedError& e) {
            not_converged(e.what());
        } catch (const InputError& e) {
            input_error(e.what());
        } catch (const InterruptedError& e) {
            PyErr_SetString(PyExc_KeyboardInterrupt, e.what());
        }
    });
}

}  // namespace corpuscle::python
