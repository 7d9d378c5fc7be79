#pragma once
// What came out, in numbers: every measure for every afferent, channel and phase; parameters, clocks, work and warnings.

#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/measures.hpp"
#include "model/spread.hpp"
#include "study/comparisons.hpp"
#include "study/respond.hpp"

namespace corpuscle {

/// A measure over the copies of an afferent that have a value for it. Sums after Welford (1962).
class OverCopies {
    double sum_ = 0, middle_ = 0, squares_ = 0;  // squares: of the distances from the mean so far

public:
    std::int64_t copies = 0;
    double least = no_value, greatest = no_value;

    void add(double);  ///< NaN: this copy has none
    double mean() const { return copies > 0 ? sum_ / static_cast<double>(copies) : no_value; }
    /// As of a sample, over n - 1; two copies are needed.
    double deviation() const { return copies >= 2 ? std::sqrt(squares_ / static_cast<double>(copies - 1)) : no_value; }
};

/// One line of the table: a unit in a phase, with one value a measure (NaN: none). Of copies it is one line for all, with their means.
struct RateRow {
    std::string afferent, channel, phase;
    std::vector<double> values;
    std::vector<OverCopies> over = {};  ///< each measure; empty if there are no copies
};

/// A measure as the heading of a column: "peak (Hz)".
std::string heading(const Measure&);
/// ... and in files: "peak_rate_Hz".
std::string key_of(const Measure&);

/// What an afferent is, with all its parameters, as a document.
nlohmann::ordered_json document_of(const AfferentPlan&);
nlohmann::ordered_json document_of(std::span<const Spread>);
/// How many copies there are of each afferent and how they differ, as a document.
nlohmann::ordered_json document_of(const Copies&);

class Summary final : public Listener {
public:
    struct InputFacts {
        std::string name;
        Clock clock;
        std::int64_t samples = 0;
        std::vector<std::string> channels, remarks;
        std::vector<Fact> facts;
        double least = 0, greatest = 0;  ///< force, N
        std::vector<Phase> phases;       ///< as the stimulus says them, else empty
        Quality quality = {};            ///< of a recording
        std::vector<Channel> sensors = {};
    };

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;

    const std::vector<RateRow>& rows() const { return rows_; }
    const std::vector<InputFacts>& inputs() const { return inputs_; }
    /// Of who has several versions.
    const Comparisons& comparisons() const { return comparisons_; }
    /// The measures (by number) that have a value in some row: the columns of a table.
    std::vector<std::size_t> columns() const;
    /// The summary as a document; the same input and options give the same bytes.
    nlohmann::ordered_json document(std::span<const AfferentPlan>, const Work&, const RespondOptions&, std::uint64_t seed,
                                    const std::vector<std::string>& warnings) const;

private:
    std::vector<InputFacts> inputs_;
    Clock since_start_;  // of the input at work, its first sample at 0 s
    Tally tally_;        // by that clock
    std::vector<RateRow> rows_;
    Comparisons comparisons_;

    RateRow row(const Input&, std::size_t channel, std::size_t from, std::size_t to, std::size_t phase) const;
};

}  // namespace corpuscle
