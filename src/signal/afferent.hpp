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

/// All that an afferent carries from block to block. Copy it to try twice; pack it to resume elsewhere.
struct State {
    std::string format;          ///< what the values mean, with its version: "sa1b+lif-b/1"
    std::int64_t step = 0;       ///< samples answered so far
    std::vector<double> values;  ///< SI
};

std::vector<std::byte> pack(const State&);
Result<State> unpack(std::span<const std::byte>);

/// Where an afferent puts its answer.
struct Answer {
    std::vector<Spike>& spikes;  ///< appended in time order; the unit is the caller's
    std::uint32_t unit = 0;
    /// If not empty: one array a probe, each as long as the block of force, to be filled.
    std::span<double* const> probes = {};
    std::int64_t capped = 0;                               ///< steps whose spikes were more than the cap allows
    std::int64_t clipped = 0;                              ///< samples beyond what a sensor's electronics or a converter can tell
    std::int64_t overflowed = 0;                           ///< results too large for a digital afferent's words, kept at the largest
    std::int64_t steps = 0, rejected = 0, iterations = 0;  ///< of a circuit: in time, those taken again, and Newton's
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
