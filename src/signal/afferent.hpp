#pragma once
// The interface of an afferent: it responds to a block of force with spikes. One virtual call per block.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signal/error.hpp"
#include "signal/spike.hpp"

namespace corpuscle {

/// A recordable quantity of an afferent, such as its membrane potential or a component of its current.
struct Probe {
    std::string_view name, unit;
};

/// The interval in which a recordable quantity stays while the afferent works as designed.
struct ValidRange {
    std::string_view quantity, unit;  ///< the quantity and its unit: "v(vf)", "V"
    double low, high;
    std::string_view meaning;  ///< what a violation means; "" if it is not documented
};

/// Counts the samples at which a quantity was outside its valid range.
struct RangeViolation {
    std::int64_t samples = 0, first_sample = -1;  ///< first_sample: the index of the first such sample, or -1
};

/// A message such as "v(vf) was outside 100 mV to 600 mV for 120 ms of 1 s, first at 310 ms: ...". `outside` is the time spent outside
/// the range, `total` the simulated time and `first` the time of the first violation, all in s.
std::string range_violation_message(const ValidRange&, double outside, double total, double first);

/// The state of an afferent between two blocks. Copy it to simulate twice from the same point; pack() it to resume in another process.
struct State {
    std::string format;          ///< identifies the meaning of the values and its version: "sa1b+lif-b/1"
    std::int64_t step = 0;       ///< number of samples simulated so far
    std::vector<double> values;  ///< in SI units
};

/// The state as bytes, with a checksum.
std::vector<std::byte> pack(const State&);
/// Reads the bytes of pack(). Damaged bytes and unknown versions are errors.
Result<State> unpack(std::span<const std::byte>);

/// Energy that a circuit used during a simulation.
struct EnergyUse {
    double seconds = 0;               ///< simulated time
    double supplies = 0, sensor = 0;  ///< J: delivered by all sources, and the part of it drawn by the sensor's current
    EnergyUse& operator+=(const EnergyUse& more) {
        seconds += more.seconds, supplies += more.supplies, sensor += more.sensor;
        return *this;
    }
};

/// The output of one call of Afferent::respond(): the caller's arrays to fill, and counters that are added to.
struct ResponseBlock {
    std::vector<Spike>& spikes;  ///< spikes are appended in time order, with the caller's afferent index
    std::uint32_t afferent_index = 0;
    /// If not empty: one array for each probe, as long as the block of force, to be filled.
    std::span<double* const> probes = {};
    std::span<RangeViolation> range_violations = {};                    ///< if not empty: one counter for each range
    std::int64_t truncated_steps = 0;                                   ///< steps that reached the limit of spikes per step
    std::int64_t saturated = 0;                                         ///< samples beyond the range of a sensor's electronics or converter
    std::int64_t overflowed = 0;                                        ///< fixed-point results of a digital afferent that were saturated
    std::int64_t steps = 0, rejected_steps = 0, newton_iterations = 0;  ///< of a circuit: time steps, rejected steps, Newton iterations
    EnergyUse energy_use = {};
};

/// The position of a channel among several that share one converter, which samples them in turn.
struct ChannelSlot {
    std::uint32_t channel = 0, channel_count = 1;
};

/// The index of the first value that is infinite or NaN; the size if all are finite.
std::size_t first_non_finite(std::span<const double>);

/// Returns an error if the state belongs to another afferent (another format or number of values), or if a force is not finite.
Result<void> check_block(std::string_view name, std::string_view format, std::size_t values, const State&, std::span<const double> force);

class Afferent {
public:
    Afferent() = default;
    Afferent(const Afferent&) = delete;
    Afferent& operator=(const Afferent&) = delete;
    virtual ~Afferent() = default;
    virtual std::span<const Probe> probes() const = 0;
    virtual std::span<const ValidRange> ranges() const { return {}; }
    /// The state before the first sample. The force before the first sample is assumed to equal the first sample.
    virtual State start(ChannelSlot = {}) const = 0;
    /// Latency in samples: the spikes and probes of a block belong to the force that many samples earlier.
    /// To get the complete response, append delay() samples of force.
    virtual std::int64_t delay() const { return 0; }
    /// Simulates the next block (force in newtons, one sample per T). The spikes do not depend on the block size.
    virtual Result<void> respond(std::span<const double> force, State&, ResponseBlock&) const = 0;
};

/// Creates afferents that are not built-in models, for example from a netlist.
class AfferentFactory {
public:
    AfferentFactory() = default;
    AfferentFactory(const AfferentFactory&) = delete;
    AfferentFactory& operator=(const AfferentFactory&) = delete;
    virtual ~AfferentFactory() = default;
    virtual std::string_view kind() const = 0;   ///< "netlist"
    virtual std::string_view title() const = 0;  ///< the title line of the netlist
    /// Settings that are not numbers, e.g. {"corner", "ss"}.
    virtual std::vector<std::pair<std::string, std::string>> labels() const { return {}; }
    /// Creates an afferent for a sample period of `dt` s. If `sampled`, spikes occur only at sample times. `copy` selects one of
    /// several copies that may differ, counted from 1; 0 is the nominal one.
    virtual std::unique_ptr<Afferent> make(double dt, bool sampled, std::uint32_t copy) const = 0;
};

}  // namespace corpuscle
