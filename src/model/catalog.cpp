#include "model/catalog.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "model/components.hpp"
#include "model/model_factory.hpp"
#include "model/models.hpp"
#include "model/sensor/digital_afferent.hpp"

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

/// Calls f with the type of each component of a plan, in the order in which the signal passes them.
template <class F>
void for_each_component(const AfferentPlan& plan, const F& f) {
    const auto named = [&](std::string_view name) {
        return [&f, name]<class M>(ComponentTag<M>) {
            if (M::name == name) f.template operator()<M>();
        };
    };
    for_each_type(Sensors{}, named(plan.sensor)), for_each_type(Transducers{}, named(plan.transducer));
    for_each_type(Converters{}, named(plan.converter));
    const auto model = [&]<template <class> class M>(ModelTag<M>) { f.template operator()<M<double>>(); };
    visit_named(Receptors{}, plan.receptor, model), visit_named(Neurons{}, plan.neuron, model);
}

/// The catalogue entries of a plan's components, in the same order: the receptor and the neuron are last.
std::vector<CatalogEntry> entries_of_components(const AfferentPlan& plan) {
    std::vector<CatalogEntry> all;
    for_each_component(plan, [&]<class M>() {
        all.push_back(catalog_entry_of<M>());
        if (M::name == plan.sensor) all.back().parameters.push_back(calibration_parameter);
    });
    return all;
}

/// Returns an error if a value that must be an integer is not one.
Result<void> check_integers(const AfferentPlan& plan) {
    Result<void> ok;
    for_each_component(plan, [&]<class M>() {
        if constexpr (requires { M::integers; })
            for (const auto name : M::integers)
                if (const double x = *plan.value(name); ok && x != std::floor(x))
                    ok = bad_input(fmt::format("{}: {} = {:g} must be an integer", plan.name, name, x));
    });
    return ok;
}

/// The name of the afferent that `text` specifies.
std::string name_of(std::string_view text, const AfferentComponents& parts) {
    if (!parts.named) return std::string(text);
    const bool has_added_front_end = parts.named->front_end.empty() && !parts.front_end().empty();
    return has_added_front_end ? fmt::format("{}+{}", parts.front_end(), parts.named->name) : std::string(parts.named->name);
}

/// The plan of an afferent with the values of its name, before overrides.
AfferentPlan plan_of_components(std::string_view text, const AfferentComponents& parts) {
    const auto* named = parts.named;
    AfferentPlan plan;
    plan.name = name_of(text, parts);
    plan.sensor = parts.sensor, plan.transducer = parts.transducer, plan.converter = parts.converter;
    plan.receptor = parts.receptor, plan.neuron = parts.neuron;
    const auto entries = entries_of_components(plan);
    const auto& receptor = entries[entries.size() - 2];  // the neuron is last
    plan.description = named ? named->description : receptor.description, plan.source = named ? named->source : receptor.source;
    plan.factory = model_factory();
    visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
        if constexpr (requires { R<double>::min_rate; }) plan.min_rate = R<double>::min_rate;
    });
    if (named && named->min_rate > 0) plan.min_rate = named->min_rate;
    std::vector<AfferentParameter> parameters;
    for (const auto& entry : entries)
        for (const auto& row : entry.parameters) parameters.push_back({row, entry.name}), plan.values.push_back(row.default_value);
    for (const auto& s : named ? named->settings : std::vector<Setting>{})
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (auto& row = parameters[k].info; row.name == s.name && row.default_value != s.value)
                plan.values[k] = row.default_value = s.value, row.source = named->source;
    plan.parameters = std::make_shared<const std::vector<AfferentParameter>>(std::move(parameters));
    return plan;
}

/// The plan with these values, which the user has set.
AfferentPlan with_user_settings(const AfferentPlan& plan, std::span<const Setting> settings) {
    auto out = plan;
    auto parameters = *plan.parameters;
    for (auto& p : parameters)
        for (const auto& s : settings) p.set_by_user |= p.info.name == s.name;
    set_values(out, settings);
    out.parameters = std::make_shared<const std::vector<AfferentParameter>>(std::move(parameters));
    return out;
}

/// The location of the override that made a plan invalid: the first that does so by itself, otherwise the first. `settings` has one entry
/// for each override.
SourceLocation location_of_invalid(const AfferentPlan& plan, std::span<const ParameterOverride> overrides,
                                   std::span<const Setting> settings) {
    for (std::size_t k = 0; k < overrides.size(); ++k)
        if (!check_plan(with_user_settings(plan, settings.subspan(k, 1)))) return overrides[k].location;
    return overrides.empty() ? SourceLocation{} : overrides[0].location;
}

/// An afferent of equations: its components, as the plan with the values of its name.
class ModelSpec final : public AfferentSpec {
    AfferentPlan plan_;

public:
    ModelSpec(std::string_view text, const AfferentComponents& parts) : AfferentSpec(text), plan_(plan_of_components(text, parts)) {}
    Result<PlannedAfferent> plan(std::span<const ParameterOverride> overrides, std::span<const std::string>) const override {
        auto [own, unused] = select_overrides(overrides, [&](std::string_view target) { return matches_name(plan_, target); });
        const auto rows = parameter_infos(plan_);
        std::vector<Setting> settings;
        for (const auto& given : own) settings.push_back(TRY(setting_of(given, rows)));
        auto changed = with_user_settings(plan_, settings);
        if (const auto ok = check_plan(changed); !ok) return bad_input(ok.error().message, location_of_invalid(plan_, own, settings));
        return PlannedAfferent{{std::move(changed), std::move(unused)}, {}};
    }
};

}  // namespace

std::vector<ParameterOrder> order_constraints_of(const AfferentPlan& plan) {
    std::vector<ParameterOrder> all;
    for_each_component(plan, [&]<class M>() {
        if constexpr (requires { M::order_constraints; })
            all.insert(all.end(), std::begin(M::order_constraints), std::end(M::order_constraints));
    });
    return all;
}

Result<void> check_plan(const AfferentPlan& plan) {
    for (const auto& order : order_constraints_of(plan))
        TRY(check_order(plan.name, order, *plan.value(order.lower), *plan.value(order.upper)));
    TRY(check_integers(plan));
    const auto front = make_front_end(plan);
    if (!plan.sensor.empty()) TRY(front.check_range(plan.name, 0, "F_cal", *plan.value("F_cal")));
    if (plan.converter.empty()) return {};
    TRY(front.check_range(plan.name, *plan.value("F_low"), "F_high", *plan.value("F_high")));
    TRY(make_fixed_chain(plan));
    return {};
}

std::vector<CatalogEntry> sensor_entries() {
    auto all = entries_of_list(Sensors{});
    for (auto& entry : all) entry.parameters.push_back(calibration_parameter);
    return all;
}
std::vector<CatalogEntry> transducer_entries() { return entries_of_list(Transducers{}); }
std::vector<CatalogEntry> converter_entries() { return entries_of_list(Converters{}); }
std::vector<CatalogEntry> receptor_entries() { return entries_of_list(Receptors{}); }
std::vector<CatalogEntry> neuron_entries() { return entries_of_list(Neurons{}); }

bool matches_name(const AfferentPlan& plan, std::string_view name) {
    if (name == plan.name || (plan.traits().ignores_case && equal_ignoring_case(name, plan.name))) return true;
    const auto parts = parse_components(name);
    return parts && name_of(name, *parts) == plan.name;
}

Result<std::shared_ptr<const AfferentSpec>> read_model_spec(std::string_view text) {
    const auto parts = TRY(parse_components(text));
    return std::shared_ptr<const AfferentSpec>(std::make_shared<ModelSpec>(text, parts));
}

Result<Applied<AfferentPlan>> plan_afferent(std::string_view text, std::span<const ParameterOverride> overrides) {
    const auto spec = TRY(read_model_spec(text));
    auto planned = TRY(spec->plan(overrides, {}));
    return Applied<AfferentPlan>(std::move(planned));
}

Result<AfferentPlan> plan_afferent(std::string_view text) {
    auto planned = TRY(plan_afferent(text, {}));
    return std::move(planned.result);
}

}  // namespace corpuscle
