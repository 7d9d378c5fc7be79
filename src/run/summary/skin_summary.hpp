#pragma once
// Statistics of a skin's response: of each class in each region and phase, and the first spike of every afferent. Memory is proportional to
// the number of phases times afferents, and independent of the length of the force.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "measure/measure_base.hpp"
#include "run/run_inputs.hpp"

namespace corpuscle {

/// The work of a run and the notes about it, apart from its response.
struct SkinRunNotes {
    std::string contact = {};                  ///< description of the contact; empty if a recording gives the force at each site
    std::vector<MetadataEntry> metadata = {};  ///< of the force and of the contact
    std::vector<std::string> notes = {};       ///< about the source, the quality of a recording, and the contact
    std::vector<std::string> warnings = {};    ///< reasons why the response may be wrong
    RunStats stats = {};
};

/// Statistics of a class in one region or in all regions, during one phase or all phases.
struct SkinSummaryRow {
    static constexpr std::size_t all = static_cast<std::size_t>(-1);
    std::size_t class_index = 0, region = all, phase = all;  ///< indexes from 0; `all`: over all regions or phases
    std::int64_t afferents = 0;                              ///< number of afferents of the class in the region
    std::int64_t active = 0;                                 ///< number of them with at least one spike in the phase
    std::int64_t touched = 0;  ///< number of them with force, at any time in the phase, at the site where they have their largest weight
    std::int64_t spikes = 0;   ///< of all of them in the phase
    double seconds = 0;        ///< duration of the phase or, for all phases, of the force
    /// Hz, spikes that arrived while their afferent was touched, divided by the time for which the afferents were touched, summed over
    /// them. NaN if none was touched or if there is a single spike.
    double touched_rate = no_value;
    double max_rate =
        0;  ///< Hz, spikes of the most active afferent divided by `seconds`; NaN if it has a single spike, or above the sample rate
    double first_spike = no_value;         ///< s since the start of the force, the earliest spike; NaN for a single phase or without spikes
    double median_first_spike = no_value;  ///< s since the start of the force, median of the afferents' first spikes; NaN as above
    /// Mean rate of the active afferents during `seconds`, Hz; NaN for a single spike.
    double rate() const {
        if (spikes == 1) return no_value;
        return seconds > 0 && active > 0 ? static_cast<double>(spikes) / (static_cast<double>(active) * seconds) : 0;
    }
};

class SkinSummary final : public Sink {
public:
    /// If the number of phases times the number of afferents exceeds this, phases are not reported separately.
    static constexpr std::size_t max_phase_counts = std::size_t{1} << 26;

    /// The first spike of an afferent.
    struct FirstSpike {
        std::size_t afferent_index = 0;
        double time = no_value;  ///< s, on the clock of the force
    };

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;

    // The following are valid after end().
    const Innervation* skin = nullptr;
    InputDescription input;
    /// For each class: all regions together, then region by region if the skin has several. For each of these: all phases together, then
    /// phase by phase.
    std::vector<SkinSummaryRow> rows;
    std::int64_t samples = 0, spikes = 0;  ///< of the force; of all afferents
    double min_force = 0, max_force = 0;   ///< N, smallest and largest total force of all sites
    double touch_start = no_value;     ///< time of the first sample with force, s since the start of the force; NaN if no sample has force
    std::vector<std::int64_t> counts;  ///< spikes of each afferent
    std::vector<double> first_times;   ///< first spike of each afferent, s since the start of the force; NaN without spikes
    /// For each afferent, the time for which it was touched (with force at the site where it has its largest weight), s.
    std::vector<double> touched_times;

    double seconds() const { return input.since_start(samples); }  ///< duration of the force
    /// The `count` earliest of the first spikes of all afferents, in order of time, then afferent index.
    std::vector<FirstSpike> first_spikes(std::size_t count) const;
    /// The number of afferents of a class with an interspike interval shorter than 1 / rate, and one over the shortest interval of the
    /// class, Hz.
    std::pair<std::size_t, double> count_faster_than(std::size_t class_index, double rate) const;

    /// The summary as a JSON document: version, options, skin, input, classes, rows, first spikes, work. The same run gives the same bytes.
    nlohmann::ordered_json document(const RespondOptions&, const SkinRunNotes&) const;
    /// The summary as a table for a terminal: the headings, a row for each class, then a row for each class and phase, then one for each
    /// class and region in which afferents fired.
    std::vector<std::vector<std::string>> table() const;

private:
    std::vector<std::uint32_t> phase_counts_;         // spikes, [phase][afferent]
    std::vector<double> last_times_;                  // time of the last spike of each afferent, s since the start
    std::vector<double> shortest_intervals_;          // shortest interspike interval of each afferent, s
    std::vector<std::uint32_t> main_site_;            // for each afferent, the site with its largest weight
    std::vector<std::int64_t> site_touched_samples_;  // number of samples with force, see site_index()
    std::vector<std::int64_t> spikes_while_touched_;  // number of spikes that arrived at touched afferents, see group_index()

    void count_spikes(std::span<const Spike>, const RunBlock*);
    bool is_touched(const RunBlock&, std::size_t afferent_index, std::int64_t sample) const;
    // Indexes in site_touched_samples_ and spikes_while_touched_. Phase and region may be SkinSummaryRow::all, which has the last index.
    std::size_t site_index(std::size_t phase, std::size_t site) const;
    std::size_t group_index(std::size_t phase, std::size_t class_index, std::size_t region) const;
    void count_touched_samples(const RunBlock&);
    std::size_t phase_of(double t) const;
    /// Adds the row over all phases and the row of each phase.
    void add_rows(std::size_t class_index, std::size_t region, const std::vector<std::uint32_t>& afferents);
    SkinSummaryRow row(std::size_t class_index, std::size_t region, std::size_t phase, std::span<const std::uint32_t> afferents) const;
};

}  // namespace corpuscle
