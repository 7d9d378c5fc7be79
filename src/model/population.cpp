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

/// Whether the parameters of one part are the same in all plans.
bool same_for_all(std::span<const AfferentPlan* const> plans, std::string_view part) {
    const auto& first = *plans[0];
    for (const auto* plan : plans)
        for (std::size_t k = 0; k < first.values.size(); ++k)
            if ((*first.parameters)[k].of == part && plan->values[k] != first.values[k]) return false;
    return true;
}

/// Refuses plans that cannot stand side by side.
std::optional<Error> unlike(std::span<const AfferentPlan* const> plans) {
    const auto& first = *plans[0];
    for (const auto* plan : plans) {
        if (plan->receptor != first.receptor || plan->neuron != first.neuron)
            return bad_input(fmt::format("a population of {} cannot hold a {}", first.made_of(), plan->made_of()));
        for (std::size_t k = 0; k < first.values.size(); ++k)
            if (const auto& p = (*first.parameters)[k]; p.row.one_for_all && plan->values[k] != first.values[k])
                return bad_input(fmt::format("{} is one for all of a population: {:g} and {:g} cannot both be", p.row.name, first.values[k],
                                             plan->values[k]));
    }
    return {};
}

/// The models of a part, for all tiles.
template <class V, class L, class List>
Buffer<std::byte> models_of(List list, const L& lanes, int width, std::span<const AfferentPlan* const> plans, std::size_t units,
                            const Run& run) {
    Buffer<std::byte> models;
    with_named(list, lanes.name, [&]<template <class> class M>(Model<M>) {
        using P = typename M<double>::Params;
        std::vector<P> params;
        const bool shared = plans.size() == 1 || same_for_all(plans, lanes.name);
        for (const auto* plan : shared ? plans.first(1) : plans) params.push_back(with<P>(M<double>::fields, settings_of(*plan)));
        if (shared) {
            models = Buffer<std::byte>(lanes.model_bytes);
            lanes.build(models.data(), params.data(), 1, run.dt, run.method);
            return;
        }
        params.resize((units + tile_units - 1) / tile_units * tile_units, params.back());
        const std::size_t a_tile = tile_units / static_cast<std::size_t>(width) * lanes.model_bytes;
        models = Buffer<std::byte>(params.size() / tile_units * a_tile);
        for (std::size_t tile = 0; tile * tile_units < params.size(); ++tile)
            lanes.build(models.data() + tile * a_tile, params.data() + tile * tile_units, tile_units, run.dt, run.method);
    });
    return models;
}

template <class V>
std::unique_ptr<Population> crowd(const PopulationPlan& p, const Run& run, InstructionSet set) {
    const auto& table = table_of<V>(set);
    const auto& plan = *p.plans[0];
    Cast<V> cast{named(table.receptors, plan.receptor),
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
    cast.receptors = models_of<V>(Receptors{}, *cast.receptor, table.lanes, p.plans, p.units, run);
    cast.neurons = models_of<V>(Neurons{}, *cast.neuron, table.lanes, p.plans, p.units, run);
    const auto& joined = cast.receptor->joined[static_cast<std::size_t>(cast.neuron - table.neurons.data())];
    if (joined.run && joined.suits(cast.neurons.data(), cast.neurons.size() / cast.neuron->model_bytes)) cast.joined = &joined;
    if (cast.receptors.size() == cast.receptor->model_bytes) cast.once = profile_transduction(plan, run);
    return std::make_unique<Crowd<V>>(std::move(cast), run);
}

}  // namespace

bool goes_on_lanes(const AfferentPlan& plan, const Run& run) {
    return !plan.design && plan.sensor.empty() && plan.transducer.empty() && plan.converter.empty() && run.noise == 0;
}

Result<std::unique_ptr<Population>> make_population(const PopulationPlan& p, const Run& run, InstructionSet set) {
    if (p.units == 0 || p.plans.empty() || (p.plans.size() != 1 && p.plans.size() != p.units))
        return bad_input(fmt::format("a population of {} units with {} plans", p.units, p.plans.size()));
    if (!p.numbers.empty() && p.numbers.size() != p.units)
        return bad_input(fmt::format("{} numbers for {} units", p.numbers.size(), p.units));
    if (auto wrong = unlike(p.plans)) return *wrong;
    for (const auto* plan : p.plans)
        if (!goes_on_lanes(*plan, run))
            return bad_input(fmt::format("{}: netlists, sensors, converters and noise do not go on lanes", plan->name));
    return p.precision == Precision::in_double ? crowd<double>(p, run, set) : crowd<float>(p, run, set);
}

}  // namespace corpuscle
