#pragma once
// What a skin answered, in numbers: classes, regions and phases, and the first spike of every unit. Memory goes with units and phases,
// not with the length of the force.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "measure/stretch.hpp"
#include "study/skin_run.hpp"

namespace corpuscle {

/// What a run was asked for and what is told of it, beside its answer.
struct SkinTold {
    Method method = Method::exact;
    bool sampled = false;
    std::string contact = {};                ///< its sentence; "": force at the sites, of a recording
    std::vector<Fact> facts = {};            ///< of the force and of the contact
    std::vector<std::string> remarks = {};   ///< of the source and of the contact: what they leave out
    std::vector<std::string> warnings = {};  ///< what makes the answer doubtful
    SkinWork work = {};
};

/// A class in a region, or in all, over a phase, or over all.
struct SkinRow {
    static constexpr std::size_t all = static_cast<std::size_t>(-1);
    std::size_t of = 0, region = all, phase = all;
    std::int64_t units = 0, active = 0;  ///< active: with a spike
    std::int64_t touched = 0;            ///< units of which the site that they feel most had force
    std::int64_t spikes = 0;
    double seconds = 0;              ///< of the phase
    double touched_rate = no_value;  ///< Hz: spikes that arrived while their unit was touched, by the time that units were touched
    double busiest = 0;              ///< Hz: the unit with most spikes, over the phase; none if it has one spike
    double first = no_value;         ///< s since the start: the earliest spike of them; of rows over all phases
    double median_first = no_value;  ///< ... the median of the units' own first spikes
    /// Hz, of one active unit; one spike alone has none.
    double rate() const {
        if (spikes == 1) return no_value;
        return seconds > 0 && active > 0 ? static_cast<double>(spikes) / (static_cast<double>(active) * seconds) : 0;
    }
};

class SkinSummary final : public SkinListener {
public:
    /// With more phases times units than this, phases are not told apart.
    static constexpr std::size_t most_phase_counts = std::size_t{1} << 26;

    /// A unit's first spike.
    struct First {
        std::size_t unit = 0;
        double time = no_value;  ///< s, by the clock of the force
    };

    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinAnswered&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;

    /// From end() on. Classes, then each of their regions; for each, all phases together, then phase after phase.
    const std::vector<SkinRow>& rows() const { return rows_; }
    /// The first of the population, in order of time, then unit.
    std::vector<First> first_spikes(std::size_t most) const;

    const Innervation& skin() const { return *skin_; }
    const std::string& name() const { return name_; }
    const std::string& sentence() const { return sentence_; }
    const Clock& clock() const { return clock_; }
    const std::vector<Phase>& phases() const { return phases_; }
    std::int64_t samples() const { return samples_; }
    std::int64_t spikes() const { return all_spikes_; }
    double seconds() const;  ///< of the force
    double least() const { return least_; }
    double greatest() const { return greatest_; }                            ///< force of all sites together, N
    double touched_from() const { return touched_from_; }                    ///< s since the start: the first sample with force; NaN: none
    const std::vector<std::int64_t>& counts() const { return counts_; }      ///< spikes of each unit
    const std::vector<double>& first_times() const { return first_times_; }  ///< s since the start; NaN: none
    const std::vector<double>& touched_times() const { return unit_touched_; }  ///< s that the site each unit feels most had force

    /// How many units of a class had two spikes closer than such a rate has them, and the highest rate between two; Hz.
    std::pair<std::size_t, double> faster_than(std::size_t of, double rate) const;

    /// As a document: versions, parameters, seed, classes, rows, first spikes. The same run gives the same bytes.
    nlohmann::ordered_json document(const SkinTold&) const;
    /// As a table for a terminal: its heading, then a line a class, then by phase if there are phases, then by region if there are several.
    std::vector<std::vector<std::string>> table() const;

private:
    const Innervation* skin_ = nullptr;
    std::string name_, sentence_;
    Clock clock_, since_start_;
    std::vector<Phase> phases_;
    std::int64_t samples_ = 0, all_spikes_ = 0;
    double least_ = 0, greatest_ = 0, touched_from_ = no_value;
    std::vector<std::int64_t> counts_;
    std::vector<std::uint32_t> phase_counts_;  // [phase][unit]
    std::vector<double> first_times_, unit_touched_;
    std::vector<double> last_times_, shortest_;  // of each unit: its last spike, and its shortest interval; s
    std::vector<std::uint32_t> felt_most_;    // of each unit, the site
    std::vector<std::int64_t> site_touched_;  // [phase; behind the last: no phase][site], samples
    std::vector<SkinRow> rows_;

    std::vector<std::int64_t> while_touched_;  // [phase; behind the last: no phase][class][region], spikes

    void add(std::span<const Spike>, const SkinAnswered*);
    bool touches(const SkinAnswered&, std::size_t unit, std::int64_t sample) const;
    std::size_t group(const SkinUnit&, std::size_t phase) const;
    std::int64_t spikes_while_touched(const SkinRow&) const;
    void add_touch(const SkinAnswered&);
    std::size_t phase_of(double t) const;
    std::int64_t touched_samples(std::size_t unit, std::size_t phase) const;
    void add_rows(std::size_t of, std::size_t region, const std::vector<std::uint32_t>& units);
    SkinRow row(std::size_t of, std::size_t region, std::size_t phase, std::span<const std::uint32_t> units) const;
};

}  // namespace corpuscle
