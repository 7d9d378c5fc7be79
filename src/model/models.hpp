#pragma once
// All receptors and neurons. To add one, add its include and its name here.

#include <string_view>

#include "model/neuron/adaptive.hpp"
#include "model/neuron/adex.hpp"
#include "model/neuron/izhikevich.hpp"
#include "model/neuron/lif_a.hpp"
#include "model/neuron/lif_b.hpp"
#include "model/receptor/fa1a.hpp"
#include "model/receptor/fa1b.hpp"
#include "model/receptor/sa1a.hpp"
#include "model/receptor/sa1b.hpp"
#include "model/receptor/vibration_receptor.hpp"

namespace corpuscle {

template <template <class> class... M>
struct ModelList {
    static constexpr int size = sizeof...(M);
};
/// A model without its number type, to be passed to a function.
template <template <class> class M>
struct ModelTag {};
template <template <class> class... M, class F>
void for_each_type(ModelList<M...>, const F& f) {
    (f(ModelTag<M>{}), ...);
}

/// Calls f with the entry of the list that has this name.
template <class List, class F>
void visit_named(List list, std::string_view name, const F& f) {
    for_each_type(list, [&]<template <class> class M>(ModelTag<M> m) {
        if (M<double>::name == name) f(m);
    });
}

using Receptors = ModelList<Sa1a, Sa1b, Fa1a, Fa1b, Vibration>;
using Neurons = ModelList<LifA, LifB, Adaptive, Izhikevich, Adex>;

}  // namespace corpuscle
