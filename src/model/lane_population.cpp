#include "model/lane_population.hpp"

#include <fmt/format.h>

#include "model/lanes/tiled_population.hpp"
#include "model/models.hpp"
#include "model/parameter_values.hpp"

namespace corpuscle {
namespace {

using namespace lanes;

template <class Kernel>
const Kernel* find_by_name(std::span<const Kernel> all, std::string_view name) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Kernel& k) { return k.name == name; });
    return at == all.end() ? nullptr : &*at;
}

/// The indices of the parameters of a plan for which is_wanted(parameter) is true.
template <class F>
std::vector<std::size_t> parameters_where(const AfferentPlan& plan, const F& is_wanted) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < plan.values.size(); ++k)
        if (is_wanted((*plan.parameters)[k])) out.push_back(k);
    return out;
}

/// Returns an error for plans that cannot share lanes.
Result<void> check_same_models(std::span<const AfferentPlan* const> plans) {
    const auto& first = *plans[0];
    const auto shared = parameters_where(first, [](const AfferentParameter& p) { return p.info.is_shared_by_copies; });
    for (const auto* plan : plans) {
        if (plan->receptor != first.receptor || plan->neuron != first.neuron)
            return bad_input(fmt::format("a population of {} cannot contain a {}", first.composition(), plan->composition()));
        for (const auto k : shared)
            if (plan->values[k] != first.values[k])
                return bad_input(fmt::format("{} must be the same for a whole population, but {:g} and {:g} were given",
                                             (*first.parameters)[k].info.name, first.values[k], plan->values[k]));
    }
    return {};
}

/// Builds the lane models of one component, the receptor or the neuron: a single model if its parameters are the same for all `size`
/// afferents, otherwise those of all tiles, one model for each vector of `width` lanes.
template <class Kernel>
AlignedBuffer<std::byte> models_of(const Kernel& kernel, int width, std::span<const AfferentPlan* const> plans, std::size_t size,
                                   const SimulationOptions& run) {
    const auto own = parameters_where(*plans[0], [&](const AfferentParameter& p) { return p.component == kernel.name; });
    const std::size_t parameters = own.size();
    std::vector<double> values;
    values.reserve((plans.size() + tile_size) * parameters);
    for (const auto* plan : plans)
        for (const auto k : own) values.push_back(plan->values[k]);
    if (std::equal(values.begin() + static_cast<std::ptrdiff_t>(parameters), values.end(), values.begin())) {
        AlignedBuffer<std::byte> model(kernel.model_bytes);
        kernel.build(model.data(), values.data(), 1, run.dt, run.method);
        return model;
    }
    const std::size_t tiles = (size + tile_size - 1) / tile_size,
                      tile_bytes = tile_size / static_cast<std::size_t>(width) * kernel.model_bytes;
    while (values.size() < tiles * tile_size * parameters)  // the padding of the last tile repeats an afferent
        values.push_back(values[values.size() - parameters]);
    AlignedBuffer<std::byte> models(tiles * tile_bytes);
    for (std::size_t tile = 0; tile < tiles; ++tile)
        kernel.build(models.data() + tile * tile_bytes, values.data() + tile * tile_size * parameters, tile_size, run.dt, run.method);
    return models;
}

template <class R>
class ReceptorRun final : public SharedReceptor {
    R receptor_;
    typename R::State state_ = {};
    std::int64_t step_ = 0;  // number of samples simulated so far

public:
    explicit ReceptorRun(R receptor) : receptor_(std::move(receptor)) {}

    std::vector<double> save() const override {
        static_assert(std::is_trivially_copyable_v<typename R::State> && sizeof(state_) % sizeof(double) == 0);
        std::vector<double> all(1 + sizeof(state_) / sizeof(double), static_cast<double>(step_));
        std::memcpy(all.data() + 1, &state_, sizeof(state_));
        return all;
    }
    bool resume(std::span<const double> saved) override {
        if (saved.size() != 1 + sizeof(state_) / sizeof(double) || !(saved[0] >= 0 && saved[0] <= 0x1p53)) return false;
        step_ = static_cast<std::int64_t>(saved[0]);
        std::memcpy(&state_, saved.data() + 1, sizeof(state_));
        return true;
    }

    void run(std::span<const double> force, bool first, std::array<ProfileCurrents, max_outputs>& out) override {
        static_assert(R::outputs <= max_outputs);
        if (force.empty()) return;
        if (first) state_ = receptor_.start(force[0]);
        for (auto& currents : out)
            for (auto& part : currents) part.resize(force.size());
        for (std::size_t t = 0; t < force.size(); ++t, ++step_) {
            if constexpr (requires { receptor_.flush_decayed(state_); })
                if (step_ % flush_interval == 0 && step_ > 0) receptor_.flush_decayed(state_);
            Current<double> i[R::outputs];
            receptor_.step(state_, force[t], i);
            for (std::size_t k = 0; k < R::outputs; ++k) out[k][0][t] = i[k].from, out[k][1][t] = i[k].to, out[k][2][t] = i[k].sum();
        }
    }
};

/// The shared receptor of a plan.
std::unique_ptr<SharedReceptor> make_shared_receptor(const AfferentPlan& plan, const SimulationOptions& run) {
    std::unique_ptr<SharedReceptor> receptor;
    visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
        receptor = std::make_unique<ReceptorRun<R<double>>>(R<double>(ParameterValues<R<double>>(plan), run.dt, run.method));
    });
    return receptor;
}

template <class V>
std::unique_ptr<LanePopulation> make_tiled(const PopulationPlan& p, const SimulationOptions& run, const KernelTable<V>& table) {
    const auto& plan = *p.plans[0];
    // Every catalogue name has a kernel, because both come from the lists in models.hpp.
    PopulationLayout<V> layout{.receptor = find_by_name(table.receptors, plan.receptor),
                               .neuron = find_by_name(table.neurons, plan.neuron),
                               .lanes = table.lanes,
                               .size = p.size,
                               .forces = p.forces,
                               .afferent_numbers = {p.afferent_numbers.begin(), p.afferent_numbers.end()},
                               .name = fmt::format("{}+{}", plan.receptor, plan.neuron)};
    layout.receptors = models_of(*layout.receptor, table.lanes, p.plans, p.size, run);
    layout.neurons = models_of(*layout.neuron, table.lanes, p.plans, p.size, run);
    // `fused` has one kernel for each neuron of the table, in the same order.
    const auto& fused = layout.receptor->fused[static_cast<std::size_t>(layout.neuron - table.neurons.data())];
    if (p.forces == 1 && fused.run && fused.is_usable(layout.neurons.data(), layout.neurons.size() / layout.neuron->model_bytes))
        layout.fused = &fused;
    // A buffer of one model means that all afferents share their receptor's parameters.
    if (p.forces == 1 && layout.receptors.size() == layout.receptor->model_bytes) layout.shared_receptor = make_shared_receptor(plan, run);
    return std::make_unique<TiledPopulation<V>>(std::move(layout), run);
}

}  // namespace

bool can_use_lanes(const AfferentPlan& plan, const SimulationOptions& run) { return run.noise == 0 && plan.traits().can_use_lanes; }

Result<std::unique_ptr<LanePopulation>> make_lane_population(const PopulationPlan& p, const SimulationOptions& run, InstructionSet set) {
    if (p.size == 0 || p.plans.empty() || (p.plans.size() != 1 && p.plans.size() != p.size))
        return bad_input(fmt::format("a population of {} afferents with {} plans: give one plan, or one for each", p.size, p.plans.size()));
    if (p.forces == 0 || p.forces > max_forces)
        return bad_input(fmt::format("{} forces on each afferent: there must be 1 to {}", p.forces, max_forces));
    if (!p.afferent_numbers.empty() && p.afferent_numbers.size() != p.size)
        return bad_input(fmt::format("{} afferent numbers for {} afferents", p.afferent_numbers.size(), p.size));
    TRY(check_same_models(p.plans));
    for (const auto* plan : p.plans)
        if (!can_use_lanes(*plan, run))
            return bad_input(fmt::format("{}: netlists, sensors, converters and noise cannot run on SIMD lanes", plan->name));
    return p.precision == Precision::double_precision ? make_tiled(p, run, kernels_in_double(set))
                                                      : make_tiled(p, run, kernels_in_float(set));
}

}  // namespace corpuscle
