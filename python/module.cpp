// The extension module. Each topic is bound in a file of its own in bindings/.
#include "bindings/bindings.hpp"

PYBIND11_MODULE(_corpuscle, m) {
    using namespace corpuscle::python;
    m.doc() = "The compiled part of corpuscle.";
    bind_errors(m);
    bind_force(m);
    bind_respond(m);
    bind_measures(m);
    bind_catalogue(m);
    bind_live(m);
    bind_fit(m);
    bind_trials(m);
    bind_circuit(m);
    bind_compare(m);
    bind_sweep(m);
    bind_model_export(m);
    bind_nir(m);
}
