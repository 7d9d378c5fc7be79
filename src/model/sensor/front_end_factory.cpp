// Builds the front end of a plan and, if it has a converter, the complete digital afferent.

#include <cstring>

#include "model/chain.hpp"
#include "model/components.hpp"
#include "model/sensor/digital_afferent.hpp"
#include "model/sensor/fixed_models.hpp"

namespace corpuscle {
namespace {

template <class R, class N>
class FixedModelChain final : public FixedChain {
    static constexpr int outputs_ = R::Traits::outputs;
    struct State {
        typename R::State receptor;
        typename N::State neuron[outputs_];
    };
    static constexpr std::size_t words_ = sizeof(State) / sizeof(Word);
    static_assert(std::is_trivially_copyable_v<State> && words_ <= max_words &&
                  outputs_ * (1 + std::size(N::recordables)) <= max_recordables);

    R receptor_;
    N neuron_;

public:
    FixedModelChain(const ParameterValues<typename R::Traits>& r, const ParameterValues<typename N::Traits>& n, double f_s,
                    WordFormat format)
        : FixedChain(format), receptor_(r, f_s, constants), neuron_(n, f_s, constants) {
        for (int k = 0; k < outputs_; ++k) recordables.push_back({"I" + sign_suffix<typename R::Traits>(k), "A"});
        for (int k = 0; k < outputs_; ++k)
            for (const auto& p : N::recordables) recordables.push_back({std::string(p.name) + sign_suffix<typename R::Traits>(k), p.unit});
    }

    int outputs() const override { return outputs_; }
    std::size_t words() const override { return words_; }

    void start(Word F, std::span<Word> state) const override {
        State s{};
        s.receptor.F = F;
        for (auto& n : s.neuron) n = neuron_.start();
        std::memcpy(state.data(), &s, sizeof s);
    }

    StepResult step(std::span<Word> state, Word F, std::span<Word> shown, Arithmetic& a) const override {
        State s;
        std::memcpy(&s, state.data(), sizeof s);
        Word I[outputs_];
        receptor_.step(s.receptor, F, I, a);
        StepResult out;
        for (int k = 0; k < outputs_; ++k) {
            const auto fired = neuron_.step(s.neuron[k], I[k], a);
            out.fired[static_cast<std::size_t>(k)] = fired.spike;
            out.truncated_neurons += fired.truncated;
            shown[static_cast<std::size_t>(k)] = I[k];
            neuron_.record(s.neuron[k],
                           &shown[static_cast<std::size_t>(outputs_) + static_cast<std::size_t>(k) * std::size(N::recordables)]);
        }
        std::memcpy(state.data(), &s, sizeof s);
        return out;
    }
};

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

}  // namespace

FrontEnd make_front_end(const AfferentPlan& plan) {
    std::vector<FrontEndStage> stages;
    const auto add = [&](std::string_view name) {
        return [&, name]<class M>(ComponentTag<M>) {
            if (M::name == name) stages.push_back(M::stage(ParameterValues<M>(plan)));
        };
    };
    for_each_type(Sensors{}, add(plan.sensor)), for_each_type(Transducers{}, add(plan.transducer));
    return FrontEnd(std::move(stages), plan.value("F_cal").value_or(1));  // without a sensor there is no F_cal, and it is not used
}

Result<std::unique_ptr<const FixedChain>> make_fixed_chain(const AfferentPlan& plan) {
    const ParameterValues<Adc> adc(plan);
    const WordFormat format{static_cast<int>(adc("word")), static_cast<int>(adc("frac"))};
    std::unique_ptr<const FixedChain> chain;
    with_fixed(FixedReceptors{}, plan.receptor, [&]<class R>(ComponentTag<R>) {
        with_fixed(FixedNeurons{}, plan.neuron, [&]<class N>(ComponentTag<N>) {
            chain = std::make_unique<FixedModelChain<R, N>>(ParameterValues<typename R::Traits>(plan),
                                                            ParameterValues<typename N::Traits>(plan), adc("f_s"), format);
        });
    });
    if (!chain)
        return bad_input(fmt::format("{}: {}+{} has no fixed-point version; adc can be followed by {} with {}", plan.name, plan.receptor,
                                     plan.neuron, names_in(FixedReceptors{}), names_in(FixedNeurons{})));
    const Converter converter(make_front_end(plan), adc);
    Constants constants = chain->constants;  // a copy, to check that the forces of the lowest and the highest code fit a word, too
    for (const auto code : {std::int64_t{0}, converter.max_code()}) (void)constants.level("the force of a code", converter.force(code));
    if (const auto& misfit = constants.error()) return bad_input(plan.name + ": " + misfit->message);
    return chain;
}

std::unique_ptr<DigitalAfferent> make_digital(const AfferentPlan& plan, const SimulationOptions& run) {
    const ParameterValues<Adc> adc(plan);
    // make_fixed_chain() cannot fail here, because check_plan() has called it.
    return std::make_unique<DigitalAfferent>(plan.composition(), Converter(make_front_end(plan), adc), std::move(*make_fixed_chain(plan)),
                                             adc("f_s"), adc("shared") != 0, run.dt);
}

}  // namespace corpuscle
