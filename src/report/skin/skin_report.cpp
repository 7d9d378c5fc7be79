#include "report/skin/skin_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int ticks_per_sample = 10;  // resolution of the spike times on the page

/// The number of neighbouring afferents or sites that share a mark, so that `count` of them have at most `max_marks` marks.
std::uint32_t per_mark(std::size_t count, std::size_t max_marks) {
    return static_cast<std::uint32_t>((count + max_marks - 1) / std::max<std::size_t>(max_marks, 1));
}

/// Variable-length integers (LEB128): seven bits per byte, the lowest bits first; the byte's highest bit is set if more bytes follow.
class PackedNumbers {
public:
    std::vector<unsigned char> bytes;
    void append_number(std::uint64_t n) {
        for (; n >= 128; n >>= 7) bytes.push_back(static_cast<unsigned char>(n | 128));
        bytes.push_back(static_cast<unsigned char>(n));
    }
    /// Encodes a frame as one level per place: levels 1 to 254 as one byte, larger ones as 255 and the level as a number, runs of places
    /// with level 0 as 0 and their number. `level` converts an entry's value to its level, at least 1.
    template <class Frame, class Level>
    void append_frame(const Frame& f, std::size_t places, Level level) {
        std::size_t at = 0;
        const auto zeros_to = [&](std::size_t place) {
            if (place > at) bytes.push_back(0), append_number(place - at);
            at = place + 1;
        };
        for (const auto& [place, value] : f) {
            zeros_to(place);
            const std::uint64_t n = level(value);
            bytes.push_back(static_cast<unsigned char>(std::min<std::uint64_t>(n, 255)));
            if (n >= 255) append_number(n);
        }
        zeros_to(places);
    }
};

/// The frames of a map as compact base64 text for web/skin/frames.ts. `T`: sampling period, s. `level`: converts the value of a place in
/// frame k to its level. `properties`: further members of the document.
template <class V, class Level>
Json frames_document(const BinnedFrames<V>& sums, double T, const Json& properties, Level level) {
    PackedNumbers bytes;
    const auto frames = sums.frames();
    for (std::size_t k = 0; k < frames.size(); ++k) bytes.append_frame(frames[k], sums.places(), [&](V x) { return level(x, k); });
    Json out = {{"count", frames.size()}, {"width", static_cast<double>(sums.width()) * T}, {"places", sums.places()}};
    out.update(properties);
    out["data"] = array_document(std::as_bytes(std::span(bytes.bytes)));
    return out;
}

/// Spike counts in frames.
Json counts_document(const BinnedFrames<std::uint32_t>& counts, double T) {
    return frames_document(counts, T, Json::object(), [](std::uint32_t n, std::size_t) { return std::uint64_t{n}; });
}

/// Mean force of each mark of sites in each frame, in steps of 1/254 of the maximum ("max", N). `sites`: the force of each mark, summed
/// over the samples of the frame. `samples`: length of the run, because the last frame may be incomplete.
Json force_document(const BinnedFrames<double>& sites, double T, std::int64_t samples) {
    // the number of samples in frame k
    const auto length = [&](std::size_t k) {
        return static_cast<double>(std::clamp<std::int64_t>(samples - static_cast<std::int64_t>(k) * sites.width(), 1, sites.width()));
    };
    double max = 0;  // mean force of a mark in a frame, N
    std::size_t k = 0;
    for (const auto& frame : sites.frames()) {
        for (const auto& e : frame) max = std::max(max, e.value / length(k));
        ++k;
    }
    return frames_document(sites, T, {{"max", max}}, [&](double sum, std::size_t frame) {
        const double fraction = max > 0 ? sum / length(frame) / max : 0;
        return fraction > 0 ? static_cast<std::uint64_t>(std::clamp(std::lround(254 * fraction), 1L, 254L)) : std::uint64_t{0};
    });
}

}  // namespace

Result<void> SkinReport::begin(const Input& input) {
    const auto& skin = input.skin();
    clock_ = input.clock;
    const auto samples_of = [&](double seconds) { return std::max<std::int64_t>(std::llround(clock_.rate() * seconds), 1); };
    const auto bin = samples_of(1e-3),
               frame = samples_of(10e-3);  // initial lengths; in shorter frames one afferent has too few spikes for a rate
    afferents_per_mark_ = per_mark(skin.afferents.size(), limits_.marks), sites_per_mark_ = per_mark(skin.plan.sites.size(), limits_.marks);
    class_of_.clear(), mark_of_.clear(), mark_first_.clear();
    for (std::uint32_t c = 0; c + 1 < skin.class_begin.size(); ++c)
        for (auto u = skin.class_begin[c]; u < skin.class_begin[c + 1]; ++u) {
            if ((u - skin.class_begin[c]) % afferents_per_mark_ == 0) mark_first_.push_back(static_cast<std::uint32_t>(u));
            class_of_.push_back(c), mark_of_.push_back(static_cast<std::uint32_t>(mark_first_.size() - 1));
        }
    mark_first_.push_back(static_cast<std::uint32_t>(skin.afferents.size()));
    site_count_ = skin.plan.sites.size();
    forces_ = Envelope(std::size_t{1} << 16);
    classes_ = BinnedFrames<std::uint32_t>(skin.plan.classes.size(), limits_.bins, bin);
    marks_ = BinnedFrames<std::uint32_t>(mark_first_.size() - 1, limits_.frames, frame);
    sites_ = BinnedFrames<double>(per_mark(skin.plan.sites.size(), sites_per_mark_), limits_.frames, frame);
    spike_afferents_.clear(), spike_ticks_.clear(), spikes_ = 0;
    return {};
}

void SkinReport::add(const Spike& s) {
    // Step k ends at sample k. Frames are half-open, [start, end): a spike exactly at a sample (offset 1) belongs to the frame that starts
    // there.
    const std::int64_t sample = std::max<std::int64_t>(s.offset < 1 ? s.step - 1 : s.step, 0);
    classes_.select_frame(sample), classes_.add(class_of_[s.afferent_index], 1);
    marks_.select_frame(sample), marks_.add(mark_of_[s.afferent_index], 1);
    if (static_cast<std::size_t>(++spikes_) <= limits_.timed_spikes) {
        const double ticks = (static_cast<double>(s.step - 1) + s.offset) * ticks_per_sample;
        spike_afferents_.push_back(s.afferent_index), spike_ticks_.push_back(std::max<std::int64_t>(std::llround(ticks), 0));
    } else if (!spike_afferents_.empty()) {
        spike_afferents_ = {}, spike_ticks_ = {};  // beyond the limit none are kept, since an incomplete raster would be misleading
    }
}

/// Adds the force of each site to the frames of its mark. Samples `from` to `to` - 1 of the block are in one frame.
void SkinReport::add_force(const RunBlock& response) {
    const auto& force = response.sites;
    for (std::size_t from = 0, to = 0; from < response.steps; from = to) {
        to = std::min(
            static_cast<std::size_t>(sites_.select_frame(response.first_sample + static_cast<std::int64_t>(from)) - response.first_sample),
            response.steps);
        force.for_each_site(site_count_, [&](std::size_t s) {
            const double* site_force = force.data + s * force.stride;
            for (auto t = from; t < to; ++t) sites_.add(static_cast<std::uint32_t>(s / sites_per_mark_), site_force[t]);
        });
    }
}

Result<void> SkinReport::block(const Input&, const RunBlock& response) {
    for (const double f : response.force[0]) forces_.add(f);
    add_force(response);
    for (const auto& s : response.spikes) add(s);
    return {};
}

Result<void> SkinReport::end(const Input&, std::int64_t samples, std::span<const Spike> last) {
    for (const auto& s : last) add(s);
    samples_ = samples, samples_with_delays_ = std::max(samples, last.empty() ? 0 : last.back().step);
    // The frames of classes, marks and sites all extend to the last spike that arrives.
    const auto final = std::max<std::int64_t>(samples_with_delays_ - 1, 0);
    classes_.select_frame(final), marks_.select_frame(final), sites_.select_frame(final);
    return {};
}

/// The spikes of each afferent that fired: the number of silent afferents before it, the number of its spikes, the ticks from the start to
/// its first spike and between its spikes. Null if there are too many spikes.
Json SkinReport::spikes_document() const {
    if (static_cast<std::size_t>(spikes_) > limits_.timed_spikes) return nullptr;
    std::vector<std::uint32_t> begin(class_of_.size() + 1);
    for (const auto u : spike_afferents_) ++begin[u + 1];
    for (std::size_t u = 0; u < class_of_.size(); ++u) begin[u + 1] += begin[u];
    std::vector<std::int64_t> ticks(spike_ticks_.size());
    auto at = begin;
    for (std::size_t k = 0; k < ticks.size(); ++k) ticks[at[spike_afferents_[k]]++] = spike_ticks_[k];
    PackedNumbers bytes;
    std::size_t next = 0, trains = 0;  // the afferent after the last one that fired; number of afferents that fired
    for (std::size_t u = 0; u < class_of_.size(); ++u) {
        if (begin[u] == begin[u + 1]) continue;
        bytes.append_number(u - next), bytes.append_number(begin[u + 1] - begin[u]);
        std::int64_t before = 0;
        for (auto k = begin[u]; k < begin[u + 1]; ++k)
            bytes.append_number(static_cast<std::uint64_t>(ticks[k] - std::exchange(before, ticks[k])));
        next = u + 1, ++trains;
    }
    return {{"count", spikes_},
            {"trains", trains},
            {"tick", clock_.T() / ticks_per_sample},
            {"data", array_document(std::as_bytes(std::span(bytes.bytes)))}};
}

Json SkinReport::document() const {
    return {{"t0", clock_.t0},
            {"T", clock_.T()},
            {"samples", samples_},
            {"shown_samples", samples_with_delays_},
            {"force", curve_document(0, nullptr, "force", "N", forces_)},
            {"classes", counts_document(classes_, clock_.T())},
            {"marks", counts_document(marks_, clock_.T())},
            {"afferents_per_mark", afferents_per_mark_},
            {"sites", force_document(sites_, clock_.T(), samples_)},
            {"sites_per_mark", sites_per_mark_},
            {"max_spikes", limits_.timed_spikes},
            {"spikes", spikes_document()}};
}

}  // namespace corpuscle
