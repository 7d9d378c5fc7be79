#pragma once
// A sweep: one circuit, or one afferent, many times over, each time with other numbers. What varies is said in a file (doc/sweeps.md).

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// A column of a sweep's table: what a unit was given, or what was measured of it.
struct SweepColumn {
    std::string name, unit, sentence = {};
    std::vector<std::string> words = {};                ///< of what varies by word: value k means words[k]
    std::optional<double> at_least = {}, at_most = {};  ///< of a measure: within these a unit passes
};

enum class UnitEnd { done, capped, lost };  ///< capped: its iterations were more than one unit may cost; lost: it did not converge

/// What one unit gave.
struct UnitOutcome {
    std::int64_t unit = 0;
    UnitEnd end = UnitEnd::done;
    std::string why = {};                          ///< of an end that is not done
    std::vector<double> measures = {};             ///< one for each column of measures; NaN: it has none
    std::vector<std::vector<double>> spikes = {};  ///< of each train, s
    std::vector<std::vector<float>> traces = {};   ///< of each trace that is kept, at the times that all share
    std::int64_t steps = 0, iterations = 0;        ///< of a circuit
    bool alone = false;                            ///< it had to leave its lane and was done again by itself
};

/// All that a unit's outcome depends on is in here and in its number: not who runs it, nor with whom, nor when.
class Sweep {
public:
    virtual ~Sweep() = default;

    virtual std::int64_t units() const = 0;
    virtual const std::vector<SweepColumn>& axes() const = 0;  ///< what varies and has a value that can be told
    virtual const std::vector<SweepColumn>& measures() const = 0;
    virtual const std::vector<std::string>& trains() const = 0;  ///< names of the trains of spikes that are kept
    virtual const std::vector<std::string>& traces() const = 0;  ///< names of the traces that are kept
    virtual const std::vector<double>& trace_times() const = 0;  ///< s
    /// The value of each axis for a unit.
    virtual std::vector<double> values(std::int64_t unit) const = 0;

    /// What results depend on, as text: title, the sweep file, every netlist and card that it reads. Two sweeps of the same facts have the
    /// same results; the first in which two differ says what has changed.
    struct Fact {
        std::string name, text;  ///< "netlist circuits/sa1.cir"
    };
    virtual const std::vector<Fact>& facts() const = 0;

    /// Takes one unit after another until there is none left, and tells each when it has ended, in any order. Several threads may be at
    /// it, each with its own call. `stop` is asked often; true: what is not done is left. An error: the sweep itself is at fault.
    using Next = std::function<std::optional<std::int64_t>()>;
    using Told = std::function<void(UnitOutcome&&)>;
    virtual Result<void> work(const Next&, const Told&, const std::function<bool()>& stop) const = 0;

    /// How many lanes a circuit's chips run on: 1, 4 or 8; results do not depend on it.
    virtual void set_lanes(std::size_t) {}
};

/// What is asked for in place of what the file says.
struct SweepAsked {
    std::optional<std::uint64_t> seed = {};
    std::optional<std::int64_t> units = {};
};

/// A sweep file (.toml), or a netlist with .mc and .step lines.
Result<std::unique_ptr<Sweep>> read_sweep(const std::string& path, const SweepAsked& asked = {});

}  // namespace corpuscle
