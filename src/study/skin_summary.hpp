#pragma once
// Statistics of a skin's response: classes, regions and phases, and the first spike of every afferent. Memory is proportional to afferents
// and phases and independent of the length of the force.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "measure/measure_base.hpp"
#include "study/skin_run.hpp"

namespace corpuscle {

/// The settings of a run and the notes about it, apart from its response.
struct SkinRunNotes {
    Method method = Method::exact;
    bool sampled = false;
    std::string contact = {};                  ///< its description; empty if a recording gives the force at each site
    std::vector<MetadataEntry> metadata = {};  ///< of the force and of the contact
    std::vector<std::string> notes = {};       ///< of the source and of the contact: their simplifications
    std::vector<std::string> warnings = {};    ///< why the response may be wrong
    SkinStats stats = {};
};

/// Statistics of a class in one region or in all regions, during one phase or all phases.
struct SkinSummaryRow {
    static constexpr std::size_t all = static_cast<std::size_t>(-1);
    std::size_t class_index = 0, region = all, phase = all;
    std::int64_t afferents = 0, active = 0;  ///< active: with at least one spike
    std::int64_t touched = 0;                ///< afferents with force at the site of their largest weight
    std::int64_t spikes = 0;
    double seconds = 0;  ///< duration of the phase
    /// Hz: spikes that arrived while their afferent was touched, divided by the time that afferents were touched
    double touched_rate = no_value;
    double max_rate = 0;                   ///< Hz: highest rate of an afferent over the phase; NaN if that is a single spike
    double first_spike = no_value;         ///< s since the start: the earliest spike; for rows over all phases
    double median_first_spike = no_value;  ///< s since the start: median of the afferents' first spikes
    /// Mean rate of the active afferents, Hz; a single spike has no rate.
    double rate() const {
        if (spikes == 1) return no_value;
        return seconds > 0 && active > 0 ? static_cast<double>(spikes) / (static_cast<double>(active) * seconds) : 0;
    }
};

class SkinSummary final : public SkinSink {
public:
    /// With more phases times afferents than this, phases are not reported separately.
    static constexpr std::size_t max_phase_counts = std::size_t{1} << 26;

    /// The first spike of an afferent.
    struct FirstSpike {
        std::size_t afferent_index = 0;
        double time = no_value;  ///< s, on the clock of the force
    };

    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinRunBlock&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;

    /// Valid after end(). Classes, then each of their regions; for each, all phases together, then phase by phase.
    const std::vector<SkinSummaryRow>& rows() const { return rows_; }
    /// The earliest first spikes of the population, in order of time, then afferent index.
    std::vector<FirstSpike> first_spikes(std::size_t count) const;

    const Innervation& skin() const { return *skin_; }
    const std::string& name() const { return name_; }
    const std::string& description() const { return description_; }
    const Clock& clock() const { return clock_; }
    const std::vector<Phase>& phases() const { return phases_; }
    std::int64_t samples() const { return samples_; }
    std::int64_t spikes() const { return all_spikes_; }
    double seconds() const;  ///< of the force
    double min_force() const { return min_force_; }
    double max_force() const { return max_force_; }  ///< total force of all sites, N
    /// s since the start: the first sample with force; NaN if there is none
    double touch_start() const { return touch_start_; }
    const std::vector<std::int64_t>& counts() const { return counts_; }      ///< spikes of each afferent
    const std::vector<double>& first_times() const { return first_times_; }  ///< s since the start; NaN if there is none
    /// s during which there was force at the site where an afferent has its largest weight, for each afferent
    const std::vector<double>& touched_times() const { return touched_times_; }

    /// The number of afferents of a class that had an interval shorter than 1 / rate, and the highest rate of any interval; Hz.
    std::pair<std::size_t, double> count_faster_than(std::size_t class_index, double rate) const;

    /// As a JSON document: versions, parameters, seed, classes, rows, first spikes. The same run gives the same bytes.
    nlohmann::ordered_json document(const SkinRunNotes&) const;
    /// As a table for a terminal: its heading and a line for each class, then lines by phase if there are phases, and by region if there
    /// are several.
    std::vector<std::vector<std::string>> table() const;

private:
    const Innervation* skin_ = nullptr;
    std::string name_, description_;
    Clock clock_, since_start_;
    std::vector<Phase> phases_;
    std::int64_t samples_ = 0, all_spikes_ = 0;
    double min_force_ = 0, max_force_ = 0, touch_start_ = no_value;
    std::vector<std::int64_t> counts_;
    std::vector<std::uint32_t> phase_counts_;  // [phase][afferent]
    std::vector<double> first_times_, touched_times_;
    std::vector<double> last_times_, shortest_intervals_;  // of each afferent: its last spike, and its shortest interval; s
    std::vector<std::uint32_t> main_site_;                 // for each afferent, the site with its largest weight
    std::vector<std::int64_t> site_touched_samples_;       // [phase; after the last: no phase][site], samples
    std::vector<SkinSummaryRow> rows_;

    std::vector<std::int64_t> spikes_while_touched_;  // [phase; after the last: no phase][class][region], spikes

    void add(std::span<const Spike>, const SkinRunBlock*);
    bool is_touched(const SkinRunBlock&, std::size_t afferent_index, std::int64_t sample) const;
    std::size_t group_index(const SkinAfferent&, std::size_t phase) const;
    std::int64_t count_spikes_while_touched(const SkinSummaryRow&) const;
    void count_touched_samples(const SkinRunBlock&);
    std::size_t phase_of(double t) const;
    std::int64_t touched_samples(std::size_t afferent_index, std::size_t phase) const;
    void add_rows(std::size_t class_index, std::size_t region, const std::vector<std::uint32_t>& afferents);
    SkinSummaryRow row(std::size_t class_index, std::size_t region, std::size_t phase, std::span<const std::uint32_t> afferents) const;
};

}  // namespace corpuscle
