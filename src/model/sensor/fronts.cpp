#include "model/sensor/fronts.hpp"

namespace corpuscle {
namespace {

using FixedReceptors = PartList<FixedSa1a, FixedSa1b, FixedFa1a, FixedFa1b>;
using FixedNeurons = PartList<FixedLifA, FixedLifB, FixedAdaptive>;

template <class List, class F>
void with_fixed(List list, std::string_view name, const F& f) {
    each(list, [&]<class M>(Part<M> m) {
        if (M::Facts::name == name) f(m);
    });
}

template <class List>
std::string names_in(List list) {
    std::string names;
    each(list, [&]<class M>(Part<M>) { names += (names.empty() ? "" : ", ") + std::string(M::Facts::name); });
    return names;
}

Adc::Params adc_of(const AfferentPlan& plan) { return with_settings<Adc::Params>(Adc::fields, settings_of(plan)); }

}  // namespace

Front front_of(const AfferentPlan& plan) {
    const auto settings = settings_of(plan);
    std::vector<Stage> stages;
    const auto add = [&](std::string_view name) {
        return [&, name]<class M>(Part<M>) {
            if (M::name == name) stages.push_back(M::stage(with_settings<typename M::Params>(M::fields, settings)));
        };
    };
    each(Sensors{}, add(plan.sensor)), each(Transducers{}, add(plan.transducer));
    return Front(std::move(stages), plan.value("F_cal").value_or(1));
}

Result<std::unique_ptr<const FixedChain>> fixed_chain_of(const AfferentPlan& plan) {
    const auto settings = settings_of(plan);
    const auto adc = adc_of(plan);
    const WordFormat format{static_cast<int>(adc.word), static_cast<int>(adc.frac)};
    std::unique_ptr<const FixedChain> chain;
    with_fixed(FixedReceptors{}, plan.receptor, [&]<class R>(Part<R>) {
        with_fixed(FixedNeurons{}, plan.neuron, [&]<class N>(Part<N>) {
            const auto r = with_settings<typename R::Facts::Params>(R::Facts::fields, settings);
            const auto n = with_settings<typename N::Facts::Params>(N::Facts::fields, settings);
            chain = std::make_unique<FixedChainOf<R, N>>(r, n, adc.f_s, format);
        });
    });
    if (!chain)
        return bad_input(fmt::format("{}: {}+{} has no fixed-point version; adc can be followed by {} with {}", plan.name, plan.receptor,
                                     plan.neuron, names_in(FixedReceptors{}), names_in(FixedNeurons{})));
    const Converter converter(front_of(plan), adc);
    Constants constants = chain->constants();  // the force at both ends must fit as well
    for (const auto code : {std::int64_t{0}, converter.most()}) (void)constants.level("the force of a code", converter.force(code));
    if (const auto& misfit = constants.misfit()) return bad_input(plan.name + ": " + misfit->message);
    return chain;
}

std::unique_ptr<Digital> make_digital(const AfferentPlan& plan, const Run& run) {
    const auto adc = adc_of(plan);
    return std::make_unique<Digital>(plan.made_of(), Converter(front_of(plan), adc), std::move(*fixed_chain_of(plan)), adc.f_s,
                                     adc.shared != 0, run.dt);
}

}  // namespace corpuscle
