#pragma once
// The lists of all receptors and neurons. To add a model, add its include here, and its name to `Receptors` or `Neurons`.

#include <string_view>

#include "model/neuron/adaptive.hpp"
#include "model/neuron/adex.hpp"
#include "model/neuron/alif.hpp"
#include "model/neuron/izhikevich.hpp"
#include "model/neuron/lif_a.hpp"
#include "model/neuron/lif_b.hpp"
#include "model/receptor/fa1a.hpp"
#include "model/receptor/fa1b.hpp"
#include "model/receptor/fast_adapting.hpp"
#include "model/receptor/sa1a.hpp"
#include "model/receptor/sa1b.hpp"
#include "model/receptor/slowly_adapting.hpp"
#include "model/receptor/vibration_receptor.hpp"

namespace corpuscle {

/// A list of models. Each is a class template over its number type: double, SIMD lanes or dual numbers.
template <template <class> class... M>
struct ModelList {};
/// A model without its number type, to be passed to a function.
template <template <class> class M>
struct ModelTag {};
/// Calls f with the tag of each model of the list.
template <template <class> class... M, class F>
void for_each_type(ModelList<M...>, const F& f) {
    (f(ModelTag<M>{}), ...);
}

/// Calls f with the tag of the model that has this name. Does nothing if the list contains no such model.
template <class List, class F>
void visit_named(List list, std::string_view name, const F& f) {
    for_each_type(list, [&]<template <class> class M>(ModelTag<M> m) {
        if (M<double>::name == name) f(m);
    });
}

using Receptors = ModelList<Sa1a, Sa1b, Fa1a, Fa1b, Vibration, FastAdapting, SlowlyAdapting>;
using Neurons = ModelList<LifA, LifB, Adaptive, Izhikevich, Adex, Alif>;

}  // namespace corpuscle
