#include "report/skin_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/parts_document.hpp"
#include "report/skin_frames.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int ticks_per_sample = 10;

/// The number of neighbours per mark.
std::uint32_t per_mark(std::size_t count, std::size_t max_marks) {
    return static_cast<std::uint32_t>((count + max_marks - 1) / std::max<std::size_t>(max_marks, 1));
}

}  // namespace

Result<void> SkinReport::begin(const SkinInput& input) {
    const auto& skin = input.skin;
    clock_ = input.clock;
    const auto samples_of = [&](double seconds) { return std::max<std::int64_t>(std::llround(clock_.rate() * seconds), 1); };
    const auto bin = samples_of(1e-3), frame = samples_of(10e-3);  // shorter frames give no useful rate of one afferent
    units_a_mark_ = per_mark(skin.afferents.size(), most_.marks), sites_a_mark_ = per_mark(skin.plan.sites.size(), most_.marks);
    class_of_.clear(), mark_of_.clear(), mark_first_.clear();
    for (std::uint32_t c = 0; c + 1 < skin.class_begin.size(); ++c)
        for (auto u = skin.class_begin[c]; u < skin.class_begin[c + 1]; ++u) {
            if ((u - skin.class_begin[c]) % units_a_mark_ == 0) mark_first_.push_back(static_cast<std::uint32_t>(u));
            class_of_.push_back(c), mark_of_.push_back(static_cast<std::uint32_t>(mark_first_.size() - 1));
        }
    mark_first_.push_back(static_cast<std::uint32_t>(skin.afferents.size()));
    sites_count_ = skin.plan.sites.size();
    forces_ = Envelope(std::size_t{1} << 16);
    classes_ = Framed<std::uint32_t>(skin.plan.classes.size(), most_.bins, bin);
    marks_ = Framed<std::uint32_t>(mark_first_.size() - 1, most_.frames, frame);
    sites_ = Framed<double>(per_mark(skin.plan.sites.size(), sites_a_mark_), most_.frames, frame);
    spike_units_.clear(), spike_ticks_.clear(), spikes_ = 0;
    return {};
}

void SkinReport::add(const Spike& s) {
    // Frames are half-open, [start, end): a spike exactly at a sample belongs to the frame that starts there.
    const std::int64_t sample = std::max<std::int64_t>(s.offset < 1 ? s.step - 1 : s.step, 0);
    classes_.open(sample), classes_.add(class_of_[s.afferent_index], 1);
    marks_.open(sample), marks_.add(mark_of_[s.afferent_index], 1);
    if (static_cast<std::size_t>(++spikes_) <= most_.spikes) {
        const double ticks = (static_cast<double>(s.step - 1) + s.offset) * ticks_per_sample;
        spike_units_.push_back(s.afferent_index), spike_ticks_.push_back(std::max<std::int64_t>(std::llround(ticks), 0));
    } else if (!spike_units_.empty()) {
        spike_units_ = {}, spike_ticks_ = {};  // an incomplete raster would be misleading
    }
}

void SkinReport::add_force(const SkinRunBlock& response) {
    const auto& force = response.force;
    for (std::size_t from = 0, to = 0; from < response.steps; from = to) {
        to = std::min(static_cast<std::size_t>(sites_.open(response.first_sample + static_cast<std::int64_t>(from)) - response.first_sample),
                      response.steps);
        const auto add = [&](std::size_t s) {
            const double* site_force = force.data + s * force.stride;
            for (auto t = from; t < to; ++t) sites_.add(static_cast<std::uint32_t>(s / sites_a_mark_), site_force[t]);
        };
        for (std::size_t s = 0; force.reads_all && s < sites_count_; ++s) add(s);
        for (const auto s : force.touched)
            if (!force.reads_all) add(s);
    }
}

Result<void> SkinReport::block(const SkinInput&, const SkinRunBlock& response) {
    for (const double f : response.total_force) forces_.add(f);
    add_force(response);
    for (const auto& s : response.spikes) add(s);
    return {};
}

Result<void> SkinReport::end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) {
    for (const auto& s : last) add(s);
    samples_ = samples, shown_samples_ = std::max(samples, last.empty() ? 0 : last.back().step);
    const auto final = std::max<std::int64_t>(shown_samples_ - 1, 0);
    classes_.open(final), marks_.open(final), sites_.open(final);
    return {};
}

/// Spikes by afferent: the number of silent afferents to skip, the number of spikes, then the ticks between them.
Json SkinReport::spikes_document() const {
    if (static_cast<std::size_t>(spikes_) > most_.spikes) return nullptr;
    std::vector<std::uint32_t> begin(class_of_.size() + 1);
    for (const auto u : spike_units_) ++begin[u + 1];
    for (std::size_t u = 0; u < class_of_.size(); ++u) begin[u + 1] += begin[u];
    std::vector<std::int64_t> ticks(spike_ticks_.size());
    auto at = begin;
    for (std::size_t k = 0; k < ticks.size(); ++k) ticks[at[spike_units_[k]]++] = spike_ticks_[k];
    PackedNumbers bytes;
    std::size_t next = 0, trains = 0;
    for (std::size_t u = 0; u < class_of_.size(); ++u) {
        if (begin[u] == begin[u + 1]) continue;
        bytes.number(u - next), bytes.number(begin[u + 1] - begin[u]);
        std::int64_t before = 0;
        for (auto k = begin[u]; k < begin[u + 1]; ++k) bytes.number(static_cast<std::uint64_t>(ticks[k] - std::exchange(before, ticks[k])));
        next = u + 1, ++trains;
    }
    return {{"count", spikes_}, {"trains", trains}, {"tick", clock_.T() / ticks_per_sample}, {"data", array64(bytes.all)}};
}

Json SkinReport::document() const {
    return {{"t0", clock_.t0},
            {"T", clock_.T()},
            {"samples", samples_},
            {"shown_samples", shown_samples_},
            {"force", trace_document(0, nullptr, "force", "N", forces_)},
            {"classes", frames_document(classes_, clock_.T())},
            {"marks", frames_document(marks_, clock_.T())},
            {"units_a_mark", units_a_mark_},
            {"sites", force_document(sites_, clock_.T(), samples_)},
            {"sites_a_mark", sites_a_mark_},
            {"most_spikes", most_.spikes},
            {"spikes", spikes_document()}};
}

}  // namespace corpuscle
