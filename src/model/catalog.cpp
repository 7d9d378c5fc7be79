#include "model/catalog.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "model/afferent_components.hpp"
#include "model/sensor/front_end_afferent.hpp"
#include "model/sensor/front_end_factory.hpp"

namespace corpuscle {
namespace {

template <template <class> class... M>
std::vector<CatalogEntry> entries_of_list(ModelList<M...>) {
    return {catalog_entry_of<M<double>>()...};
}

template <class... M>
std::vector<CatalogEntry> entries_of_list(ComponentList<M...>) {
    return {catalog_entry_of<M>()...};
}

/// Calls f with the tag of the component that has this name. Does nothing if the name is "" or not in the list.
template <class List, class F>
void visit_component(List list, std::string_view name, const F& f) {
    for_each_type(list, [&]<class M>(ComponentTag<M> m) {
        if (M::name == name) f(m);
    });
}

/// The catalogue entries of an afferent's components, in the order in which the signal passes them: the receptor and the neuron are last.
std::vector<CatalogEntry> entries_of_components(const AfferentComponents& parts) {
    std::vector<CatalogEntry> all;
    const auto add = [&](std::vector<CatalogEntry> entries, std::string_view name) {
        for (auto& c : entries)
            if (c.name == name) all.push_back(std::move(c));
    };
    add(sensor_entries(), parts.sensor), add(transducer_entries(), parts.transducer), add(converter_entries(), parts.converter);
    add(receptor_entries(), parts.receptor), add(neuron_entries(), parts.neuron);
    return all;
}

template <class M>
Result<void> check_model_order(const AfferentPlan& plan) {
    if constexpr (requires { M::order_constraints; })
        return check_order<typename M::Params>(plan.name, M::order_constraints,
                                               with_settings<typename M::Params>(M::fields, settings_of(plan)));
    return {};
}

template <class M>
Result<void> check_integers(const AfferentPlan& plan) {
    if constexpr (requires { M::integers; })
        for (const auto at : M::integers)
            for (const auto& f : M::fields)
                if (const double x = *plan.value(f.name); f.member == at && x != std::floor(x))
                    return bad_input(fmt::format("{}: {} = {:g} must be an integer", plan.name, f.name, x));
    return {};
}

}  // namespace

std::vector<ParameterOrder> order_constraints_of(const AfferentPlan& plan) {
    std::vector<ParameterOrder> all;
    const auto add = [&]<class M>() {
        if constexpr (requires { M::order_constraints; })
            for (const auto& o : M::order_constraints) all.push_back({o.lower_name, o.upper_name, o.or_equal});
    };
    const auto model = [&]<template <class> class M>(ModelTag<M>) { add.template operator()<M<double>>(); };
    const auto part = [&]<class M>(ComponentTag<M>) { add.template operator()<M>(); };
    visit_component(Sensors{}, plan.sensor, part), visit_component(Transducers{}, plan.transducer, part),
        visit_component(Converters{}, plan.converter, part);
    visit_named(Receptors{}, plan.receptor, model), visit_named(Neurons{}, plan.neuron, model);
    return all;
}

Result<void> check_plan(const AfferentPlan& plan) {
    Result<void> ok;
    const auto model = [&]<template <class> class M>(ModelTag<M>) {
        if (ok) ok = check_model_order<M<double>>(plan);
    };
    const auto part = [&]<class M>(ComponentTag<M>) {
        if (ok) ok = check_model_order<M>(plan);
        if (ok) ok = check_integers<M>(plan);
    };
    visit_component(Sensors{}, plan.sensor, part), visit_component(Transducers{}, plan.transducer, part),
        visit_component(Converters{}, plan.converter, part);
    visit_named(Receptors{}, plan.receptor, model), visit_named(Neurons{}, plan.neuron, model);
    const auto front = make_front_end(plan);
    if (ok && !plan.sensor.empty()) ok = front.check_range(plan.name, 0, "F_cal", *plan.value("F_cal"));
    if (ok && !plan.converter.empty()) ok = front.check_range(plan.name, *plan.value("F_low"), "F_high", *plan.value("F_high"));
    if (ok && !plan.converter.empty())
        if (const auto chain = make_fixed_chain(plan); !chain) ok = chain.error();
    return ok;
}

std::vector<CatalogEntry> sensor_entries() {
    auto all = entries_of_list(Sensors{});
    for (auto& entry : all)
        for (const auto& parameter : parameters_of<Calibration::Params>(Calibration::fields)) entry.parameters.push_back(parameter);
    return all;
}
std::vector<CatalogEntry> transducer_entries() { return entries_of_list(Transducers{}); }
std::vector<CatalogEntry> converter_entries() { return entries_of_list(Converters{}); }
std::vector<CatalogEntry> receptor_entries() { return entries_of_list(Receptors{}); }
std::vector<CatalogEntry> neuron_entries() { return entries_of_list(Neurons{}); }

std::optional<double> AfferentPlan::value(std::string_view parameter) const {
    for (std::size_t k = 0; k < values.size(); ++k)
        if ((*parameters)[k].info.name == parameter) return values[k];
    return {};
}

std::string AfferentPlan::composition() const {
    if (factory) return std::string(factory->kind());
    std::string text;
    for (const auto part : {sensor, transducer, converter, receptor, neuron})
        if (!part.empty()) text += (text.empty() ? "" : "+") + std::string(part);
    return text;
}

std::vector<Setting> settings_of(const AfferentPlan& plan) {
    std::vector<Setting> settings;
    settings.reserve(plan.values.size());
    for (std::size_t k = 0; k < plan.values.size(); ++k) settings.push_back({(*plan.parameters)[k].info.name, plan.values[k]});
    return settings;
}

bool matches_name(const AfferentPlan& plan, std::string_view requested, std::string_view name) {
    if (name == requested || name == plan.name) return true;
    const auto* named = find_named_afferent(name);
    return named && named->name == plan.name;
}

Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const ParameterOverride> overrides) {
    const auto parts = parse_components(text);
    if (!parts) return parts.error();
    const auto* named = parts->named;
    const auto entries = entries_of_components(*parts);
    const auto& receptor = entries[entries.size() - 2];  // the neuron is last
    AfferentPlan plan{std::string(text),
                      parts->receptor,
                      parts->neuron,
                      named ? named->description : receptor.description,
                      named ? named->source : receptor.source,
                      {},
                      {},
                      0,
                      parts->sensor,
                      parts->transducer,
                      parts->converter};
    if (named)
        plan.name =
            named->front_end.empty() && !parts->front_end().empty() ? fmt::format("{}+{}", parts->front_end(), named->name) : named->name;
    std::vector<ParameterInfo> rows;
    std::vector<AfferentParameter> parameters;
    for (const auto& entry : entries)
        for (const auto& row : entry.parameters) {
            rows.push_back(row);
            parameters.push_back({row, entry.name});
            plan.values.push_back(row.default_value);
        }
    const auto apply = [&](std::span<const Setting> settings, bool by_user) {
        for (const auto& s : settings)
            for (std::size_t k = 0; k < parameters.size(); ++k)
                if (parameters[k].info.name == s.name) plan.values[k] = s.value, parameters[k].set_by_user = by_user;
    };
    if (named) {
        apply(named->settings, false);
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (auto& row = parameters[k].info; plan.values[k] != row.default_value)
                row.default_value = plan.values[k], row.source = named->source;  // its defaults differ from those of its models
    }
    for (const auto& o : overrides) {  // its target may be any name or alias of the afferent
        if (!matches_name(plan, text, o.target)) continue;
        const auto settings = settings_for(o.target, rows, std::span(&o, 1));
        if (!settings) return settings.error();
        apply(*settings, true);
    }
    plan.parameters = std::make_shared<const std::vector<AfferentParameter>>(std::move(parameters));
    if (const auto ok = check_plan(plan); !ok) return ok.error();
    visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
        if constexpr (requires { R<double>::min_rate; }) plan.min_rate = R<double>::min_rate;
    });
    return plan;
}

std::unique_ptr<Afferent> make_afferent(const AfferentPlan& plan, const SimulationOptions& run) {
    if (plan.factory) return plan.factory->make(run.dt, run.spikes_on_samples, plan.copy_number);
    if (!plan.converter.empty()) return make_digital(plan, run);
    const auto settings = settings_of(plan);
    std::unique_ptr<Afferent> afferent;
    visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
        visit_named(Neurons{}, plan.neuron, [&]<template <class> class N>(ModelTag<N>) {
            const auto r = with_settings<typename R<double>::Params>(R<double>::fields, settings);
            const auto n = with_settings<typename N<double>::Params>(N<double>::fields, settings);
            afferent = std::make_unique<Chain<R, N>>(r, n, run);
        });
    });
    // A plan with a transducer also has a sensor.
    if (!plan.sensor.empty()) return std::make_unique<FrontEndAfferent>(make_front_end(plan), std::move(afferent));
    return afferent;
}

}  // namespace corpuscle
