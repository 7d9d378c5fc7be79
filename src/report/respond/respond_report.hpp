#pragma once
// The report page of the verb `respond`: one self-contained HTML file.

#include <nlohmann/json.hpp>

#include "report/envelope.hpp"
#include "report/respond/hidden_pulses.hpp"
#include "run/sinks/file_sink.hpp"
#include "run/summary/run_summary.hpp"
#include "run/trials/trial_collector.hpp"

namespace corpuscle {

/// Collects traces and spikes during the run; page() fills the template with them.
class RespondReport final : public Sink {
public:
    /// Limit on the stored values of all traces of a page together. With more channels, probes or inputs each trace has fewer points.
    static constexpr std::size_t max_total_points = std::size_t{32} << 20;
    /// The same for a page in a notebook, and the limit on the bytes of its data.
    static constexpr std::size_t max_brief_points = 100'000, max_brief_bytes = 1'500'000;
    static constexpr std::size_t unlimited = static_cast<std::size_t>(-1);
    /// `max_points`: limit on the stored values of all traces. `with_probes`: show currents and membranes if there are at most max_copies
    /// copies of each afferent. `compares_inputs`: if there are several inputs and no copies, show each input as a trial from its start.
    explicit RespondReport(std::size_t max_points = max_total_points, CopySpec copies = {}, bool with_probes = true,
                           bool compares_inputs = false)
        : max_points_(max_points), copies_(std::move(copies)), with_probes_(with_probes), compares_inputs_(compares_inputs) {}

    /// The raster shows at most this many copies of each afferent. If there are more copies, no probes are recorded; otherwise those of the
    /// first copy are.
    static constexpr std::uint32_t max_copies = max_recorded_copies;

    bool wants_probes() const override { return with_probes_ && copies_.count <= max_copies; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;

    /// The page as HTML. Call it after the end of the last input. The plans are those of the afferents before they are copied. `costs`: the
    /// document of costs_of(). If the data would be more than `max_bytes`, only the first channels are shown, which a note says; "" if not
    /// even one channel fits. `trials`: trials_document(), or null.
    std::string page(const RunSummary&, std::span<const AfferentPlan>, const std::string& command, const std::vector<std::string>& warnings,
                     const nlohmann::ordered_json& costs, std::size_t max_bytes = unlimited,
                     const nlohmann::ordered_json& trials = nullptr) const;

private:
    using Json = nlohmann::ordered_json;
    std::size_t max_points_;
    CopySpec copies_;
    bool with_probes_, compares_inputs_;
    std::optional<TrialCollector> compared_inputs_;  // each input as a trial, if there are several
    // Each afferent with all its copies is a group. For the current input: index of the first copy of each group among the plans, then the
    // number of plans.
    std::vector<std::size_t> groups_;
    std::vector<Envelope> forces_;               // one per channel, N
    std::vector<std::vector<Envelope>> probes_;  // [channel * groups() + group][probe], of the first copy; empty if no probes are recorded
    std::vector<HiddenPulses> hidden_pulses_;    // [channel * groups() + group], as probes_
    std::vector<std::string> hidden_notes_;      // of all inputs
    std::vector<std::vector<double>> trains_;    // spike times of each afferent of the current input, s
    std::uint32_t first_channel_ = 0;            // the current input's first channel, counted over all inputs

    std::size_t groups() const { return groups_.size() - 1; }
    /// The index, within the current input, of the first afferent of a group on a channel.
    std::size_t afferent_index(std::size_t channel, std::size_t group) const { return channel * groups_.back() + groups_[group]; }
    /// The number of channels, counted over all inputs, whose data are at most `max_bytes`.
    std::uint32_t channels_within(std::size_t max_bytes) const;
    /// The trials_document() of the compared inputs, or null.
    Json compared_inputs_document() const;
    void add_hidden_notes(const Input&);
    void add_spikes(const Input&, std::size_t channel, std::size_t group);
    void add_rate(const Input&, std::size_t channel, std::size_t group, std::int64_t samples);
    std::vector<AfferentPlan> first_copies_;  // of each group, with the parameters that were drawn for it
    Json recordables_ = Json::array();        // names and units of the probes of each group
    Json inputs_ = Json::array(), traces_ = Json::array(), spikes_ = Json::array(), rates_ = Json::array();
};

/// The table of all measures, with a row for each afferent, channel and phase.
nlohmann::ordered_json rates_document(const RunSummary&);

/// Recording quality: findings as text, and a row of quality metrics for each channel of a recording. Stimuli have no rows.
nlohmann::ordered_json quality_document(const RunSummary&);

/// The table of implementations: for each afferent type and channel a row of the reference, then a row for each other implementation.
nlohmann::ordered_json implementations_document(const ImplementationComparisons&);

}  // namespace corpuscle
