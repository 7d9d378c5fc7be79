#pragma once
// Sweeps: one circuit, or one afferent, simulated many times with different values (doc/sweeps.md).

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// How a sweep is run. Each text is as for `corpuscle sweep`.
struct SweepSettings {
    std::string results = {};                  ///< results file; "": the name of the sweep file with .sqlite, in the current directory
    std::string shard = {};                    ///< "1/3": one of three parts; "": all
    std::optional<std::uint64_t> seed = {};    ///< instead of that of the file
    std::optional<std::int64_t> samples = {};  ///< at each point, instead of those of the file
    unsigned threads = 0;                      ///< 0: one for each core; the results do not depend on it
    /// Called with the completed fraction of the missing items, 0 to 1. If it returns false, the sweep stops with InterruptedError.
    /// Finished items are in the results file; the same call resumes the sweep.
    std::function<bool(double)> progress = {};
};

/// An axis or a measure.
struct SweepQuantity {
    std::string name, unit, description;
    std::vector<std::string> labels;  ///< of an axis such as the corner: value k means labels[k]; otherwise empty
    std::optional<double> low, high;  ///< limits of a measure that an item must meet to pass
};

/// The results of a sweep in memory: a row for each finished item, in order.
class SweepRecords {
    struct Impl;
    std::shared_ptr<const Impl> impl_;

public:
    /// Reads a results file, also while the sweep runs. Throws InputError.
    CORPUSCLE_API explicit SweepRecords(const std::string& results);

    CORPUSCLE_API const std::string& results() const;  ///< path of the results file
    CORPUSCLE_API const std::string& title() const;
    CORPUSCLE_API std::int64_t item_count() const;                                     ///< of the complete sweep
    CORPUSCLE_API const std::vector<std::int64_t>& items() const;                      ///< of each row: its number in the sweep, from 0
    CORPUSCLE_API std::vector<std::string> ends() const;                               ///< of each row: "done", "truncated" or "diverged"
    CORPUSCLE_API std::vector<std::pair<std::int64_t, std::string>> failures() const;  ///< items that did not end normally, and the reason
    CORPUSCLE_API std::vector<SweepQuantity> axes() const, measures() const;
    CORPUSCLE_API const std::vector<double>& axis_values(std::size_t axis) const;        ///< of each row. Throws InputError.
    CORPUSCLE_API const std::vector<double>& measure_values(std::size_t measure) const;  ///< NaN: no value. Throws InputError.
    CORPUSCLE_API std::string text() const;                                              ///< what `corpuscle sweep show` prints
    CORPUSCLE_API std::string summary() const;  ///< the JSON document of `corpuscle sweep show --json`
};

/// Runs the missing items of a sweep file (TOML), or of a netlist with .step and .mc, and reads the results. Throws InputError;
/// NotConvergedError if no item converged.
CORPUSCLE_API SweepRecords sweep(const std::string& path, const SweepSettings& = {});
/// The same for the text of a sweep file. `name`: for messages and the results file; paths in the text are relative to its folder.
CORPUSCLE_API SweepRecords sweep_text(const std::string& text, const SweepSettings& = {}, const std::string& name = "sweep.toml");

}  // namespace corpuscle
