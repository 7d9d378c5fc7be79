#pragma once
// Collects the time-dependent data of a skin page in bounded memory: total force, spike counts of classes, maps of afferents and sites, and
// the spike times if there are not too many.

#include <nlohmann/json.hpp>

#include "report/envelope.hpp"
#include "report/skin/binned_frames.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {

/// Maximum numbers of collected data.
struct SkinReportLimits {
    std::size_t frames = 200;   ///< of the maps; their length doubles when there would be more
    std::size_t bins = 4096;    ///< of the classes' spike counts; their length doubles when there would be more
    std::size_t marks = 20000;  ///< on all maps together; with more afferents, neighbours of one class share a mark. Likewise sites
    std::size_t timed_spikes = 2'000'000;  ///< spikes whose times are kept; if there are more, only counts per frame are kept
};

/// The limits of a page in a notebook, which has at most 2 MB.
inline constexpr SkinReportLimits brief_skin_report{.frames = 60, .bins = 2048, .marks = 5000, .timed_spikes = 200'000};

class SkinReport final : public Sink {
public:
    explicit SkinReport(SkinReportLimits limits = {}) : limits_(limits), forces_(std::size_t{1} << 16) {}

    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;

    /// The first afferent of each mark on the maps, then the number of afferents.
    std::span<const std::uint32_t> marks() const { return mark_first_; }
    /// All time-dependent data of the page.
    nlohmann::ordered_json document() const;

private:
    SkinReportLimits limits_;
    Clock clock_;
    std::int64_t samples_ = 0;              // number of samples of the force
    std::int64_t samples_with_delays_ = 0;  // the same, extended to the last spike if conduction delays let it arrive later
    std::int64_t spikes_ = 0;               // all spikes so far, also those whose times are not kept
    std::size_t site_count_ = 0;
    Envelope forces_;                                // total over all sites, N
    BinnedFrames<std::uint32_t> classes_, marks_;    // spike counts of each class in bins, and of each mark in frames
    BinnedFrames<double> sites_;                     // force at each mark of the site map, summed over the samples of a frame, N
    std::vector<std::uint32_t> class_of_, mark_of_;  // index of the class and of the mark of each afferent
    std::vector<std::uint32_t> mark_first_;          // the first afferent of each mark, then the number of afferents
    std::uint32_t afferents_per_mark_ = 1, sites_per_mark_ = 1;
    std::vector<std::uint32_t> spike_afferents_;  // the afferent of each spike, in order of time
    std::vector<std::int64_t> spike_ticks_;       // the time of each spike since the start, tenths of a sample

    void add(const Spike&);
    void add_force(const RunBlock&);
    nlohmann::ordered_json spikes_document() const;
};

/// The report page of a skin as self-contained HTML: animated maps, rasters, rates, first spikes. The summary and the report must be of the
/// same run, whose Innervation must still exist. `command`: the command line. `trials`:
/// skin_trials_document(), or null.
std::string skin_page(const SkinSummary&, const SkinReport&, const RespondOptions&, const SkinRunNotes&, const std::string& command,
                      const nlohmann::ordered_json& trials = nullptr);

}  // namespace corpuscle
