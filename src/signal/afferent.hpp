#pragma once
// The boundary everything stands on: an afferent answers a block of force with spikes. Virtual once a block.

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

/// An inner quantity that an afferent can show: a component of its current, its membrane.
struct Probe {
    std::string_view name, unit;
};

/// An inner quantity that stays between two values as long as the afferent does what it was designed for.
struct Range {
    std::string_view of, unit;  ///< "v(vf)", "V"
    double low, high;
    std::string_view meaning;  ///< of being outside; "" if nobody says
};

/// How often one was outside.
struct Outside {
    std::int64_t samples = 0, first = -1;  ///< first: the number of the first such sample; -1: none
};

/// "v(vf) was outside 100 mV to 600 mV for 120 ms of 1 s, first at 310 ms: the sensor's current is ..."; times in seconds.
std::string outside_sentence(const Range&, double outside, double of, double first);

/// All that an afferent carries from block to block. Copy it to try twice; pack it to resume elsewhere.
struct State {
    std::string format;          ///< what the values mean, with its version: "sa1b+lif-b/1"
    std::int64_t step = 0;       ///< samples answered so far
    std::vector<double> values;  ///< SI
};

std::vector<std::byte> pack(const State&);
Result<State> unpack(std::span<const std::byte>);

/// What a circuit took while it was at work.
struct Spent {
    double seconds = 0;
    double supplies = 0, sensor = 0;  ///< J that its sources delivered, and of that what its sensor's current took
    Spent& operator+=(const Spent& more) {
        seconds += more.seconds, supplies += more.supplies, sensor += more.sensor;
        return *this;
    }
};

/// Where an afferent puts its answer.
struct Answer {
    std::vector<Spike>& spikes;  ///< appended in time order; the unit is the caller's
    std::uint32_t unit = 0;
    /// If not empty: one array a probe, each as long as the block of force, to be filled.
    std::span<double* const> probes = {};
    std::span<Outside> outside = {};                       ///< if not empty: one a range, added to
    std::int64_t capped = 0;                               ///< steps whose spikes were more than the cap allows
    std::int64_t clipped = 0;                              ///< samples beyond what a sensor's electronics or a converter can tell
    std::int64_t overflowed = 0;                           ///< results too large for a digital afferent's words, kept at the largest
    std::int64_t steps = 0, rejected = 0, iterations = 0;  ///< of a circuit: in time, those taken again, and Newton's
    Spent spent = {};
};

/// Which of several channels that share their electronics: a converter takes them in turn.
struct Turn {
    std::uint32_t channel = 0, of = 1;
};

/// The place of the first number that is infinite or none; the size if there is none such.
std::size_t first_not_finite(std::span<const double>);

/// Refuses a state that is another afferent's, and a force that is not finite.
Result<void> check_block(std::string_view name, std::string_view format, std::size_t values, const State&, std::span<const double> force);

class Afferent {
public:
    Afferent() = default;
    Afferent(const Afferent&) = delete;
    Afferent& operator=(const Afferent&) = delete;
    virtual ~Afferent() = default;
    virtual std::span<const Probe> probes() const = 0;
    virtual std::span<const Range> ranges() const { return {}; }
    /// The state before the first sample. The first sample also sets the force that went before it.
    virtual State start(Turn = {}) const = 0;
    /// How many samples the answer is behind the force: a block answers that many samples before those it hands in, and so do its
    /// probes. Who wants to hear a force to its end hands in so many samples more.
    virtual std::int64_t delay() const { return 0; }
    /// Answers the next block (force in newtons, one sample a T). Blocks of any size give the same spikes.
    virtual Result<void> respond(std::span<const double> force, State&, Answer&) const = 0;
};

/// What afferents are made from that are no models of equations: a netlist.
class Design {
public:
    Design() = default;
    Design(const Design&) = delete;
    Design& operator=(const Design&) = delete;
    virtual ~Design() = default;
    virtual std::string_view kind() const = 0;   ///< "netlist"
    virtual std::string_view title() const = 0;  ///< what it says of itself
    /// What is set of it and is no number: {"corner", "ss"}.
    virtual std::vector<std::pair<std::string, std::string>> words() const { return {}; }
    /// For samples dt apart, s; sampled: spikes come on the samples; copy: its number among copies that may differ, from 1, or 0.
    virtual std::unique_ptr<Afferent> make(double dt, bool sampled, std::uint32_t copy) const = 0;
};

}  // namespace corpuscle
