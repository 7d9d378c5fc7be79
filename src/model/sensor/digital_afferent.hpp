#pragma once
// An afferent behind an analog-to-digital converter. Everything after the converter is computed in fixed-point words, at the converter's
// rate.

#include <array>

#include "core/clock.hpp"
#include "model/sensor/adc.hpp"
#include "model/sensor/fixed_point.hpp"

namespace corpuscle {

/// The times of a converter's conversions, as positions between the samples of its input (the source), which has another rate. They are
/// computed with integers, so that no error accumulates. Let A / B be the number of source samples per conversion, a fraction of integers.
/// Conversion j (from 0) of channel c (from 0) of N takes place (j + c/N) A / B samples after source sample 0.
class ConversionTimes {
    std::int64_t quotient_, remainder_, denominator_, channels_;  // floor(A / B), A mod B, B, N

public:
    /// A position among the source samples: `remainder` / (B N) of the way from sample `step` to the next one.
    struct SamplePosition {
        std::int64_t step = 0, remainder = 0;
        bool is_after(std::int64_t sample) const { return step > sample || (step == sample && remainder > 0); }
    };

    /// source_rate: samples per second; f_s: conversions per second. Their ratio is replaced by the simplest fraction that differs from it
    /// by at most 1e-12 of its value.
    ConversionTimes(double source_rate, double f_s, std::uint32_t channels) : channels_(channels) {
        const double ratio = source_rate / f_s, at_least_one = ratio >= 1 ? ratio : 1 / ratio;
        const auto fraction = make_clock(at_least_one);  // fails above 1e12, where the integer part is accurate enough
        const std::int64_t numerator = fraction ? fraction->rate_numerator : static_cast<std::int64_t>(at_least_one),
                           denominator = fraction ? fraction->rate_denominator : 1;
        const std::int64_t a = ratio >= 1 ? numerator : denominator, b = ratio >= 1 ? denominator : numerator;
        quotient_ = a / b, remainder_ = a % b, denominator_ = b;
    }

    /// The number of parts into which remainders divide an interval between samples: B N.
    std::int64_t parts_per_sample() const { return denominator_ * channels_; }
    /// The position of conversion 0 of a channel.
    SamplePosition first(std::uint32_t channel) const {
        const std::int64_t c = channel, c_quotient = c * quotient_;
        const std::int64_t rest = c * remainder_ + (c_quotient % channels_) * denominator_;  // in parts of 1 / (B N)
        return {c_quotient / channels_ + rest / parts_per_sample(), rest % parts_per_sample()};
    }
    /// Moves to the position of the same channel's next conversion.
    void advance(SamplePosition& p) const {
        p.step += quotient_, p.remainder += remainder_ * channels_;
        if (p.remainder >= parts_per_sample()) p.remainder -= parts_per_sample(), ++p.step;
    }
};

/// A receptor and its neurons in fixed-point words: the algorithms behind a converter. The state and the recordable values are arrays of
/// words. The types of receptor and neuron are known only to front_end_factory.cpp.
class FixedChain {
public:
    /// Result of one step.
    struct StepResult {
        std::array<bool, 2> fired = {};  ///< for each neuron, of which there are at most two: true if it fired
        int truncated_neurons = 0;       ///< number of neurons that are above their threshold after their one spike
    };
    static constexpr std::size_t max_words = 12, max_recordables = 6;  ///< enough for the state and the recordables of every pair of models

    Constants constants;
    /// Name and unit of each word that is recorded after a step: "I" or "I_+", "I_-", then the recordables of each neuron.
    std::vector<std::pair<std::string, std::string_view>> recordables = {};

    FixedChain(WordFormat format) : constants(format) {}
    virtual ~FixedChain() = default;
    virtual int outputs() const = 0;        ///< number of currents, each into a neuron of its own
    virtual std::size_t words() const = 0;  ///< number of words of the state
    /// Sets the state before the first step. F is the force of the first step; the force before it is assumed to be the same.
    virtual void start(Word F, std::span<Word> state) const = 0;
    /// One step with force F. Writes the recordable words to `shown`.
    virtual StepResult step(std::span<Word> state, Word F, std::span<Word> shown, Arithmetic&) const = 0;
};

/// Between two samples of the force (the source), the force is a straight line. The converter samples this line at its own times; spikes
/// occur only at these times.
class DigitalAfferent final : public Afferent {
public:
    /// One conversion, and the result of the step of the algorithms that follows it.
    struct Conversion {
        std::int64_t code;
        Word force;                      ///< the force that the code represents
        std::span<const Word> recorded;  ///< values after the step, in the order of chain().recordables()
        std::span<const bool> fired;     ///< for each neuron: true if it fired in the step
    };
    using ConversionCallback = std::function<void(const Conversion&)>;

    /// f_s: conversions per second; shared: true if one converter samples all channels in turn; dt: s, interval between samples of the
    /// force.
    DigitalAfferent(std::string name, Converter, std::unique_ptr<const FixedChain>, double f_s, bool shared, double dt);
    const FixedChain& chain() const { return *chain_; }
    /// The table of the force of each code, as a word.
    const std::vector<Word>& rom() const { return rom_; }

    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override;
    Result<void> respond(std::span<const double> force, State&, ResponseBlock&) const override;
    /// The same as respond(), but also calls the callback after each conversion.
    Result<void> respond_and_report(std::span<const double> force, State&, ResponseBlock&, const ConversionCallback&) const;

private:
    struct TypedState;  // a State with its values converted to their types
    ConversionTimes conversion_times(std::uint32_t channels) const;
    std::optional<TypedState> unpack_state(const State&) const;
    void pack_state(const TypedState&, State&) const;
    void convert_once(TypedState&, double sensed, Spike at, ResponseBlock&, const ConversionCallback&) const;
    void record(const TypedState&, double sensed, std::size_t k, ResponseBlock&) const;

    std::string name_, format_;
    Converter converter_;
    std::unique_ptr<const FixedChain> chain_;
    double source_rate_, f_s_;  // samples of the force per second; conversions per second
    bool shared_;
    std::vector<Word> rom_;
    std::vector<Probe> probes_;
};

/// The fixed-point algorithms behind a plan's converter. Models without a fixed-point version are an error, and so are constants that do
/// not fit a word.
Result<std::unique_ptr<const FixedChain>> make_fixed_chain(const AfferentPlan&);

/// The afferent of a plan with a converter. The plan must have passed check_plan().
std::unique_ptr<DigitalAfferent> make_digital(const AfferentPlan&, const SimulationOptions&);

}  // namespace corpuscle
