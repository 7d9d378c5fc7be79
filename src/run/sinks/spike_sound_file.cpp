#include "run/sinks/spike_sound_file.hpp"

#include <sndfile.h>
#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"
#include "model/copies.hpp"

namespace corpuscle {
namespace {

/// The gain of stereo position a of n on one ear (0 left, 1 right); position 0 is fully left, n - 1 fully right.
double ear_gain(std::size_t a, std::size_t n, std::size_t ear) {
    if (n == 1) return 1;
    const double right = static_cast<double>(a) / static_cast<double>(n - 1);
    return ear == 0 ? 1 - right : right;
}

/// Time of a spike since the start of the input, s; without offset, the time of a sample.
double since_start(const Input& input, std::int64_t step, double offset = 1) {
    auto clock = input.source.clock();
    clock.t0 = 0;
    return clock.time(step, offset);
}

/// The frame of the sound nearest to a time, s since the start of the input.
std::int64_t frame_of(double t) { return std::llround(t * SpikeSoundFile::sample_rate); }

}  // namespace

void SpikeSoundFile::SoundCloser::operator()(sf_private_tag* wav) const { sf_close(wav); }

/// Computes the positions of the afferents and the click of each position. A click starts at its full level and decays exponentially with a
/// time constant of a quarter of a millisecond.
Result<void> SpikeSoundFile::shape_clicks(const Input& input) {
    const auto groups = copy_group_starts(input.plans);
    const std::size_t positions = groups.size() - 1;  // copies share the position of their original
    position_of_.clear();
    for (std::size_t p = 0; p < positions; ++p) position_of_.resize(groups[p + 1], p);
    sound_channels_ = positions == 1 ? 1 : 2;
    const double loudness_sum =
        static_cast<double>(input.plans.size()) / (positions == 1 ? 1 : 2);  // sum of the gains of all plans, the same on both ears
    const double loudest = 0.9 * 32767 / (loudness_sum * static_cast<double>(input.source.channels().size()));
    if (loudest < 1)
        return bad_input(fmt::format("'{}': {} afferents at once would make each click too soft for 16 bits; run it without --wav",
                                     input.name, input.afferent_count()));
    click_shape_.assign(positions, {});
    for (std::size_t p = 0; p < positions; ++p)
        for (std::int64_t k = 0; k < click_frames; ++k)
            for (std::size_t ear = 0; ear < sound_channels_; ++ear)
                click_shape_[p].push_back(
                    static_cast<int>(loudest * ear_gain(p, positions, ear) * num::exp(static_cast<double>(-4 * k) / click_frames)));
    return {};
}

Result<void> SpikeSoundFile::begin(const Input& input) {
    auto file = OutputFile::create(numbered_path(directory_, "spikes", ".wav", input.index));
    if (!file) return file.error();
    if (auto ok = shape_clicks(input); !ok) return ok;
    SF_INFO info = {};
    info.samplerate = sample_rate;
    info.channels = static_cast<int>(sound_channels_);
    info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    std::unique_ptr<sf_private_tag, SoundCloser> wav(sf_open_fd(fileno(file->stream()), SFM_WRITE, &info, SF_FALSE));
    if (!wav) return bad_input(fmt::format("cannot write: {}", sf_strerror(nullptr)), {file->path()});
    sounds_.push_back({std::move(*file), std::move(wav)});
    last_click_.assign(input.afferent_count(), -click_frames);  // ended before the first frame
    pending_.clear();
    written_ = 0;
    return {};
}

/// Adds a click of an afferent at `frame`, and removes the rest of its previous click.
void SpikeSoundFile::add_click(std::size_t afferent_index, std::size_t position, std::int64_t frame) {
    const auto index_of = [this](std::int64_t f) { return static_cast<std::size_t>(f - written_) * sound_channels_; };
    pending_.resize(std::max(pending_.size(), index_of(frame + click_frames)));
    const auto& shape = click_shape_[position];
    // `finished`: the part of the previous click that ends before this one begins.
    const auto finished = static_cast<std::size_t>(std::min(frame - last_click_[afferent_index], click_frames)) * sound_channels_;
    for (std::size_t k = finished; k < shape.size(); ++k) pending_[index_of(frame) + k - finished] -= shape[k];
    for (std::size_t k = 0; k < shape.size(); ++k) pending_[index_of(frame) + k] += shape[k];
    last_click_[afferent_index] = frame;
}

/// Writes the frames before `frame`.
Result<void> SpikeSoundFile::write_up_to(std::int64_t frame) {
    if (frame <= written_) return {};
    const auto values = static_cast<std::size_t>(frame - written_) * sound_channels_;
    pending_.resize(std::max(pending_.size(), values));
    out_.assign(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(values));
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(values));
    auto& [file, wav] = sounds_.back();
    if (sf_writef_short(wav.get(), out_.data(), frame - written_) != frame - written_)
        return bad_input(fmt::format("cannot write the complete sound: {}", sf_strerror(wav.get())), {file.path()});
    written_ = frame;
    return {};
}

Result<void> SpikeSoundFile::block(const Input& input, const RunBlock& block) {
    const double elapsed = since_start(input, block.first_sample + static_cast<std::int64_t>(block.force.count) - 1);
    if (elapsed > max_duration)
        return bad_input(fmt::format("'{}' is longer than {:g} hours, which is the limit of a WAV file; run it without --wav", input.name,
                                     max_duration / 3600),
                         {sounds_.back().file.path()});
    for (const auto& s : block.spikes) {
        const std::size_t afferent_index = s.afferent_index - input.first_afferent;
        add_click(afferent_index, position_of_[afferent_index % input.plans.size()], frame_of(since_start(input, s.step, s.offset)));
    }
    return write_up_to(frame_of(elapsed));  // later clicks begin after this block's last sample
}

Result<void> SpikeSoundFile::end(const Input& input, std::int64_t samples) {
    const auto clicks_end = written_ + static_cast<std::int64_t>(pending_.size() / sound_channels_);
    if (auto ok = write_up_to(std::max(frame_of(since_start(input, samples)), clicks_end)); !ok) return ok;
    auto& [file, wav] = sounds_.back();
    if (sf_close(wav.release()) != 0) return bad_input("cannot write the complete sound", {file.path()});
    return {};
}

std::vector<std::string> SpikeSoundFile::paths() const {
    std::vector<std::string> all;
    for (const auto& s : sounds_) all.push_back(s.file.path());
    return all;
}

Result<void> SpikeSoundFile::commit() {
    for (auto& s : sounds_)
        if (auto ok = s.file.commit(); !ok) return ok;
    return {};
}

}  // namespace corpuscle
