#include "model/population.hpp"

#include <fmt/format.h>

#include "model/lanes/crowd.hpp"

namespace corpuscle {
namespace {

using namespace lanes;

template <class V>
const LaneTable<V>& table_of(InstructionSet set) {
    constexpr bool in_double = std::is_same_v<V, double>;
    const auto pick = [](const auto& doubles, const auto& floats) -> const LaneTable<V>& {
        if constexpr (in_double)
            return (void)floats, doubles;
        else
            return (void)doubles, floats;
    };
#ifdef __x86_64__
    if (set == InstructionSet::avx512) return pick(avx512::doubles, avx512::floats);
    if (set == InstructionSet::avx2) return pick(avx2::doubles, avx2::floats);
#endif
    (void)set;
    return pick(baseline::doubles, baseline::floats);
}

template <class L>
const L* named(std::span<const L> all, std::string_view name) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const L& l) { return l.name == name; });
    return at == all.end() ? nullptr : &*at;
}

/// True if the parameters of one component are the same in all plans.
bool same_for_all(std::span<const AfferentPlan* const> plans, std::string_view part) {
    const auto& first = *plans[0];
    for (const auto* plan : plans)
        for (std::size_t k = 0; k < first.values.size(); ++k)
            if ((*first.parameters)[k].of == part && plan->values[k] != first.values[k]) return false;
    return true;
}

/// Returns an error for plans that cannot share lanes.
std::optional<Error> check_alike(std::span<const AfferentPlan* const> plans) {
    const auto& first = *plans[0];
    for (const auto* plan : plans) {
        if (plan->receptor != first.receptor || plan->neuron != first.neuron)
            return bad_input(fmt::format("a population of {} cannot contain a {}", first.made_of(), plan->made_of()));
        for (std::size_t k = 0; k < first.values.size(); ++k)
            if (const auto& p = (*first.parameters)[k]; p.row.is_shared_by_copies && plan->values[k] != first.values[k])
                return bad_input(fmt::format("{} must be the same in a whole population, but {:g} and {:g} were given", p.row.name,
                                             first.values[k], plan->values[k]));
    }
    return {};
}

/// The models of one component, for all tiles.
template <class V, class L, class List>
Buffer<std::byte> models_of(List list, const L& lanes, int width, std::span<const AfferentPlan* const> plans, std::size_t size,
                            const Run& run) {
    Buffer<std::byte> models;
    with_named(list, lanes.name, [&]<template <class> class M>(Model<M>) {
        using P = typename M<double>::Params;
        std::vector<P> params;
        const bool shared = plans.size() == 1 || same_for_all(plans, lanes.name);
        for (const auto* plan : shared ? plans.first(1) : plans) params.push_back(with_settings<P>(M<double>::fields, settings_of(*plan)));
        if (shared) {
            models = Buffer<std::byte>(lanes.model_bytes);
            lanes.build(models.data(), params.data(), 1, run.dt, run.method);
            return;
        }
        params.resize((size + tile_units - 1) / tile_units * tile_units, params.back());
        const std::size_t a_tile = tile_units / static_cast<std::size_t>(width) * lanes.model_bytes;
        models = Buffer<std::byte>(params.size() / tile_units * a_tile);
        for (std::size_t tile = 0; tile * tile_units < params.size(); ++tile)
            lanes.build(models.data() + tile * a_tile, params.data() + tile * tile_units, tile_units, run.dt, run.method);
    });
    return models;
}

template <class V>
std::unique_ptr<Population> make_tiled(const PopulationPlan& p, const Run& run, InstructionSet set) {
    const auto& table = table_of<V>(set);
    const auto& plan = *p.plans[0];
    Cast<V> layout{named(table.receptors, plan.receptor),
                   named(table.neurons, plan.neuron),
                   nullptr,
                   table.lanes,
                   p.units,
                   {},
                   {},
                   nullptr,
                   scales(plan),
                   {p.numbers.begin(), p.numbers.end()},
                   fmt::format("{}+{}", plan.receptor, plan.neuron)};
    layout.receptors = models_of<V>(Receptors{}, *layout.receptor, table.lanes, p.plans, p.units, run);
    layout.neurons = models_of<V>(Neurons{}, *layout.neuron, table.lanes, p.plans, p.units, run);
    const auto& joined = layout.receptor->joined[static_cast<std::size_t>(layout.neuron - table.neurons.data())];
    if (joined.run && joined.suits(layout.neurons.data(), layout.neurons.size() / layout.neuron->model_bytes)) layout.joined = &joined;
    if (layout.receptors.size() == layout.receptor->model_bytes) layout.once = profile_transduction(plan, run);
    return std::make_unique<Crowd<V>>(std::move(layout), run);
}

}  // namespace

bool goes_on_lanes(const AfferentPlan& plan, const Run& run) {
    return !plan.design && plan.sensor.empty() && plan.transducer.empty() && plan.converter.empty() && run.noise == 0;
}

Result<std::unique_ptr<Population>> make_population(const PopulationPlan& p, const Run& run, InstructionSet set) {
    if (p.units == 0 || p.plans.empty() || (p.plans.size() != 1 && p.plans.size() != p.units))
        return bad_input(
            fmt::format("a population of {} afferents with {} plans: give one plan, or one for each", p.units, p.plans.size()));
    if (!p.numbers.empty() && p.numbers.size() != p.units)
        return bad_input(fmt::format("{} afferent numbers for {} afferents", p.numbers.size(), p.units));
    if (auto error = check_alike(p.plans)) return *error;
    for (const auto* plan : p.plans)
        if (!goes_on_lanes(*plan, run))
            return bad_input(fmt::format("{}: netlists, sensors, converters and noise cannot run on SIMD lanes", plan->name));
    return p.precision == Precision::in_double ? make_tiled<double>(p, run, set) : make_tiled<float>(p, run, set);
}

}  // namespace corpuscle
