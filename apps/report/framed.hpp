#pragma once
// Sums of values at many places over time, in frames of equal length. Memory is bounded: adjacent frames are merged in pairs when there
// are more than `max_frames`.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace corpuscle {

template <class V>
class Framed {
public:
    struct Entry {
        std::uint32_t place;
        V value;
        bool operator==(const Entry&) const = default;
    };
    using Frame = std::vector<Entry>;  ///< in ascending order of place; zeros are omitted

    Framed() = default;
    /// `width`: initial length of a frame, samples.
    Framed(std::size_t places, std::size_t max_frames, std::int64_t width)
        : most_(std::max<std::size_t>(max_frames, 2)), width_(width), now_(places) {}

    /// Makes the frame that contains `sample` the current one, to which add() adds. Samples must not decrease. Returns the first sample
    /// after this frame.
    std::int64_t open(std::int64_t sample) {
        while (sample >= end_) {
            const auto frame = static_cast<std::size_t>(sample / width_);
            if (frame >= most_) {
                halve();
            } else {
                while (done_.size() < frame) close();
                end_ = static_cast<std::int64_t>(frame + 1) * width_;
            }
        }
        return end_;
    }
    void add(std::uint32_t place, V value) {
        if (now_[place] == V{}) held_.push_back(place);
        now_[place] += value;
    }

    std::size_t places() const { return now_.size(); }
    std::int64_t width() const { return width_; }
    /// All frames, including the current one.
    std::vector<Frame> frames() const {
        auto all = done_;
        all.push_back(current());
        return all;
    }

private:
    std::size_t most_ = 2;
    std::int64_t width_ = 1, end_ = 0;  // samples
    std::vector<Frame> done_;
    std::vector<V> now_;               // values of the current frame
    std::vector<std::uint32_t> held_;  // nonzero places of the current frame; may contain duplicates and places that are 0 again

    Frame current() const {
        auto places = held_;
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        Frame frame;
        for (const auto p : places)
            if (now_[p] != V{}) frame.push_back({p, now_[p]});
        return frame;
    }

    void close() {
        done_.push_back(current());
        for (const auto p : held_) now_[p] = V{};
        held_.clear();
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

    void halve() {
        if (done_.size() % 2 == 1) {
            for (const auto& e : done_.back()) {
                const V value = now_[e.place];
                now_[e.place] = V{};
                add(e.place, e.value), now_[e.place] += value;  // keeps the order of time
            }
            done_.pop_back();
        }
        std::vector<Frame> half;
        for (std::size_t k = 0; k + 1 < done_.size(); k += 2) half.push_back(sum(done_[k], done_[k + 1]));
        done_ = std::move(half);
        width_ *= 2;
        end_ = static_cast<std::int64_t>(done_.size() + 1) * width_;
    }
};

}  // namespace corpuscle
