#pragma once
// The values of a model's parameters, which its constructor reads by name: value("V_th").

#include <initializer_list>
#include <iterator>

#include "core/afferent_factory.hpp"
#include "core/number/elementary.hpp"

namespace corpuscle {

/// The values of all parameters of model M, at first their defaults. Passed to a constructor, all lanes have the same values;
/// lanes/tile_vectors.hpp has the version with one value for each lane.
template <class M>
class ParameterValues {
    double values_[std::size(M::parameters)];

public:
    struct NamedValue {
        ParameterName<M> name;
        double value;
    };
    /// The defaults, except for `changed`: {{"V_th", 0.4}}.
    ParameterValues(std::initializer_list<NamedValue> changed = {}) {
        for (std::size_t k = 0; k < std::size(values_); ++k) values_[k] = M::parameters[k].default_value;
        for (const auto& [name, value] : changed) values_[name.index] = value;
    }
    /// The values of this component of a plan.
    explicit ParameterValues(const AfferentPlan& plan) {
        for (std::size_t k = 0; k < std::size(values_); ++k) values_[k] = *plan.value(M::parameters[k].name);
    }
    double& operator[](std::size_t index) { return values_[index]; }  ///< `index`: in M::parameters
    double operator[](std::size_t index) const { return values_[index]; }
    double operator()(ParameterName<M> name) const { return values_[name.index]; }
    /// The value of a parameter that must be the same on all lanes.
    double uniform(ParameterName<M> name) const { return values_[name.index]; }
};

/// Passes the parameters as dual numbers: the slope of the parameter with the index `variable` is 1, and all others are 0. All results then
/// carry their derivative with respect to that parameter.
template <class M>
struct DualValues {
    const ParameterValues<M>& values;
    std::size_t variable;
    num::Dual operator()(ParameterName<M> name) const { return {values(name), name.index == variable ? 1.0 : 0.0}; }
    double uniform(ParameterName<M> name) const { return values(name); }
};

}  // namespace corpuscle
