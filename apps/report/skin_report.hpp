#pragma once
// What a page of a skin shows over time, in bounded memory: force, counts of classes, maps of units and sites, and spikes up to a number.

#include <nlohmann/json_fwd.hpp>

#include "report/envelope.hpp"
#include "report/framed.hpp"
#include "study/skin_run.hpp"

namespace corpuscle {

/// How much is kept.
struct SkinReportLimits {
    std::size_t frames = 200, bins = 4096;  ///< of the maps, of the counts: they widen, by twos, as the force grows
    std::size_t marks = 20000;              ///< on a map; with more units, neighbours of a class share one
    std::size_t spikes = 2'000'000;         ///< kept with their times; of more, counts a frame are
};

class SkinReport final : public SkinListener {
public:
    explicit SkinReport(SkinReportLimits most = {}) : most_(most), forces_(std::size_t{1} << 16) {}

    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinAnswered&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;

    /// The first unit of each mark on the maps; behind the last the end.
    std::span<const std::uint32_t> marks() const { return mark_first_; }
    /// All that the page draws over time.
    nlohmann::ordered_json document() const;

private:
    SkinReportLimits most_;
    Clock clock_;
    std::int64_t samples_ = 0, shown_samples_ = 0, spikes_ = 0;  // shown: spikes may come after the force
    std::size_t sites_count_ = 0;
    Envelope forces_;                                // of all sites together, N
    Framed<std::uint32_t> classes_, marks_;          // spikes of each class in bins, of each mark in frames
    Framed<double> sites_;                           // force of each mark of sites, summed over a frame's samples, N
    std::vector<std::uint32_t> class_of_, mark_of_;  // of each unit
    std::vector<std::uint32_t> mark_first_;          // the first unit of each mark; behind the last the end
    std::uint32_t units_a_mark_ = 1, sites_a_mark_ = 1;
    std::vector<std::uint32_t> spike_units_;  // in order of time
    std::vector<std::int64_t> spike_ticks_;   // tenths of a sample

    void add(const Spike&);
    void add_force(const SkinAnswered&);
    nlohmann::ordered_json spikes_document() const;
};

}  // namespace corpuscle
