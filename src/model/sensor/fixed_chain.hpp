#pragma once
// A receptor and its neurons in fixed-point words: the algorithms behind an analog-to-digital converter. The state and the recordable
// values are arrays of words.

#include <array>
#include <memory>
#include <span>

#include "model/sensor/fixed_point.hpp"

namespace corpuscle {

/// A chain whose types of receptor and neuron are known only to front_end_factory.cpp.
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

}  // namespace corpuscle
