#pragma once
// The lists of all components that can come before a receptor. To add a sensor, transducer or converter, add its include and its name here.
// A second converter also needs its computation in front_end_factory.cpp.

#include "model/sensor/adc.hpp"
#include "model/sensor/f2i.hpp"
#include "model/sensor/f2v.hpp"
#include "model/sensor/fsr.hpp"

namespace corpuscle {

/// A list of components that can come before a receptor. They are computed in double only, not on lanes.
template <class... M>
struct ComponentList {};
/// The type of a component, to be passed to a function.
template <class M>
struct ComponentTag {};
/// Calls f with the tag of each component of the list.
template <class... M, class F>
void for_each_type(ComponentList<M...>, const F& f) {
    (f(ComponentTag<M>{}), ...);
}

using Sensors = ComponentList<Fsr>;
using Transducers = ComponentList<F2v, F2i>;
using Converters = ComponentList<Adc>;

}  // namespace corpuscle
