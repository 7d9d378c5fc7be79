#pragma once
// The interface of an afferent: it responds to a block of force with spikes. One virtual call per block.

#include <cstddef>
#include <functional>
#include <string_view>

#include "core/operating_state.hpp"
#include "core/spike.hpp"

namespace corpuscle {

/// Name and unit of a quantity of an afferent that can be recorded, such as its membrane potential or a component of its current.
struct Probe {
    std::string_view name, unit;
};

/// The interval in which a quantity stays while the afferent works as designed.
struct ValidRange {
    std::string_view quantity, unit;  ///< the quantity and its unit: "v(vf)", "V"
    double low, high;                 ///< ends of the interval, in `unit`
    std::string_view meaning;         ///< what a violation means; "" if it is not documented
};

/// Counts the samples at which a quantity was outside its valid range.
struct RangeViolation {
    std::int64_t samples = 0;        ///< number of such samples
    std::int64_t first_sample = -1;  ///< index of the first such sample, counted from the start of the simulation; -1: no violation yet
};

/// A message such as "v(vf) was outside 100 mV to 600 mV for 120 ms of 1 s, first at 310 ms: ...". `outside` is the time spent outside the
/// range, `total` the simulated time and `first` the time from the start of the simulation to the first violation, all in s.
std::string range_violation_message(const ValidRange&, double outside, double total, double first);

/// The state of an afferent between two blocks. Copy it to simulate twice from the same point; pack() it to resume in another process.
struct State {
    std::string format;          ///< the afferent and the version of the meaning of its values: "sa1b+lif-b/2, T = 0.0001 s"
    std::int64_t step = 0;       ///< number of samples simulated so far
    std::vector<double> values;  ///< in SI units; the format defines their meaning
};

/// The state as bytes, with a checksum.
std::vector<std::byte> pack(const State&);
/// Reads the bytes of pack(). Damaged bytes and unknown versions are errors.
Result<State> unpack(std::span<const std::byte>);

/// Energy that a circuit used during a simulation.
struct EnergyUse {
    double seconds = 0;   ///< simulated time, s
    double supplies = 0;  ///< J, delivered by all sources
    double sensor = 0;    ///< J, the part of `supplies` that the sensor's current draws
    EnergyUse& operator+=(const EnergyUse& more) {
        seconds += more.seconds, supplies += more.supplies, sensor += more.sensor;
        return *this;
    }
};

/// The output of one call of Afferent::respond(). respond() fills the caller's arrays, and adds to the counters.
struct ResponseBlock {
    std::vector<Spike>& spikes;        ///< spikes are appended in order of time
    std::uint32_t afferent_index = 0;  ///< chosen by the caller; copied into each spike
    /// If not empty: for each of Afferent::probes(), an array as long as the block of force, which receives a value for each sample.
    std::span<double* const> probes = {};
    std::span<RangeViolation> range_violations = {};  ///< if not empty: one counter for each of Afferent::ranges()
    std::int64_t truncated_steps = 0;                 ///< steps that reached the limit of spikes per step
    std::int64_t saturated = 0;                       ///< samples at which a transducer or converter reached the end of its range
    std::int64_t overflowed = 0;                      ///< fixed-point results that did not fit their word and were limited
    std::int64_t steps = 0, rejected_steps = 0, newton_iterations = 0;  ///< of circuits: accepted and rejected time steps, iterations
    EnergyUse energy_use = {};
    /// If not empty: called again and again while a block takes long, as that of a circuit can. If it returns true, respond() ends with an
    /// error of code `interrupted`, and the state cannot be used any more. Afferents of equations do not call it.
    std::function<bool()> should_stop = {};
};

/// The position of a channel among several that share one analog-to-digital converter, which samples them in turn.
struct ChannelSlot {
    std::uint32_t channel = 0;        ///< in the converter's order, counted from 0
    std::uint32_t channel_count = 1;  ///< channels that share the converter
};

/// The index of the first value that is infinite or NaN; the number of values if all are finite.
std::size_t first_non_finite(std::span<const double>);

/// Checks the arguments of Afferent::respond(). Returns an error if the state does not have the afferent's `format` and its number of
/// `values`, or if a force is not finite. `name` is the afferent's name for messages.
Result<void> check_block(std::string_view name, std::string_view format, std::size_t values, const State&, std::span<const double> force);

/// One afferent. It does not change during a simulation: the caller stores the State, so that one object can simulate several channels.
class Afferent {
public:
    Afferent() = default;
    Afferent(const Afferent&) = delete;
    Afferent& operator=(const Afferent&) = delete;
    virtual ~Afferent() = default;
    virtual std::span<const Probe> probes() const = 0;  ///< the quantities that can be recorded
    /// The ranges in which the afferent works as designed; empty if none are known.
    virtual std::span<const ValidRange> ranges() const { return {}; }
    /// The state before the first sample. The force before that sample is assumed to be constant and equal to it.
    virtual State start(ChannelSlot = {}) const = 0;
    /// Latency of the computation in samples: the spikes and probes at sample k are the response to the force at sample k - delay(). To get
    /// the complete response, append delay() samples of force.
    virtual std::int64_t delay() const { return 0; }
    /// Simulates the next block (force in newtons, one value for each sample). The spikes do not depend on the length of the blocks.
    virtual Result<void> respond(std::span<const double> force, State&, ResponseBlock&) const = 0;
    /// Voltages and power in this state; without blocks if the afferent is not a circuit, or has not started.
    virtual Result<OperatingState> operating_state(const State&) const { return OperatingState{}; }
};

}  // namespace corpuscle
