#include "reproduction/texture/slide_trials.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

/// The feature that a function of a trial's frames of one taxel gives. The frames are [begin, end) of the recording.
template <class F>
TaxelFeature feature_of_frames(const std::vector<SlideTrial>& trials, const std::vector<TaxelValues>& values, const F& function) {
    TaxelFeature out;
    for (const auto& t : trials) {
        const auto begin = static_cast<std::size_t>(std::ceil(t.from * slide_frame_rate)),
                   end = static_cast<std::size_t>(std::ceil(t.to * slide_frame_rate));
        out.emplace_back();
        for (const auto& frames : values[t.recording].frames) out.back().push_back(function(frames, begin, std::min(end, frames.size())));
    }
    return out;
}

/// The two values that tell the parts of a division apart: halves, speeds or grips.
std::size_t part_of(const SlideTrial& t, SlideTest test) {
    if (test == SlideTest::other_half) return t.is_in_second_half();
    return test == SlideTest::other_speed ? t.speed : t.grip;
}

bool touches_other_half(const SlideTrial& t) { return t.window == t.windows / 2 - 1 || t.window == t.windows / 2; }

}  // namespace

std::vector<SlideTrial> slide_trials(const std::vector<Slide>& slides, double duration, double until) {
    std::vector<SlideTrial> out;
    for (std::size_t r = 0; r < slides.size(); ++r) {
        const auto& s = slides[r];
        const double end = std::min(until, static_cast<double>(s.counts.frames.front().size() - 1) / slide_frame_rate);
        const auto windows = static_cast<std::size_t>((end - slide_start) / duration) / 2 * 2;
        for (std::size_t w = 0; w < windows; ++w) {
            const double from = slide_start + static_cast<double>(w) * duration;
            out.push_back({r, s.surface, s.grip, s.speed, w, windows, from, from + duration});
        }
    }
    return out;
}

TaxelFeature spike_counts(const std::vector<SlideTrial>& trials, const SlideSpikes& spikes) {
    TaxelFeature out;
    for (const auto& t : trials) {
        out.emplace_back();
        for (const auto& train : spikes[t.recording])
            out.back().push_back(static_cast<double>(std::lower_bound(train.begin(), train.end(), t.to) -
                                                     std::lower_bound(train.begin(), train.end(), t.from)));
    }
    return out;
}

TaxelFeature mean_readings(const std::vector<SlideTrial>& trials, const std::vector<TaxelValues>& values) {
    return feature_of_frames(trials, values, [](const auto& frames, std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t k = begin; k < end; ++k) sum += frames[k];
        return sum / static_cast<double>(end - begin);
    });
}

TaxelFeature mean_changes(const std::vector<SlideTrial>& trials, const std::vector<TaxelValues>& values) {
    return feature_of_frames(trials, values, [](const auto& frames, std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t k = begin + 1; k < end; ++k) sum += std::abs(frames[k] - frames[k - 1]);
        return sum / static_cast<double>(end - begin - 1);
    });
}

std::vector<SlideSplit> slide_splits(const std::vector<SlideTrial>& trials, SlideTest test) {
    std::vector<SlideSplit> out(2);
    for (std::size_t k = 0; k < trials.size(); ++k) {
        const auto& t = trials[k];
        if (test == SlideTest::other_half && t.windows < 4) continue;
        const auto part = part_of(t, test);
        out[part].tested.push_back(k);
        if (test != SlideTest::other_half || !touches_other_half(t)) out[1 - part].learned.push_back(k);
    }
    return out;
}

}  // namespace corpuscle
