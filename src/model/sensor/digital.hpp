#pragma once
// An afferent behind a converter: everything after it happens in words, at the converter's own rate.

#include "model/sensor/adc.hpp"
#include "model/sensor/fixed_chain.hpp"
#include "model/sensor/instants.hpp"

namespace corpuscle {

/// Between two samples of the source the force is a straight line; the converter takes it at its own instants, and spikes come there.
class Digital final : public Afferent {
public:
    /// One conversion, and what came of it.
    struct Conversion {
        std::int64_t code;
        Word force;
        std::span<const Word> shown;  ///< in the order of chain().shown()
        std::span<const bool> fired;  ///< a bit for each neuron
    };
    using Seen = std::function<void(const Conversion&)>;

    Digital(std::string name, Converter, std::unique_ptr<const FixedChain>, double f_s, bool shared, double dt);
    const FixedChain& chain() const { return *chain_; }
    /// The table from codes to words of force.
    const std::vector<Word>& rom() const { return rom_; }

    std::span<const Probe> probes() const override { return probes_; }
    State start(Turn) const override;
    Result<void> respond(std::span<const double> force, State&, Answer&) const override;
    /// The same, telling each conversion.
    Result<void> convert(std::span<const double> force, State&, Answer&, const Seen&) const;

private:
    struct Held;  // a State, as numbers of their kind
    Instants instants_of(std::uint32_t turns) const;
    std::optional<Held> held_of(const State&) const;
    void keep(const Held&, State&) const;
    void one(Held&, double felt, Spike at, Answer&, const Seen&) const;
    void show(const Held&, double felt, std::size_t k, Answer&) const;

    std::string name_, format_;
    Converter converter_;
    std::unique_ptr<const FixedChain> chain_;
    double source_rate_, f_s_;
    bool shared_;
    std::vector<Word> rom_;
    std::vector<Probe> probes_;
};

}  // namespace corpuscle
