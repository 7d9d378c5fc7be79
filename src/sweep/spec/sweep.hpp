#pragma once
// A sweep: one circuit, or one afferent, simulated many times with different values. A file defines what varies (doc/sweeps.md).

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A column of the table of results, which has one row for each work item: the values of an axis, or of a measure.
struct SweepColumn {
    std::string name, unit, description = {};
    std::vector<std::string> labels = {};      ///< of an axis with labels such as "ss": the stored value k means labels[k]; otherwise empty
    std::optional<double> min = {}, max = {};  ///< of a measure: limits that an item must meet to pass; no value: no limit
};

/// How an item ended. iteration_limit: it was truncated at its limit of iterations. diverged: the solver did not converge, or the item's
/// values contradict one another.
enum class ItemEnd { done, iteration_limit, diverged };

/// The outcome of one work item.
struct ItemOutcome {
    std::int64_t item = 0;  ///< index in the sweep, from 0
    ItemEnd end = ItemEnd::done;
    std::string reason = {};                       ///< why the item did not end normally; empty if it did
    std::vector<double> measures = {};             ///< in the order of SweepDescription::measures; NaN: the item has no value
    std::vector<std::vector<double>> spikes = {};  ///< [train][spike], s; 0 is the first sample of the force, or the start of a transient
    std::vector<std::vector<float>> probes = {};   ///< [probe][sample], at the times SweepDescription::probe_times
    std::int64_t steps = 0, iterations = 0;        ///< of a circuit: time steps and Newton iterations; of a model: 0
    bool ran_alone = false;  ///< true if a chip was simulated outside the SIMD lanes: it did not converge there, or its devices differ from
                             ///< those of the nominal circuit
};

/// A text on which the results of a sweep depend.
struct MetadataText {
    std::string name, text;  ///< name: for example "netlist circuits/sa1.cir"
};

/// The form of a sweep's results.
struct SweepDescription {
    std::int64_t item_count = 0;
    std::vector<SweepColumn> axes, measures;            ///< axes: quantities that vary; mismatch is not among them
    std::vector<std::string> train_names, probe_names;  ///< of the spike trains and probes that are written to the results
    std::vector<std::string> probe_units;               ///< for each of probe_names; "" if it is not known
    std::vector<double> probe_times;                    ///< times of the probes' samples, s; 0 is the first sample of the force
    /// Everything on which the results depend: title, the sweep file, every netlist and model card that it reads. Two sweeps with equal
    /// metadata have equal results; the first entry that differs shows what has changed.
    std::vector<MetadataText> metadata;

    /// The text of the metadata entry with this name; null if there is none.
    const std::string* find_metadata(std::string_view name) const {
        const auto at = std::ranges::find(metadata, name, &MetadataText::name);
        return at == metadata.end() ? nullptr : &at->text;
    }
};

/// A sweep that is ready to run. An item's outcome depends only on this object and the item's index: not on the thread or machine, nor on
/// the other items that are computed with it.
class Sweep : public SweepDescription {
public:
    virtual ~Sweep() = default;

    /// The values of an item, in the order of `axes`; a label is given by its index.
    virtual std::vector<double> values(std::int64_t item) const = 0;

    using NextItem = std::function<std::optional<std::int64_t>()>;
    using OutcomeHandler = std::function<void(ItemOutcome&&)>;
    /// Takes items from `next` until it returns none, and passes each outcome to `on_outcome`, in any order. Several threads may call
    /// run_items() at the same time. It calls `stop` often; if that returns true, the unfinished items get no outcome. An item that fails
    /// has an outcome, too; run_items() returns an error only if the sweep itself is wrong.
    virtual Result<void> run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const = 0;

    /// Sets how many chips of a circuit are computed in parallel on SIMD lanes: 1, 4 or 8. Results do not depend on it.
    virtual void set_lanes(std::size_t) {}
};

/// Settings of the command line. They replace those of the sweep file; no value: the sweep file's own.
struct SweepOverrides {
    std::optional<std::uint64_t> seed = {};
    std::optional<std::int64_t> samples = {};
};

/// Reads a sweep file (.toml), or a netlist with .mc and .step lines.
Result<std::unique_ptr<Sweep>> read_sweep(const std::string& path, const SweepOverrides& overrides = {});
/// Reads the text of a sweep file. `name`: for messages; the paths in the text are relative to its folder.
Result<std::unique_ptr<Sweep>> read_sweep_text(const std::string& text, const std::string& name, const SweepOverrides& overrides = {});

}  // namespace corpuscle
