#include "live/skin_stream.hpp"

#include <fmt/format.h>

namespace corpuscle {

Result<std::unique_ptr<SkinStream>> SkinStream::make(std::shared_ptr<const Innervation> innervation, const Clock& clock, bool sampled) {
    const auto set = instruction_set();
    if (!set) return set.error();
    auto skin = Skin::make(innervation, {.dt = clock.T(), .sampled = sampled}, *set);
    if (!skin) return skin.error();
    std::unique_ptr<SkinStream> stream(new SkinStream(std::move(innervation), clock, std::move(*skin)));
    if (auto ok = stream->warm_up(); !ok) return ok.error();
    return stream;
}

/// A blow on all sites, then as it was: what a skin asks for when all of it fires, it has then.
Result<void> SkinStream::warm_up() {
    const auto start = skin_->save();
    touched_.resize(sites());
    spikes_.reserve(8 * innervation_->units.size() + 64);
    std::vector<double> frame(sites());
    for (int k = 0; k < 32; ++k) {
        std::fill(frame.begin(), frame.end(), k % 8 < 4 ? 0.0 : 10.0);
        if (auto pushed = push(frame); !pushed) return pushed.error();
    }
    return skin_->resume(start);
}

Result<std::span<const Spike>> SkinStream::push(std::span<const double> frame) {
    if (frame.size() != sites()) return bad_input(fmt::format("a frame of {} forces for {} sites", frame.size(), sites()));
    std::size_t touched = 0;  // without a branch: noise makes zeros come and go
    for (std::size_t s = 0; s < frame.size(); ++s) touched_[touched] = static_cast<std::uint32_t>(s), touched += frame[s] != 0;
    spikes_.clear();
    if (auto ok = skin_->respond({frame.data(), 1, std::span(touched_).first(touched), false}, 1, spikes_, here_); !ok) return ok.error();
    return std::span<const Spike>(spikes_);
}

std::span<const Spike> SkinStream::last() {
    spikes_.clear();
    skin_->last(spikes_);
    return spikes_;
}

}  // namespace corpuscle
