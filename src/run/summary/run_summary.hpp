#pragma once
// Statistics of a run: every measure for every afferent, channel and phase; parameters, clocks, run statistics and warnings.

#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/measures.hpp"
#include "model/copies.hpp"
#include "run/compare/implementation_comparison.hpp"
#include "run/run_inputs.hpp"

namespace corpuscle {

/// Statistics of a measure over those copies of an afferent that have a value for it. The variance is computed as in Welford (1962).
class CopyStatistics {
    double sum_ = 0, mean_ = 0, squares_ = 0;  // squares_: sum of squared distances from the mean so far

public:
    std::int64_t copies = 0;                ///< number of copies with a value
    double min = no_value, max = no_value;  ///< NaN if no copy has a value

    void add(double);  ///< NaN: this copy has no value
    double mean() const { return copies > 0 ? sum_ / static_cast<double>(copies) : no_value; }
    /// Sample standard deviation, over n - 1; NaN for fewer than two copies.
    double standard_deviation() const { return copies >= 2 ? std::sqrt(squares_ / static_cast<double>(copies - 1)) : no_value; }
};

/// One row of the table of measures: an afferent on a channel in a phase. All copies of an afferent share one row.
struct MeasureRow {
    std::string afferent, channel, phase;
    std::vector<double> values;  ///< one for each of `measures`, NaN if it is undefined; with copies, the mean over them
    std::vector<CopyStatistics> copy_statistics = {};  ///< one for each of `measures`; empty without copies
    bool has_unresolved_rate = false;                  ///< true: a rate is left out, see remove_unresolved_rates()
};

/// A measure as a column heading: "peak (Hz)".
std::string column_heading(const MeasureInfo&);
/// A measure as a key in files: "peak_rate_Hz".
std::string measure_key(const MeasureInfo&);

/// An afferent with all its parameters, as a JSON document.
nlohmann::ordered_json document_of(const AfferentPlan&);
/// Distributions of parameters over copies, as a JSON array.
nlohmann::ordered_json document_of(std::span<const ParameterDistribution>);
/// The number of copies of each afferent and their distributions, as a JSON document.
nlohmann::ordered_json document_of(const CopySpec&);

class RunSummary final : public Sink {
public:
    struct InputSummary : InputDescription {
        std::vector<std::string> channels;                   ///< names of the channels
        std::vector<Channel> sensors;                        ///< the channels of the source, some with a position
        std::int64_t samples = 0;                            ///< on each channel
        double min_force = INFINITY, max_force = -INFINITY;  ///< N, over all samples and channels
    };
    std::vector<MeasureRow> rows;           ///< in order of input, channel, afferent, phase
    std::vector<InputSummary> inputs;       ///< the quality of a recording is complete at the end of the input
    ImplementationComparisons comparisons;  ///< of the implementations of one afferent type

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;

    /// The indexes in `measures` of the measures that have a value in some row: the columns of a table.
    std::vector<std::size_t> columns() const;
    /// The summary as a JSON document; the same input and options give the same bytes. The afferents are those that were requested,
    /// without copies.
    nlohmann::ordered_json document(std::span<const AfferentPlan>, const RunStats&, const RespondOptions&,
                                    const std::vector<std::string>& warnings) const;

private:
    MeasureAccumulator tally_;  // the measures of every afferent of the current input in every phase; times since its start

    /// The row of the plans from `from` to `to` - 1, which are one afferent or all copies of one afferent.
    MeasureRow row(const Input&, std::size_t channel, std::size_t from, std::size_t to, std::size_t phase) const;
};

}  // namespace corpuscle
