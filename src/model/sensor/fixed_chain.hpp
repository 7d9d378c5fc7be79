#pragma once
// A receptor and its neurons in fixed-point words: the algorithms behind an analog-to-digital converter. The state and the recordable
// values are arrays of words.

#include <array>
#include <cstring>
#include <memory>
#include <span>

#include "model/sensor/fixed_neuron.hpp"
#include "model/sensor/fixed_receptor.hpp"

namespace corpuscle {

/// A chain whose types of receptor and neuron are known only to FixedModelChain.
class FixedChain {
public:
    /// Result of one step.
    struct StepResult {
        std::array<bool, 2> fired = {};  ///< for each neuron, of which there are at most two: true if it fired
        int truncated_neurons = 0;       ///< number of neurons that are above their threshold after their one spike
    };
    static constexpr std::size_t max_words = 12, max_recordables = 6;  ///< enough for the state and the recordables of every pair of models

    FixedChain(Constants constants) : constants_(std::move(constants)) {}
    virtual ~FixedChain() = default;
    const Constants& constants() const { return constants_; }
    /// Name and unit of each word that is recorded after a step: "I" or "I_+", "I_-", then the recordables of each neuron.
    const std::vector<std::pair<std::string, std::string_view>>& recordables() const { return recordables_; }
    virtual int outputs() const = 0;        ///< number of currents, each into a neuron of its own
    virtual std::size_t words() const = 0;  ///< number of words of the state
    /// Sets the state before the first step. F is the force of the first step; the force before it is assumed to be the same.
    virtual void start(Word F, std::span<Word> state) const = 0;
    /// One step with force F. Writes the recordable words to `shown`.
    virtual StepResult step(std::span<Word> state, Word F, std::span<Word> shown, Arithmetic&) const = 0;

protected:
    Constants constants_;
    std::vector<std::pair<std::string, std::string_view>> recordables_;  // name, unit
};

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
    FixedModelChain(const typename R::Traits::Params& r, const typename N::Traits::Params& n, double f_s, WordFormat format)
        : FixedChain(Constants(format)), receptor_(r, f_s, constants_), neuron_(n, f_s, constants_) {
        const auto sign = [](int k) -> std::string {
            if constexpr (requires { R::Traits::signs; }) return "_" + std::string(R::Traits::signs[k]);
            return k == 0 ? "" : std::to_string(k);
        };
        for (int k = 0; k < outputs_; ++k) recordables_.push_back({"I" + sign(k), "A"});
        for (int k = 0; k < outputs_; ++k)
            for (const auto& p : N::recordables) recordables_.push_back({std::string(p.name) + sign(k), p.unit});
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

}  // namespace corpuscle
