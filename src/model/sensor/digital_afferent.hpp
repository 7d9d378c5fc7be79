#pragma once
// An afferent behind an analog-to-digital converter. Everything after the converter is computed in fixed-point words, at the converter's
// rate.

#include "model/sensor/adc.hpp"
#include "model/sensor/conversion_times.hpp"
#include "model/sensor/fixed_chain.hpp"

namespace corpuscle {

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

}  // namespace corpuscle
