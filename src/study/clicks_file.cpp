#include "study/clicks_file.hpp"

#include <sndfile.h>
#include <algorithm>
#include <cmath>

#include "model/copies.hpp"
#include "signal/elementary.hpp"

namespace corpuscle {
namespace {

/// The gain of stereo position a of n on one ear: from fully left to fully right.
double gain(std::size_t a, std::size_t n, std::size_t ear) {
    if (n == 1) return 1;
    const double right = static_cast<double>(a) / static_cast<double>(n - 1);
    return ear == 0 ? 1 - right : right;
}

double since_start(const Input& input, std::int64_t step, double offset = 1) {
    auto clock = input.source.clock();
    clock.t0 = 0;
    return clock.time(step, offset);
}

std::int64_t frame_of(double t) { return std::llround(t * ClicksFile::rate); }

}  // namespace

void ClicksFile::Close::operator()(sf_private_tag* wav) const { sf_close(wav); }

/// Full level at once, then an exponential decay with a time constant of a quarter of a millisecond.
Result<void> ClicksFile::shape_clicks(const Input& input) {
    const auto groups = copy_group_starts(input.afferents);
    const std::size_t places = groups.size() - 1;  // copies share the position of their original
    place_of_.clear();
    for (std::size_t p = 0; p < places; ++p) place_of_.resize(groups[p + 1], p);
    ears_ = places == 1 ? 1 : 2;
    const double loudness_sum = static_cast<double>(input.afferents.size()) / (places == 1 ? 1 : 2);  // the gains on one ear add up to this
    const double loudest = 0.9 * 32767 / (loudness_sum * static_cast<double>(input.source.channels().size()));
    if (loudest < 1)
        return bad_input(fmt::format("'{}': {} afferents at once would make each click too soft for 16 bits; run it without --wav",
                                     input.name, input.units()));
    click_.assign(places, {});
    for (std::size_t p = 0; p < places; ++p)
        for (std::int64_t k = 0; k < frames; ++k)
            for (std::size_t ear = 0; ear < ears_; ++ear)
                click_[p].push_back(static_cast<int>(loudest * gain(p, places, ear) * num::exp(static_cast<double>(-4 * k) / frames)));
    return {};
}

Result<void> ClicksFile::begin(const Input& input) {
    auto file = OutputFile::create(numbered(directory_, "spikes", ".wav", input.index));
    if (!file) return file.error();
    if (auto ok = shape_clicks(input); !ok) return ok;
    SF_INFO info = {};
    info.samplerate = rate;
    info.channels = static_cast<int>(ears_);
    info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    std::unique_ptr<sf_private_tag, Close> wav(sf_open_fd(fileno(file->stream()), SFM_WRITE, &info, SF_FALSE));
    if (!wav) return bad_input(fmt::format("cannot write: {}", sf_strerror(nullptr)), {file->path()});
    sounds_.push_back({std::move(*file), std::move(wav)});
    last_.assign(input.units(), -frames);
    ahead_.clear();
    written_ = 0;
    return {};
}

void ClicksFile::click(std::size_t afferent_index, std::size_t sound, std::int64_t frame) {
    const auto place = [this](std::int64_t f) { return static_cast<std::size_t>(f - written_) * ears_; };
    ahead_.resize(std::max(ahead_.size(), place(frame + frames)));
    const auto& shape = click_[sound];
    const auto since = static_cast<std::size_t>(std::min(frame - last_[afferent_index], frames)) * ears_;
    for (std::size_t k = since; k < shape.size(); ++k) ahead_[place(frame) + k - since] -= shape[k];
    for (std::size_t k = 0; k < shape.size(); ++k) ahead_[place(frame) + k] += shape[k];
    last_[afferent_index] = frame;
}

Result<void> ClicksFile::write_up_to(std::int64_t frame) {
    if (frame <= written_) return {};
    const auto values = static_cast<std::size_t>(frame - written_) * ears_;
    ahead_.resize(std::max(ahead_.size(), values));
    out_.assign(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(values));
    ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(values));
    auto& [file, wav] = sounds_.back();
    if (sf_writef_short(wav.get(), out_.data(), frame - written_) != frame - written_)
        return bad_input(fmt::format("cannot write all of it: {}", sf_strerror(wav.get())), {file.path()});
    written_ = frame;
    return {};
}

Result<void> ClicksFile::block(const Input& input, const Answered& block) {
    const double elapsed = since_start(input, block.first + static_cast<std::int64_t>(block.force.count) - 1);
    if (elapsed > longest)
        return bad_input(
            fmt::format("'{}' is longer than the {:g} hours that a WAV file can hold; run it without --wav", input.name, longest / 3600),
            {sounds_.back().file.path()});
    for (const auto& s : block.spikes) {
        const std::size_t afferent_index = s.afferent_index - input.first_unit;
        click(afferent_index, place_of_[afferent_index % input.afferents.size()], frame_of(since_start(input, s.step, s.offset)));
    }
    return write_up_to(frame_of(elapsed));  // later clicks begin after this block's last sample
}

Result<void> ClicksFile::end(const Input& input, std::int64_t samples) {
    const auto clicks_end = written_ + static_cast<std::int64_t>(ahead_.size() / ears_);
    if (auto ok = write_up_to(std::max(frame_of(since_start(input, samples)), clicks_end)); !ok) return ok;
    auto& [file, wav] = sounds_.back();
    if (sf_close(wav.release()) != 0) return bad_input("cannot write all of it", {file.path()});
    return {};
}

std::vector<std::string> ClicksFile::paths() const {
    std::vector<std::string> all;
    for (const auto& s : sounds_) all.push_back(s.file.path());
    return all;
}

Result<void> ClicksFile::commit() {
    for (auto& s : sounds_)
        if (auto ok = s.file.commit(); !ok) return ok;
    return {};
}

}  // namespace corpuscle
