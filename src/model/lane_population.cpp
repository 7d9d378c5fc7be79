#include "model/lane_population.hpp"

#include <fmt/format.h>

#include "model/lanes/tiled_population.hpp"
#include "model/models.hpp"

namespace corpuscle {
namespace {

using namespace lanes;

/// The kernels for an instruction set, in precision V.
template <class V>
const KernelTable<V>& table_of(InstructionSet set) {
    constexpr bool in_double = std::is_same_v<V, double>;
    const auto pick = [](const auto& doubles, const auto& floats) -> const KernelTable<V>& {
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

template <class Kernel>
const Kernel* find_by_name(std::span<const Kernel> all, std::string_view name) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Kernel& k) { return k.name == name; });
    return at == all.end() ? nullptr : &*at;
}

/// True if the parameters of one component have the same values in all plans.
bool same_for_all(std::span<const AfferentPlan* const> plans, std::string_view component) {
    const auto& first = *plans[0];
    for (const auto* plan : plans)
        for (std::size_t k = 0; k < first.values.size(); ++k)
            if ((*first.parameters)[k].component == component && plan->values[k] != first.values[k]) return false;
    return true;
}

/// Returns an error for plans that cannot share lanes.
Result<void> check_same_models(std::span<const AfferentPlan* const> plans) {
    const auto& first = *plans[0];
    for (const auto* plan : plans) {
        if (plan->receptor != first.receptor || plan->neuron != first.neuron)
            return bad_input(fmt::format("a population of {} cannot contain a {}", first.composition(), plan->composition()));
        for (std::size_t k = 0; k < first.values.size(); ++k)
            if (const auto& p = (*first.parameters)[k]; p.info.is_shared_by_copies && plan->values[k] != first.values[k])
                return bad_input(fmt::format("{} must be the same for a whole population, but {:g} and {:g} were given", p.info.name,
                                             first.values[k], plan->values[k]));
    }
    return {};
}

/// Builds the lane models of one component, the receptor or the neuron: a single model if its parameters are the same for all `size`
/// afferents, otherwise those of all tiles, one model for each vector of `width` lanes. `list` are the models in double.
template <class V, class Kernel, class List>
AlignedBuffer<std::byte> models_of(List list, const Kernel& kernel, int width, std::span<const AfferentPlan* const> plans, std::size_t size,
                                   const SimulationOptions& run) {
    AlignedBuffer<std::byte> models;
    visit_named(list, kernel.name, [&]<template <class> class M>(ModelTag<M>) {
        using P = typename M<double>::Params;
        std::vector<P> params;
        const bool shared = plans.size() == 1 || same_for_all(plans, kernel.name);
        for (const auto* plan : shared ? plans.first(1) : plans) params.push_back(with_settings<P>(M<double>::fields, settings_of(*plan)));
        if (shared) {
            models = AlignedBuffer<std::byte>(kernel.model_bytes);
            kernel.build(models.data(), params.data(), 1, run.dt, run.method);
            return;
        }
        params.resize((size + tile_size - 1) / tile_size * tile_size, params.back());  // the padding of the last tile repeats an afferent
        const std::size_t tile_bytes = tile_size / static_cast<std::size_t>(width) * kernel.model_bytes;
        models = AlignedBuffer<std::byte>(params.size() / tile_size * tile_bytes);
        for (std::size_t tile = 0; tile * tile_size < params.size(); ++tile)
            kernel.build(models.data() + tile * tile_bytes, params.data() + tile * tile_size, tile_size, run.dt, run.method);
    });
    return models;
}

template <class V>
std::unique_ptr<LanePopulation> make_tiled(const PopulationPlan& p, const SimulationOptions& run, InstructionSet set) {
    const auto& table = table_of<V>(set);
    const auto& plan = *p.plans[0];
    // Every catalogue name has a kernel, because both come from the lists in models.hpp.
    PopulationLayout<V> layout{find_by_name(table.receptors, plan.receptor),
                               find_by_name(table.neurons, plan.neuron),
                               nullptr,
                               table.lanes,
                               p.size,
                               {},
                               {},
                               nullptr,
                               scales_with_force(plan),
                               {p.afferent_numbers.begin(), p.afferent_numbers.end()},
                               fmt::format("{}+{}", plan.receptor, plan.neuron)};
    layout.receptors = models_of<V>(Receptors{}, *layout.receptor, table.lanes, p.plans, p.size, run);
    layout.neurons = models_of<V>(Neurons{}, *layout.neuron, table.lanes, p.plans, p.size, run);
    // `fused` has one kernel for each neuron of the table, in the same order.
    const auto& fused = layout.receptor->fused[static_cast<std::size_t>(layout.neuron - table.neurons.data())];
    if (fused.run && fused.is_usable(layout.neurons.data(), layout.neurons.size() / layout.neuron->model_bytes)) layout.fused = &fused;
    // A buffer of one model means that all afferents share their receptor's parameters.
    if (layout.receptors.size() == layout.receptor->model_bytes) layout.shared_receptor = make_shared_receptor(plan, run);
    return std::make_unique<TiledPopulation<V>>(std::move(layout), run);
}

}  // namespace

bool can_use_lanes(const AfferentPlan& plan, const SimulationOptions& run) { return run.noise == 0 && plan.traits().can_use_lanes; }

Result<std::unique_ptr<LanePopulation>> make_lane_population(const PopulationPlan& p, const SimulationOptions& run, InstructionSet set) {
    if (p.size == 0 || p.plans.empty() || (p.plans.size() != 1 && p.plans.size() != p.size))
        return bad_input(fmt::format("a population of {} afferents with {} plans: give one plan, or one for each", p.size, p.plans.size()));
    if (!p.afferent_numbers.empty() && p.afferent_numbers.size() != p.size)
        return bad_input(fmt::format("{} afferent numbers for {} afferents", p.afferent_numbers.size(), p.size));
    TRY(check_same_models(p.plans));
    for (const auto* plan : p.plans)
        if (!can_use_lanes(*plan, run))
            return bad_input(fmt::format("{}: netlists, sensors, converters and noise cannot run on SIMD lanes", plan->name));
    return p.precision == Precision::double_precision ? make_tiled<double>(p, run, set) : make_tiled<float>(p, run, set);
}

}  // namespace corpuscle
