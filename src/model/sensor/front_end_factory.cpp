#include "model/sensor/front_end_factory.hpp"

#include "model/components.hpp"

namespace corpuscle {
namespace {

using FixedReceptors = ComponentList<FixedSa1a, FixedSa1b, FixedFa1a, FixedFa1b>;
using FixedNeurons = ComponentList<FixedLifA, FixedLifB, FixedAdaptive>;

/// Calls f with the fixed-point version of the model with this name; does nothing if there is none.
template <class List, class F>
void with_fixed(List list, std::string_view name, const F& f) {
    for_each_type(list, [&]<class M>(ComponentTag<M> m) {
        if (M::Traits::name == name) f(m);
    });
}

template <class List>
std::string names_in(List list) {
    std::string names;
    for_each_type(list, [&]<class M>(ComponentTag<M>) { names += (names.empty() ? "" : ", ") + std::string(M::Traits::name); });
    return names;
}

Adc::Params adc_of(const AfferentPlan& plan) { return with_settings<Adc::Params>(Adc::fields, settings_of(plan)); }

}  // namespace

FrontEnd make_front_end(const AfferentPlan& plan) {
    const auto settings = settings_of(plan);
    std::vector<FrontEndStage> stages;
    const auto add = [&](std::string_view name) {
        return [&, name]<class M>(ComponentTag<M>) {
            if (M::name == name) stages.push_back(M::stage(with_settings<typename M::Params>(M::fields, settings)));
        };
    };
    for_each_type(Sensors{}, add(plan.sensor)), for_each_type(Transducers{}, add(plan.transducer));
    return FrontEnd(std::move(stages), plan.value("F_cal").value_or(1));  // without a sensor there is no F_cal, and it is not used
}

Result<std::unique_ptr<const FixedChain>> make_fixed_chain(const AfferentPlan& plan) {
    const auto settings = settings_of(plan);
    const auto adc = adc_of(plan);
    const WordFormat format{static_cast<int>(adc.word), static_cast<int>(adc.frac)};
    std::unique_ptr<const FixedChain> chain;
    with_fixed(FixedReceptors{}, plan.receptor, [&]<class R>(ComponentTag<R>) {
        with_fixed(FixedNeurons{}, plan.neuron, [&]<class N>(ComponentTag<N>) {
            const auto r = with_settings<typename R::Traits::Params>(R::Traits::fields, settings);
            const auto n = with_settings<typename N::Traits::Params>(N::Traits::fields, settings);
            chain = std::make_unique<FixedModelChain<R, N>>(r, n, adc.f_s, format);
        });
    });
    if (!chain)
        return bad_input(fmt::format("{}: {}+{} has no fixed-point version; adc can be followed by {} with {}", plan.name, plan.receptor,
                                     plan.neuron, names_in(FixedReceptors{}), names_in(FixedNeurons{})));
    const Converter converter(make_front_end(plan), adc);
    Constants constants = chain->constants();  // a copy, to check that the forces of the lowest and the highest code fit a word, too
    for (const auto code : {std::int64_t{0}, converter.max_code()}) (void)constants.level("the force of a code", converter.force(code));
    if (const auto& misfit = constants.error()) return bad_input(plan.name + ": " + misfit->message);
    return chain;
}

std::unique_ptr<DigitalAfferent> make_digital(const AfferentPlan& plan, const SimulationOptions& run) {
    const auto adc = adc_of(plan);
    // make_fixed_chain() cannot fail here, because check_plan() has called it.
    return std::make_unique<DigitalAfferent>(plan.composition(), Converter(make_front_end(plan), adc), std::move(*make_fixed_chain(plan)),
                                             adc.f_s, adc.shared != 0, run.dt);
}

}  // namespace corpuscle
