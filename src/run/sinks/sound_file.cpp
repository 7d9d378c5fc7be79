// spikes.wav for the first input, spikes-2.wav for the second: 44.1 kHz, 16 bits. Each spike is a click of one millisecond that begins on
// the nearest frame of the sound. A frame is one sample for each ear. If one afferent was requested, the file is mono. If several were
// requested, or if a skin has several classes, the first is placed on the left, the last on the right, the others between; copies have the
// position of their original. A new click of an afferent cuts off its previous one. The level is so low that simultaneous clicks of all
// afferents do not clip.

#include <sndfile.h>
#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"
#include "run/sinks/file_sink.hpp"

namespace corpuscle {
namespace {

constexpr int sound_rate = 44100;                  // Hz
constexpr std::int64_t click_frames = 44;          // length of a click, 1 ms
constexpr double max_sound_duration = 6 * 3600.0;  // s; the 4 GB limit of WAV allows 6.7 hours of stereo

/// The gain of stereo position a of n on one ear (0 left, 1 right); position 0 is fully left, n - 1 fully right.
double ear_gain(std::size_t a, std::size_t n, std::size_t ear) {
    if (n == 1) return 1;
    const double right = static_cast<double>(a) / static_cast<double>(n - 1);
    return ear == 0 ? 1 - right : right;
}

/// The frame of the sound nearest to a time, s since the start of the input.
std::int64_t frame_of(double t) { return std::llround(t * sound_rate); }

struct SoundCloser {
    void operator()(SNDFILE* wav) const { sf_close(wav); }
};

class SpikeSoundFile final : public FileSink {
    std::unique_ptr<SNDFILE, SoundCloser> wav_;  // of the current input; writes to the last of files_
    std::size_t ears_ = 1;                       // 1 mono, 2 stereo
    std::vector<std::vector<int>> click_shape_;  // [class of afferents][frame * ears_ + ear], 16-bit levels
    std::vector<std::int64_t> last_click_;       // for each afferent of the input: first frame of its last click
    std::int64_t written_ = 0;                   // number of frames written for the current input
    std::vector<int> pending_;                   // the frames after them, ears interleaved
    std::vector<short> out_;                     // the frames that are being written

    /// The sum of the gains of all afferents on the louder ear.
    double loudest_sum(const Population& population) const {
        const auto classes = population.class_count();
        std::vector<double> afferents(classes);
        for (std::size_t u = 0; u < population.size(); ++u) ++afferents[population.class_of(u)];
        double loudest = 0;
        for (std::size_t ear = 0; ear < ears_; ++ear) {
            double sum = 0;
            for (std::size_t c = 0; c < classes; ++c) sum += ear_gain(c, classes, ear) * afferents[c];
            loudest = std::max(loudest, sum);
        }
        return loudest;
    }

    /// Computes the click of each class of afferents. A click starts at its full level and decays exponentially with a time constant of a
    /// quarter of a millisecond.
    Result<void> shape_clicks(const Input& input) {
        const auto classes = input.population.class_count();
        ears_ = classes == 1 ? 1 : 2;
        const double level = 0.9 * 32767 / loudest_sum(input.population);
        if (level < 1)
            return bad_input(fmt::format("'{}': {} afferents at once would make each click too soft for 16 bits; run it without --wav",
                                         input.name, input.population.size()));
        click_shape_.assign(classes, {});
        for (std::size_t c = 0; c < classes; ++c)
            for (std::int64_t k = 0; k < click_frames; ++k)
                for (std::size_t ear = 0; ear < ears_; ++ear)
                    click_shape_[c].push_back(
                        static_cast<int>(level * ear_gain(c, classes, ear) * num::exp(static_cast<double>(-4 * k) / click_frames)));
        return {};
    }

    void add_clicks(const Input& input, std::span<const Spike> spikes) {
        for (const auto& s : spikes) {
            const auto afferent = input.afferent_of(s);
            add_click(afferent, click_shape_[input.population.class_of(afferent)], frame_of(input.since_start(s)));
        }
    }

    /// Adds a click of an afferent at `frame`, and removes the rest of its previous click.
    void add_click(std::size_t afferent, const std::vector<int>& shape, std::int64_t frame) {
        const auto index_of = [this](std::int64_t f) { return static_cast<std::size_t>(f - written_) * ears_; };
        pending_.resize(std::max(pending_.size(), index_of(frame + click_frames)));
        // `finished`: the part of the previous click that ends before this one begins.
        const auto finished = static_cast<std::size_t>(std::min(frame - last_click_[afferent], click_frames)) * ears_;
        for (std::size_t k = finished; k < shape.size(); ++k) pending_[index_of(frame) + k - finished] -= shape[k];
        for (std::size_t k = 0; k < shape.size(); ++k) pending_[index_of(frame) + k] += shape[k];
        last_click_[afferent] = frame;
    }

    /// Writes the frames before `frame`.
    Result<void> write_up_to(std::int64_t frame) {
        if (frame <= written_) return {};
        const auto values = static_cast<std::size_t>(frame - written_) * ears_;
        pending_.resize(std::max(pending_.size(), values));
        out_.assign(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(values));
        pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(values));
        if (sf_writef_short(wav_.get(), out_.data(), frame - written_) != frame - written_)
            return bad_input(fmt::format("cannot write the complete sound: {}", sf_strerror(wav_.get())), {files_.back().path()});
        written_ = frame;
        return {};
    }

public:
    using FileSink::FileSink;

    Result<void> begin(const Input& input) override {
        TRY(create(numbered_name("spikes#.wav", input.index)));
        TRY(shape_clicks(input));
        SF_INFO info = {};
        info.samplerate = sound_rate;
        info.channels = static_cast<int>(ears_);
        info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
        wav_.reset(sf_open_fd(fileno(files_.back().stream()), SFM_WRITE, &info, SF_FALSE));
        if (!wav_) return bad_input(fmt::format("cannot write: {}", sf_strerror(nullptr)), {files_.back().path()});
        last_click_.assign(input.population.size(), -click_frames);  // ended before the first frame
        pending_.clear();
        written_ = 0;
        return {};
    }

    Result<void> block(const Input& input, const RunBlock& block) override {
        const double elapsed = input.since_start(block.end_sample() - 1);
        if (elapsed > max_sound_duration)
            return bad_input(fmt::format("'{}' is longer than {:g} hours, which is the limit of a WAV file; run it without --wav",
                                         input.name, max_sound_duration / 3600),
                             {files_.back().path()});
        add_clicks(input, block.spikes);
        return write_up_to(frame_of(elapsed));  // later clicks begin after this block's last sample
    }

    Result<void> end(const Input& input, std::int64_t samples, std::span<const Spike> last) override {
        add_clicks(input, last);
        const auto clicks_end = written_ + static_cast<std::int64_t>(pending_.size() / ears_);
        TRY(write_up_to(std::max(frame_of(input.since_start(samples)), clicks_end)));
        if (sf_close(wav_.release()) != 0) return bad_input("cannot write the complete sound", {files_.back().path()});
        return {};
    }
};

}  // namespace

extern const OutputFormat sound_format = {
    .names = {"spikes#.wav"},
    .option = "--wav",
    .help = "with --out, also write spikes.wav: one click per spike",
    .make = make_file_sink<SpikeSoundFile>,
};

}  // namespace corpuscle
