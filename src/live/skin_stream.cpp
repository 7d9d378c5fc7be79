#include "live/skin_stream.hpp"

#include <fmt/format.h>
#include <numeric>

namespace corpuscle {

SkinStream::SkinStream(std::shared_ptr<const Innervation> innervation, const Clock& clock, std::unique_ptr<Skin> skin,
                       std::size_t batch_frames)
    : innervation_(std::move(innervation)), clock_(clock), skin_(std::move(skin)), touched_(sites()), all_sites_(sites()),
      batch_frames_(batch_frames), block_(sites() * batch_frames), is_in_batch_(sites()) {
    std::iota(all_sites_.begin(), all_sites_.end(), 0U);
    spikes_.reserve(8 * innervation_->afferents.size() + 64);  // space for several spikes of each afferent in one frame or batch
    batch_sites_.reserve(sites());
}

Result<std::unique_ptr<SkinStream>> SkinStream::make(std::shared_ptr<const Innervation> innervation, const Clock& clock,
                                                     bool spikes_on_samples, std::size_t batch_frames) {
    const auto set = TRY(instruction_set());
    auto skin = TRY(Skin::make(innervation, {.dt = clock.T(), .spikes_on_samples = spikes_on_samples}, set));
    std::unique_ptr<SkinStream> stream(new SkinStream(std::move(innervation), clock, std::move(skin), batch_frames));
    TRY(stream->warm_up());
    return stream;
}

/// Simulates random presses with 10 N on all afferents, then restores the state. So the memory that is needed if all afferents fire is
/// allocated before the first frame.
Result<void> SkinStream::warm_up() {
    const auto start = skin_->save();
    const auto& plan = innervation_->plan;
    // N at each site, so that an afferent responds as to 10 N.
    const double press = plan.felt_area > 0 && plan.sites.area > 0 ? 10 * plan.sites.area / plan.felt_area : 10;
    std::vector<double> frame(sites());
    std::uint32_t random = 1;  // state of a linear congruential generator
    const auto frames = std::clamp<std::size_t>(2'000'000 / innervation_->afferents.size(), 32, 512);
    for (std::size_t k = 0; k < frames; ++k) {
        random = 1664525 * random + 1013904223;
        std::fill(frame.begin(), frame.end(), random >> 31 == 0 ? 0.0 : press);
        if (k + 2 * batch_frames_ > frames) std::fill(frame.begin() + 1, frame.end(), 0.0);  // the last frames touch one site only
        if (batch_frames_ > 1 && !add_to_batch(frame)) continue;
        TRY(batch_frames_ > 1 ? run_batch() : push(frame));
    }
    if (batch_frames_ > 1) TRY(run_batch());
    return skin_->resume(start);
}

/// The sites whose force in the frame is not 0. Most of a skin is usually untouched, so blocks of sites are tested at once. Within a
/// touched block there are no branches, because with noisy forces the processor could not predict them.
std::span<const std::uint32_t> SkinStream::find_touched(std::span<const double> frame) {
    if (std::count(frame.begin(), frame.end(), 0.0) == 0) return all_sites_;
    constexpr std::size_t block = 16;
    std::size_t touched = 0;
    for (std::size_t from = 0; from < frame.size(); from += block) {
        const auto some = frame.subspan(from, std::min(block, frame.size() - from));
        if (static_cast<std::size_t>(std::count(some.begin(), some.end(), 0.0)) == some.size()) continue;
        for (std::size_t k = 0; k < some.size(); ++k) touched_[touched] = static_cast<std::uint32_t>(from + k), touched += some[k] != 0;
    }
    return std::span(touched_).first(touched);
}

/// The sites whose normal force or shear is not 0.
std::span<const std::uint32_t> SkinStream::find_sheared(std::span<const double> frame, std::span<const double> shear_x,
                                                        std::span<const double> shear_y) {
    std::size_t touched = 0;
    for (std::uint32_t s = 0; s < frame.size(); ++s)
        if (frame[s] != 0 || shear_x[s] != 0 || shear_y[s] != 0) touched_[touched++] = s;
    return std::span(touched_).first(touched);
}

Result<std::span<const Spike>> SkinStream::push(std::span<const double> frame, std::span<const double> shear_x,
                                                std::span<const double> shear_y) {
    if (frame.size() != sites()) return bad_input(fmt::format("a frame has {} forces, but there are {} sites", frame.size(), sites()));
    spikes_.clear();
    SiteForce force{frame.data(), 1, shear_x.empty() ? find_touched(frame) : find_sheared(frame, shear_x, shear_y), false};
    if (!shear_x.empty()) force.shear_x = shear_x.data(), force.shear_y = shear_y.data();
    TRY(skin_->respond(force, 1, spikes_, pool_));
    return std::span<const Spike>(spikes_);
}

bool SkinStream::add_to_batch(std::span<const double> frame, std::span<const double> shear_x, std::span<const double> shear_y) {
    const bool has_shear = !shear_x.empty();
    for (auto& block : shear_blocks_)
        if (has_shear && block.empty()) block.resize(block_.size());
    for (const auto s : has_shear ? find_sheared(frame, shear_x, shear_y) : find_touched(frame)) {
        const auto row = static_cast<std::ptrdiff_t>(s * batch_frames_);
        if (!is_in_batch_[s]) {
            is_in_batch_[s] = 1;
            batch_sites_.push_back(s);
            std::fill_n(block_.begin() + row, batch_frames_, 0.0);
            if (has_shear)
                for (auto& block : shear_blocks_) std::fill_n(block.begin() + row, batch_frames_, 0.0);
        }
        const auto at = s * batch_frames_ + batched_;
        block_[at] = frame[s];
        if (has_shear) shear_blocks_[0][at] = shear_x[s], shear_blocks_[1][at] = shear_y[s];
    }
    return ++batched_ == batch_frames_;
}

Result<std::span<const Spike>> SkinStream::run_batch() {
    spikes_.clear();
    std::sort(batch_sites_.begin(), batch_sites_.end());
    SiteForce force{block_.data(), batch_frames_, batch_sites_, false};
    if (!shear_blocks_[0].empty()) force.shear_x = shear_blocks_[0].data(), force.shear_y = shear_blocks_[1].data();
    const auto ok = skin_->respond(force, batched_, spikes_, pool_);
    for (const auto s : batch_sites_) is_in_batch_[s] = 0;
    batch_sites_.clear();
    batched_ = 0;
    if (!ok) return ok.error();
    return std::span<const Spike>(spikes_);
}

std::span<const Spike> SkinStream::finish() {
    spikes_.clear();
    skin_->finish(spikes_);
    return spikes_;
}

}  // namespace corpuscle
