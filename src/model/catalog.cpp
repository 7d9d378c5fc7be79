#include "model/catalog.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "model/parts.hpp"
#include "model/sensor/fronted.hpp"
#include "model/sensor/fronts.hpp"

namespace corpuscle {
namespace {

template <template <class> class... M>
std::vector<CatalogEntry> entries(ModelList<M...>) {
    return {catalog_entry_of<M<double>>()...};
}

template <class... M>
std::vector<CatalogEntry> entries(PartList<M...>) {
    return {catalog_entry_of<M>()...};
}

template <class List, class F>
void visit_component(List list, std::string_view name, const F& f) {
    each(list, [&]<class M>(Part<M> m) {
        if (M::name == name) f(m);
    });
}

/// The catalogue entries of a plan's components, in the order of the signal.
std::vector<CatalogEntry> entries_of(const Parts& parts) {
    std::vector<CatalogEntry> all;
    const auto add = [&](std::vector<CatalogEntry> entries, std::string_view name) {
        for (auto& c : entries)
            if (c.name == name) all.push_back(std::move(c));
    };
    add(sensor_cards(), parts.sensor), add(transducer_cards(), parts.transducer), add(converter_cards(), parts.converter);
    add(receptor_cards(), parts.receptor), add(neuron_cards(), parts.neuron);
    return all;
}

template <class M>
std::optional<Error> out_of_order(const AfferentPlan& plan) {
    if constexpr (requires { M::orders; })
        return out_of_order<typename M::Params>(plan.name, M::orders, with_settings<typename M::Params>(M::fields, settings_of(plan)));
    return {};
}

template <class M>
std::optional<Error> not_integer(const AfferentPlan& plan) {
    if constexpr (requires { M::whole; })
        for (const auto at : M::whole)
            for (const auto& f : M::fields)
                if (const double x = *plan.value(f.name); f.member == at && x != std::floor(x))
                    return bad_input(fmt::format("{}: {} = {:g} must be an integer", plan.name, f.name, x));
    return {};
}

}  // namespace

std::vector<Order> orders_of(const AfferentPlan& plan) {
    std::vector<Order> all;
    const auto add = [&]<class M>() {
        if constexpr (requires { M::orders; })
            for (const auto& o : M::orders) all.push_back({o.lower_name, o.upper_name, o.or_equal});
    };
    const auto model = [&]<template <class> class M>(Model<M>) { add.template operator()<M<double>>(); };
    const auto part = [&]<class M>(Part<M>) { add.template operator()<M>(); };
    visit_component(Sensors{}, plan.sensor, part), visit_component(Transducers{}, plan.transducer, part),
        visit_component(Converters{}, plan.converter, part);
    with_named(Receptors{}, plan.receptor, model), with_named(Neurons{}, plan.neuron, model);
    return all;
}

std::optional<Error> refusal(const AfferentPlan& plan) {
    std::optional<Error> error;
    const auto model = [&]<template <class> class M>(Model<M>) {
        if (!error) error = out_of_order<M<double>>(plan);
    };
    const auto part = [&]<class M>(Part<M>) {
        if (!error) error = out_of_order<M>(plan);
        if (!error) error = not_integer<M>(plan);
    };
    visit_component(Sensors{}, plan.sensor, part), visit_component(Transducers{}, plan.transducer, part),
        visit_component(Converters{}, plan.converter, part);
    with_named(Receptors{}, plan.receptor, model), with_named(Neurons{}, plan.neuron, model);
    const auto front = front_of(plan);
    if (!error && !plan.sensor.empty()) error = front.unreadable(plan.name, 0, "F_cal", *plan.value("F_cal"));
    if (!error && !plan.converter.empty()) error = front.unreadable(plan.name, *plan.value("F_low"), "F_high", *plan.value("F_high"));
    if (!error && !plan.converter.empty())
        if (const auto chain = fixed_chain_of(plan); !chain) error = chain.error();
    return error;
}

std::vector<CatalogEntry> sensor_cards() {
    auto all = entries(Sensors{});
    for (auto& entry : all)
        for (const auto& row : parameters_of<Calibration::Params>(Calibration::fields)) entry.parameters.push_back(row);
    return all;
}
std::vector<CatalogEntry> transducer_cards() { return entries(Transducers{}); }
std::vector<CatalogEntry> converter_cards() { return entries(Converters{}); }
std::vector<CatalogEntry> receptor_cards() { return entries(Receptors{}); }
std::vector<CatalogEntry> neuron_cards() { return entries(Neurons{}); }

std::optional<double> AfferentPlan::value(std::string_view parameter) const {
    for (std::size_t k = 0; k < values.size(); ++k)
        if ((*parameters)[k].row.name == parameter) return values[k];
    return {};
}

std::string AfferentPlan::made_of() const {
    if (design) return std::string(design->kind());
    std::string text;
    for (const auto part : {sensor, transducer, converter, receptor, neuron})
        if (!part.empty()) text += (text.empty() ? "" : "+") + std::string(part);
    return text;
}

std::vector<Setting> settings_of(const AfferentPlan& plan) {
    std::vector<Setting> settings;
    settings.reserve(plan.values.size());
    for (std::size_t k = 0; k < plan.values.size(); ++k) settings.push_back({(*plan.parameters)[k].row.name, plan.values[k]});
    return settings;
}

bool goes_by(const AfferentPlan& plan, std::string_view requested, std::string_view name) {
    if (name == requested || name == plan.name) return true;
    const auto* named = afferent_named(name);
    return named && named->name == plan.name;
}

Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const ParameterOverride> overrides) {
    const auto parts = parse_parts(text);
    if (!parts) return parts.error();
    const auto* named = parts->named;
    const auto entries = entries_of(*parts);
    const auto& receptor = entries[entries.size() - 2];
    AfferentPlan plan{std::string(text),
                      parts->receptor,
                      parts->neuron,
                      named ? named->sentence : receptor.description,
                      named ? named->source : receptor.source,
                      {},
                      {},
                      0,
                      parts->sensor,
                      parts->transducer,
                      parts->converter};
    if (named)
        plan.name = named->front.empty() && !parts->front().empty() ? fmt::format("{}+{}", parts->front(), named->name) : named->name;
    std::vector<ParameterInfo> rows;
    std::vector<Parameter> parameters;
    for (const auto& entry : entries)
        for (const auto& row : entry.parameters) {
            rows.push_back(row);
            parameters.push_back({row, entry.name});
            plan.values.push_back(row.default_value);
        }
    const auto apply = [&](std::span<const Setting> settings, bool by_user) {
        for (const auto& s : settings)
            for (std::size_t k = 0; k < parameters.size(); ++k)
                if (parameters[k].row.name == s.name) plan.values[k] = s.value, parameters[k].set = by_user;
    };
    if (named) {
        apply(named->settings, false);
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (auto& row = parameters[k].row; plan.values[k] != row.default_value)
                row.default_value = plan.values[k], row.source = named->source;  // the default of the named afferent
    }
    for (const auto& o : overrides) {  // overrides may use any of its names
        if (!goes_by(plan, text, o.target)) continue;
        const auto settings = settings_for(o.target, rows, std::span(&o, 1));
        if (!settings) return settings.error();
        apply(*settings, true);
    }
    plan.parameters = std::make_shared<const std::vector<Parameter>>(std::move(parameters));
    if (const auto error = refusal(plan)) return *error;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        if constexpr (requires { R<double>::least_rate; }) plan.least_rate = R<double>::least_rate;
    });
    return plan;
}

std::unique_ptr<Afferent> make_afferent(const AfferentPlan& plan, const Run& run) {
    if (plan.design) return plan.design->make(run.dt, run.sampled, plan.copy);
    if (!plan.converter.empty()) return make_digital(plan, run);
    const auto settings = settings_of(plan);
    std::unique_ptr<Afferent> afferent;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        with_named(Neurons{}, plan.neuron, [&]<template <class> class N>(Model<N>) {
            const auto r = with_settings<typename R<double>::Params>(R<double>::fields, settings);
            const auto n = with_settings<typename N<double>::Params>(N<double>::fields, settings);
            afferent = std::make_unique<Chain<R, N>>(r, n, run);
        });
    });
    if (!plan.sensor.empty()) return std::make_unique<Fronted>(front_of(plan), std::move(afferent));
    return afferent;
}

}  // namespace corpuscle
