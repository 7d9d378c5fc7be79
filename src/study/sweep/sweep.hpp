#pragma once
// A sweep: one circuit, or one afferent, simulated many times with different values. A file defines what varies (doc/sweeps.md).

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// A column of a sweep's table: an axis value or a measure of an item.
struct SweepColumn {
    std::string name, unit, description = {};
    std::vector<std::string> labels = {};      ///< for an axis of labels: value k means labels[k]
    std::optional<double> min = {}, max = {};  ///< limits of a measure, which an item must meet to pass
};

enum class ItemEnd { done, iteration_limit, diverged };  ///< diverged: the solver did not converge

/// The outcome of one work item.
struct ItemOutcome {
    std::int64_t item = 0;
    ItemEnd end = ItemEnd::done;
    std::string reason = {};                       ///< why the item did not end normally; empty if it did
    std::vector<double> measures = {};             ///< one for each column of measures; NaN: not available
    std::vector<std::vector<double>> spikes = {};  ///< for each train, s
    std::vector<std::vector<float>> probes = {};   ///< for each kept probe, at the common sample times
    std::int64_t steps = 0, iterations = 0;        ///< of a circuit
    bool ran_alone = false;                        ///< removed from its lane and simulated alone
};

/// An item's outcome depends only on this object and the item's index: not on the process, the batch or the time.
class Sweep {
public:
    virtual ~Sweep() = default;

    virtual std::int64_t item_count() const = 0;
    virtual const std::vector<SweepColumn>& axes() const = 0;  ///< quantities that vary and have a value
    virtual const std::vector<SweepColumn>& measures() const = 0;
    virtual const std::vector<std::string>& train_names() const = 0;  ///< names of the kept spike trains
    virtual const std::vector<std::string>& probe_names() const = 0;  ///< names of the kept probes
    virtual const std::vector<double>& probe_times() const = 0;       ///< s
    /// The value of each axis for an item.
    virtual std::vector<double> values(std::int64_t item) const = 0;

    /// Everything that the results depend on, as text: title, the sweep file, every netlist and model card that it reads. Two sweeps with
    /// equal metadata have equal results; the first difference names what has changed.
    struct MetadataText {
        std::string name, text;  ///< "netlist circuits/sa1.cir"
    };
    virtual const std::vector<MetadataText>& metadata() const = 0;

    /// Takes items until there is none left and reports each outcome, in any order. Several threads may call it at the same time. `stop` is
    /// called often; true leaves the remaining items. An error is returned only if the sweep itself is wrong.
    using NextItem = std::function<std::optional<std::int64_t>()>;
    using OutcomeHandler = std::function<void(ItemOutcome&&)>;
    virtual Result<void> run_items(const NextItem&, const OutcomeHandler&, const std::function<bool()>& stop) const = 0;

    /// The number of lanes for a circuit's chips: 1, 4 or 8. Results do not depend on it.
    virtual void set_lanes(std::size_t) {}
};

/// Options that replace settings of the file.
struct SweepOverrides {
    std::optional<std::uint64_t> seed = {};
    std::optional<std::int64_t> samples = {};
};

/// A sweep file (.toml), or a netlist with .mc and .step lines.
Result<std::unique_ptr<Sweep>> read_sweep(const std::string& path, const SweepOverrides& overrides = {});

}  // namespace corpuscle
