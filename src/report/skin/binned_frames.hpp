#pragma once
// Sums of values in consecutive frames of time, all of equal length, for many places: the marks of a map, or the classes of a skin. Memory
// is bounded: when there would be more than `max_frames` frames, adjacent frames are merged in pairs, which doubles their length.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace corpuscle {

template <class V>
class BinnedFrames {
public:
    struct Entry {
        std::uint32_t place;  ///< index of the mark or class, from 0
        V value;
        bool operator==(const Entry&) const = default;
    };
    using Frame = std::vector<Entry>;  ///< in ascending order of place; places whose sum is zero are omitted

    BinnedFrames() = default;
    /// `places`: number of places. `width`: initial length of a frame, samples.
    BinnedFrames(std::size_t places, std::size_t max_frames, std::int64_t width)
        : max_frames_(std::max<std::size_t>(max_frames, 2)), width_(width), current_values_(places) {}

    /// Makes the frame that contains `sample` the current one, to which add() adds. `sample` is counted from 0 at the start of the run and
    /// must not be smaller than in an earlier call. Returns the first sample after this frame.
    std::int64_t select_frame(std::int64_t sample) {
        while (sample >= end_) {
            const auto frame = static_cast<std::size_t>(sample / width_);
            if (frame >= max_frames_) {
                merge_pairs();
            } else {
                while (completed_.size() < frame) close();
                end_ = static_cast<std::int64_t>(frame + 1) * width_;
            }
        }
        return end_;
    }
    void add(std::uint32_t place, V value) {
        if (current_values_[place] == V{}) nonzero_places_.push_back(place);
        current_values_[place] += value;
    }

    std::size_t places() const { return current_values_.size(); }
    /// The present length of a frame, samples.
    std::int64_t width() const { return width_; }
    /// All frames, including the current one.
    std::vector<Frame> frames() const {
        auto all = completed_;
        all.push_back(current_frame());
        return all;
    }

private:
    std::size_t max_frames_ = 2;
    std::int64_t width_ = 1;                     // length of a frame, samples
    std::int64_t end_ = 0;                       // the first sample after the current frame; 0 before the first call of select_frame()
    std::vector<Frame> completed_;               // the frames before the current one
    std::vector<V> current_values_;              // values of the current frame
    std::vector<std::uint32_t> nonzero_places_;  // nonzero places of the current frame; may contain duplicates and places that are 0 again

    Frame current_frame() const {
        auto places = nonzero_places_;
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        Frame frame;
        for (const auto p : places)
            if (current_values_[p] != V{}) frame.push_back({p, current_values_[p]});
        return frame;
    }

    /// Completes the current frame and starts an empty one.
    void close() {
        completed_.push_back(current_frame());
        for (const auto p : nonzero_places_) current_values_[p] = V{};
        nonzero_places_.clear();
    }

    static Frame sum(const Frame& a, const Frame& b) {
        Frame out;
        for (auto i = a.begin(), j = b.begin(); i != a.end() || j != b.end();) {
            if (j == b.end() || (i != a.end() && i->place < j->place))
                out.push_back(*i++);
            else if (i == a.end() || j->place < i->place)
                out.push_back(*j++);
            else
                out.push_back({i->place, i->value + j->value}), ++i, ++j;
        }
        return out;
    }

    /// Doubles the length of the frames. If their number is odd, the last completed frame becomes the first half of the current one.
    void merge_pairs() {
        if (completed_.size() % 2 == 1) {
            for (const auto& e : completed_.back()) {
                const V value = current_values_[e.place];
                current_values_[e.place] = V{};
                add(e.place, e.value), current_values_[e.place] += value;  // the earlier half is summed first
            }
            completed_.pop_back();
        }
        std::vector<Frame> half;
        for (std::size_t k = 0; k + 1 < completed_.size(); k += 2) half.push_back(sum(completed_[k], completed_[k + 1]));
        completed_ = std::move(half);
        width_ *= 2;
        end_ = static_cast<std::int64_t>(completed_.size() + 1) * width_;
    }
};

}  // namespace corpuscle
