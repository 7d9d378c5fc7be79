#pragma once
// A circuit on its way through a force that comes block by block.

#include "circuit/afferent.hpp"
#include "circuit/analysis/beginning.hpp"
#include "circuit/cost/power.hpp"
#include "circuit/trace.hpp"

namespace corpuscle::circuit {

class Numbers;

/// Bound to its design and sample time. Its matrix's order of elimination is that of the circuit at 0 N, so that what it does depends on
/// the force alone and not on what was run on it before.
class Rig {
    const CircuitDesign& design_;
    std::unique_ptr<TestBench> bench_;
    Trace trace_;
    std::optional<Transient> transient_;
    std::optional<PowerMeter> meter_;
    std::optional<PowerMeter::Delivered> now_;  // at the last step's end, once it was looked at
    Spent spent_;
    bool clocked_ = false;         // some other source goes by the time since the beginning
    std::vector<double> rest_;     // at 0 N
    std::vector<double> start_;    // at the first force
    std::int64_t origin_ = 0;      // the sample at which the transient's time is 0
    std::optional<Spike> coming_;  // found, and beyond what has been answered

    Rig(const CircuitDesign& design, double T) : design_(design), trace_(T) {}
    void shift();
    void rest();
    Result<Beginning> resting(std::span<const double> force, std::vector<double> from);
    std::vector<double> led_to(double force);
    void spend(double from);

public:
    static Result<std::unique_ptr<Rig>> make(const CircuitDesign&, double T, const std::optional<Draw>& chip);
    Rig(const Rig&) = delete;
    /// Becomes another chip of the same design; its matrix's order of elimination stays.
    void draw(const Draw& chip);

    /// Anew, at rest under the first of these samples.
    Result<void> begin(std::span<const double> force);
    void hear(std::span<const double> force) { trace_.append(force); }
    /// One step; the spike in it, if there is one, is `coming`.
    Result<void> step();
    std::optional<Spike>& coming() { return coming_; }

    /// Whether it has come to this sample.
    bool at(std::int64_t sample) const { return transient_->time() >= place(sample); }
    /// At a sample in its last step, or at the beginning.
    double shown(const Saved&, std::int64_t sample) const;
    const TransientWork& work() const { return transient_->work(); }
    /// Since this was last asked.
    Spent spent() { return std::exchange(spent_, {}); }

    TestBench& bench() { return *bench_; }
    const Trace& trace() const { return trace_; }
    const Transient& transient() const { return *transient_; }
    const PowerMeter& meter() const { return *meter_; }

    void save(std::vector<double>& out);
    /// False: this cannot be what save() gave after so many samples.
    bool restore(std::span<const double> in, std::int64_t samples);

private:
    double place(std::int64_t sample) const { return static_cast<double>(sample - origin_) * trace_.T(); }
    void read(Numbers&, TransientState&);
};

}  // namespace corpuscle::circuit
