#pragma once
// An afferent behind a converter. Everything after the converter is computed in words, at the converter's own rate.

#include "model/sensor/adc.hpp"
#include "model/sensor/fixed_chain.hpp"
#include "model/sensor/instants.hpp"

namespace corpuscle {

/// Between two samples of the source the force is a straight line. The converter samples it at its own times, and spikes occur there.
class Digital final : public Afferent {
public:
    /// One conversion and its result.
    struct Conversion {
        std::int64_t code;
        Word force;
        std::span<const Word> shown;  ///< in the order of chain().recordables()
        std::span<const bool> fired;  ///< a bit for each neuron: true if it fired
    };
    using Seen = std::function<void(const Conversion&)>;

    Digital(std::string name, Converter, std::unique_ptr<const FixedChain>, double f_s, bool shared, double dt);
    const FixedChain& chain() const { return *chain_; }
    /// The table from codes to words of force.
    const std::vector<Word>& rom() const { return rom_; }

    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override;
    Result<void> respond(std::span<const double> force, State&, ResponseBlock&) const override;
    /// The same as respond(), with a call for each conversion.
    Result<void> convert(std::span<const double> force, State&, ResponseBlock&, const Seen&) const;

private:
    struct Held;  // the values of a State, as numbers of their types
    Instants instants_of(std::uint32_t channels) const;
    std::optional<Held> held_of(const State&) const;
    void keep(const Held&, State&) const;
    void one(Held&, double sensed, Spike at, ResponseBlock&, const Seen&) const;
    void show(const Held&, double sensed, std::size_t k, ResponseBlock&) const;

    std::string name_, format_;
    Converter converter_;
    std::unique_ptr<const FixedChain> chain_;
    double source_rate_, f_s_;
    bool shared_;
    std::vector<Word> rom_;
    std::vector<Probe> probes_;
};

}  // namespace corpuscle
