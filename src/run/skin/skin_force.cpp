#include "run/skin/skin_force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <numeric>

#include "core/number/elementary.hpp"
#include "skin/plan/sites.hpp"
#include "skin/taxel/stuck_taxels.hpp"

namespace corpuscle {
namespace {

/// Samples per block. Blocks are short, because each site with force at any time in a block is simulated for the complete block.
constexpr std::size_t pressed_block = 64, site_block = 256;

class PressedForce final : public SkinForce {
    ForceSource& source_;
    Contact& contact_;
    Frames frames_;
    std::int64_t first_ = 0;  // index of the first sample of the next block

public:
    PressedForce(ForceSource& source, Contact& contact)
        : source_(source), contact_(contact), frames_(1, pressed_block, source.has_shear()) {}

    Result<Block> next() override {
        frames_.count = 0;
        TRY(source_.read(frames_));
        const std::span<const double> force(frames_.force[0].data(), frames_.count);
        if (const auto at = first_non_finite(force); at < force.size())
            return bad_input(
                fmt::format("the force of sample {} is {}, not a finite number", first_ + static_cast<std::int64_t>(at), force[at]));
        std::span<const double> shear_x, shear_y;
        if (!frames_.shear_x.empty())
            shear_x = {frames_.shear_x[0].data(), frames_.count}, shear_y = {frames_.shear_y[0].data(), frames_.count};
        auto site_force = TRY(contact_.press(force, first_, shear_x, shear_y));
        first_ += static_cast<std::int64_t>(force.size());
        return Block{site_force, force};
    }
    double progress() const override { return source_.progress(); }
    RecordingQuality quality() const override { return source_.quality(); }
};

class SitesForce final : public SkinForce {
    ForceSource& source_;
    std::vector<std::uint32_t> sites_;  // the site of each channel
    Frames frames_;
    std::vector<double> force_;                                    // [site][step], N; 0 at sites without a channel
    std::vector<double> shear_x_, shear_y_;                        // the same; empty: the source has no shear
    std::vector<double> total_ = std::vector<double>(site_block);  // of all sites, for each step, N

public:
    SitesForce(ForceSource& source, std::vector<std::uint32_t> sites, std::size_t all_sites)
        : source_(source), sites_(std::move(sites)), frames_(sites_.size(), site_block, source.has_shear()),
          force_(all_sites * site_block) {
        if (source.has_shear()) shear_x_ = shear_y_ = force_;
    }

    Result<Block> next() override {
        frames_.count = 0;
        TRY(source_.read(frames_));
        std::fill(total_.begin(), total_.end(), 0.0);
        for (std::size_t c = 0; c < sites_.size(); ++c) {
            const auto at = static_cast<std::ptrdiff_t>(sites_[c] * site_block);
            std::copy_n(frames_.force[c].begin(), frames_.count, force_.begin() + at);
            if (!shear_x_.empty()) {
                std::copy_n(frames_.shear_x[c].begin(), frames_.count, shear_x_.begin() + at);
                std::copy_n(frames_.shear_y[c].begin(), frames_.count, shear_y_.begin() + at);
            }
            for (std::size_t t = 0; t < frames_.count; ++t) total_[t] += frames_.force[c][t];
        }
        SiteForce force{force_.data(), site_block};
        if (!shear_x_.empty()) force.shear_x = shear_x_.data(), force.shear_y = shear_y_.data();
        return Block{force, {total_.data(), frames_.count}};
    }
    double progress() const override { return source_.progress(); }
    RecordingQuality quality() const override { return source_.quality(); }
};

class TaxelsForce final : public SkinForce {
    ForceSource& source_;
    TaxelMap map_;
    StuckTaxels stuck_;
    std::vector<std::uint32_t> channels_;  // the channel of each taxel
    Frames frames_;
    std::vector<double> frame_;  // of the taxels at one sample, N
    std::vector<double> force_;  // [site][step], N; 0 at sites without a taxel
    std::vector<double> total_ = std::vector<double>(site_block);
    std::vector<std::uint32_t> touched_;  // sites with force in the block
    // The following are empty if the source has no shear.
    std::vector<std::array<double, 2>> rotation_;  // cosine and sine of the rotation of each taxel's patch
    std::vector<double> frame_x_, frame_y_;        // shear of the taxels at one sample, along the axes of the skin, N
    std::vector<double> shear_x_, shear_y_;        // [site][step], N

    void find_touched() {
        touched_.clear();
        for (const auto site : map_.sites) {
            const auto has_force = [&](const std::vector<double>& component) {
                const auto from = component.begin() + static_cast<std::ptrdiff_t>(component.empty() ? 0 : site * site_block);
                return !component.empty() &&
                       std::any_of(from, from + static_cast<std::ptrdiff_t>(frames_.count), [](double F) { return F != 0; });
            };
            if (has_force(force_) || has_force(shear_x_) || has_force(shear_y_)) touched_.push_back(site);
        }
    }

    /// Turns the shear of sample t into the axes of the skin, and spreads it over the sites.
    void spread_shear(std::size_t t) {
        for (std::size_t k = 0; k < frame_x_.size(); ++k) {
            const double x = frames_.shear_x[channels_[k]][t], y = frames_.shear_y[channels_[k]][t];
            const auto [c, s] = rotation_[k];
            frame_x_[k] = c * x - s * y, frame_y_[k] = s * x + c * y;
        }
        map_.spread(frame_x_.data(), shear_x_.data() + t, site_block);
        map_.spread(frame_y_.data(), shear_y_.data() + t, site_block);
    }

public:
    TaxelsForce(ForceSource& source, const TaxelLayout& layout, TaxelMap map, const std::vector<std::uint32_t>& taxels,
                std::size_t all_sites)
        : source_(source), map_(std::move(map)), stuck_(layout), channels_(taxels.size()),
          frames_(taxels.size(), site_block, source.has_shear()), frame_(taxels.size()), force_(all_sites * site_block) {
        for (std::uint32_t c = 0; c < taxels.size(); ++c) channels_[taxels[c]] = c;
        if (!source.has_shear()) return;
        for (const auto& taxel : layout.taxels)
            rotation_.push_back({num::cos_turns(taxel.pose.rotation), num::sin_turns(taxel.pose.rotation)});
        frame_x_ = frame_y_ = frame_, shear_x_ = shear_y_ = force_;
    }

    Result<Block> next() override {
        frames_.count = 0;
        TRY(source_.read(frames_));
        for (std::size_t t = 0; t < frames_.count; ++t) {
            total_[t] = 0;
            for (std::size_t k = 0; k < frame_.size(); ++k) {
                frame_[k] = frames_.force[channels_[k]][t];
                total_[t] += map_.total[k] * frame_[k];
                stuck_.add(k, frame_[k]);
            }
            map_.spread(frame_.data(), force_.data() + t, site_block);
            if (!shear_x_.empty()) spread_shear(t);
        }
        find_touched();
        SiteForce force{force_.data(), site_block, touched_, false};
        if (!shear_x_.empty()) force.shear_x = shear_x_.data(), force.shear_y = shear_y_.data();
        return Block{force, {total_.data(), frames_.count}};
    }
    double progress() const override { return source_.progress(); }
    RecordingQuality quality() const override { return source_.quality(); }
    std::vector<std::string> notes() const override { return stuck_.notes(); }
};

}  // namespace

std::unique_ptr<SkinForce> make_pressed_force(ForceSource& source, Contact& contact) {
    return std::make_unique<PressedForce>(source, contact);
}
std::unique_ptr<SkinForce> make_site_force(ForceSource& source, std::vector<std::uint32_t> sites, std::size_t all_sites) {
    return std::make_unique<SitesForce>(source, std::move(sites), all_sites);
}
std::unique_ptr<SkinForce> make_taxel_force(ForceSource& source, const TaxelLayout& layout, TaxelMap map,
                                            const std::vector<std::uint32_t>& taxels, std::size_t all_sites) {
    return std::make_unique<TaxelsForce>(source, layout, std::move(map), taxels, all_sites);
}

Result<std::vector<std::uint32_t>> match_sites(const SkinPlan& plan, const ForceSource& source) {
    std::vector<std::string> names;
    for (const auto& c : source.channels()) names.push_back(c.name);
    std::vector<std::uint32_t> in_order(plan.sites.size());
    std::iota(in_order.begin(), in_order.end(), 0U);
    if (names == plan.sites.names) return in_order;
    auto named = find_sites_if_named(plan.sites, names);
    if (!named)
        return bad_input(fmt::format("{}; --layout FILE renames channels, --channel selects some", named.error().message), {source.name()});
    if (*named) return **std::move(named);
    if (source.channels().size() != plan.sites.size())
        return bad_input(
            fmt::format("{} has {} channels, but {} has {} sites, named {} ...; name the channels after sites with "
                        "--layout, select one channel for each site with --channel, or use a population with its sites at the channels "
                        "(sites = \"channels\")",
                        source.name(), source.channels().size(), plan.name, plan.sites.size(), plan.sites.names[0]));
    return in_order;
}

}  // namespace corpuscle
