#pragma once
// Collects the responses of a run to its trials. The spikes and the total force of an input are kept until its end.

#include <nlohmann/json_fwd.hpp>

#include "run/sink.hpp"
#include "run/trials/contact_detector.hpp"
#include "run/trials/trial_responses.hpp"

namespace corpuscle {

/// The force of a trial, for a picture: means over equal parts of its measured part.
struct TrialForceCurve {
    double from = 0, step = 0;         ///< s, relative to the point of alignment: the start of the first part, and the length of a part
    std::vector<double> values = {};  ///< N, summed over all channels
};

class TrialCollector final : public Sink {
    TrialOptions options_;
    std::vector<Trial> epochs_;  // of the table; empty without one
    std::vector<std::vector<double>> trains_;  // of the current input, s on its clock
    std::vector<std::size_t> indexes_;         // of its afferents in the responses
    std::vector<double> thresholds_;           // N, of contact onsets, of all inputs if each is a trial
    std::vector<double> force_;                // N, of the current input, summed over channels

    void add(const Input&, std::span<const Spike>);
    /// The trials of an input that ends at `stop` s.
    std::vector<Trial> trials_of(const Input&, double stop, const Contacts&) const;
    void add_notes(const Input&, const Contacts&, std::span<const AlignedTrial>);

public:
    TrialResponses responses;
    std::vector<TrialForceCurve> forces;      ///< for each trial
    std::vector<std::string> inputs;     ///< their names
    std::vector<std::string> notes;      ///< about onsets and trials without one
    std::vector<std::string> input_labels;  ///< of the trials that are complete inputs; empty: from their names

    /// `epochs`: of TrialOptions::table.
    TrialCollector(TrialOptions options, std::vector<Trial> epochs) : options_(std::move(options)), epochs_(std::move(epochs)) {}
    const TrialOptions& options() const { return options_; }

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;

    /// Trials and statistics by label, for the summary. With `bin` (s), also every response with its spikes, and the histograms.
    nlohmann::ordered_json document(std::optional<double> bin = {}) const;
};

/// Reads the table of trials, if there is one, and adds notes about it.
Result<std::unique_ptr<TrialCollector>> make_trial_collector(const TrialOptions&);

}  // namespace corpuscle
