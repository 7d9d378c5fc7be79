#pragma once
// What came out, in numbers: every measure for every afferent, channel and phase; parameters, clocks, work and warnings.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/measures.hpp"
#include "study/respond.hpp"

namespace corpuscle {

/// One line of the table: a unit in a phase, with one value a measure (NaN: none).
struct RateRow {
    std::string afferent, channel, phase;
    std::vector<double> values;
};

/// A measure as the heading of a column: "peak (Hz)".
std::string heading(const Measure&);

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
};

}  // namespace corpuscle
