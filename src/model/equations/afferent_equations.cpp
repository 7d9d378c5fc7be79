#include "model/equations/afferent_equations.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "model/models.hpp"
#include "model/parameter_values.hpp"

namespace corpuscle {
namespace {

template <class Rows>
auto find_rows(const Rows& rows, std::string_view name) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
    return at == rows.end() ? nullptr : &*at;
}

/// The values at the start of what the neuron of a plan records.
std::vector<InitialNumber> initial_numbers(const AfferentPlan& plan) {
    std::vector<InitialNumber> numbers;
    visit_named(Neurons{}, plan.neuron, [&]<template <class> class N>(ModelTag<N>) {
        const N<double> neuron(ParameterValues<N<double>>(plan), 1e-4, Method::exact);
        double values[std::size(N<double>::recordables)];
        neuron.record(neuron.start(), values);
        for (std::size_t k = 0; k < std::size(values); ++k) numbers.push_back({N<double>::recordables[k].name, values[k]});
    });
    return numbers;
}

/// The names in an expression that are not those of functions.
std::vector<std::string_view> names_in(std::string_view text) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; };
    std::vector<std::string_view> names;
    for (std::size_t from = 0, to = 0; from < text.size(); from = to + (to == from)) {
        to = from;
        while (to < text.size() && is_word(text[to])) ++to;
        const bool is_name = to > from && std::isdigit(static_cast<unsigned char>(text[from])) == 0;
        if (is_name && (to == text.size() || text[to] != '(')) names.push_back(text.substr(from, to - from));
    }
    return names;
}

/// All names that the equations of an afferent use.
std::vector<std::string_view> names_of(const ReceptorEquations& receptor, const NeuronEquations& neuron) {
    std::vector<std::string_view> all{neuron.value, neuron.threshold, neuron.refractory_time};
    const auto add = [&](std::string_view expression) {
        const auto names = names_in(expression);
        all.insert(all.end(), names.begin(), names.end());
    };
    const auto add_model = [&](const auto& model) {
        for (const auto& s : model.states) add(s.slope), add(s.initial), add(s.minimum);
        for (const auto& d : model.definitions) add(d.expression);
    };
    add_model(receptor), add_model(neuron), add(neuron.condition);
    for (const auto& a : neuron.at_spike) add(a.expression);
    return all;
}

/// The error that an afferent cannot be exported, with the reason and a remedy.
Error not_exported(const AfferentPlan& plan, const std::string& reason) {
    return bad_input(fmt::format("{}: cannot be exported as equations: {}", plan.name, reason));
}

/// Checks that the equations say all that the afferent does.
Result<void> check_complete(const AfferentPlan& plan) {
    if (plan.receptor.empty()) return not_exported(plan, "it is a netlist; use --for ngspice");
    if (!plan.converter.empty())
        return not_exported(plan, fmt::format("behind the converter '{}' it computes in fixed point; export '{}+{}'", plan.converter,
                                              plan.receptor, plan.neuron));
    if (!plan.sensor.empty())
        return not_exported(plan, fmt::format("its front end ({}) has no equations in time; export '{}+{}'",
                                              plan.transducer.empty() ? plan.sensor : plan.transducer, plan.receptor, plan.neuron));
    if (plan.value(jitter_name).value_or(0) > 0)
        return not_exported(plan, fmt::format("its threshold is random ({0} = {1:g}); add --set {2}.{0}=0", jitter_name,
                                              *plan.value(jitter_name), plan.name));
    return {};
}

}  // namespace

Result<AfferentEquations> equations_of(const AfferentPlan& plan) {
    TRY(check_complete(plan));
    AfferentEquations out{find_rows(all_receptor_equations(), plan.receptor), find_rows(all_neuron_equations(), plan.neuron), {}, {}};
    for (const auto& [name, found] : {std::pair(plan.receptor, out.receptor != nullptr), std::pair(plan.neuron, out.neuron != nullptr)})
        if (!found) return not_exported(plan, fmt::format("src/model/equations has no rows for '{}'", name));
    const auto used = names_of(*out.receptor, *out.neuron);
    for (std::size_t k = 0; k < plan.values.size(); ++k) {
        const auto& info = (*plan.parameters)[k].info;
        if (std::find(used.begin(), used.end(), info.name) == used.end()) continue;
        out.parameters.push_back({info.name, info.unit, info.description, plan.values[k]});
        if (info.name == out.neuron->refractory_time) out.refractory_time = plan.values[k];
    }
    for (const auto& number : initial_numbers(plan))
        for (const auto& state : out.neuron->states)
            if (state.name == number.name && state.initial.empty()) out.initial.push_back(number);
    return out;
}

}  // namespace corpuscle
