#include "run/skin/skin_force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "skin/plan/sites.hpp"
#include "skin/taxel/stuck_taxels.hpp"

namespace corpuscle {
namespace {

/// Samples per block. Blocks are short, because each site with force at any time in a block is simulated for the complete block.
constexpr std::size_t pressed_block = 64, site_block = 256;

class PressedForce final : public SkinForce {
    ForceSource& source_;
    Contact& contact_;
    Frames frames_{1, pressed_block};
    std::int64_t first_ = 0;  // index of the first sample of the next block

public:
    PressedForce(ForceSource& source, Contact& contact) : source_(source), contact_(contact) {}

    Result<Block> next() override {
        frames_.count = 0;
        TRY(source_.read(frames_));
        const std::span<const double> force(frames_.force[0].data(), frames_.count);
        if (const auto at = first_non_finite(force); at < force.size())
            return bad_input(
                fmt::format("the force of sample {} is {}, not a finite number", first_ + static_cast<std::int64_t>(at), force[at]));
        auto site_force = TRY(contact_.press(force, first_));
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
    std::vector<double> total_ = std::vector<double>(site_block);  // of all sites, for each step, N

public:
    SitesForce(ForceSource& source, std::vector<std::uint32_t> sites, std::size_t all_sites)
        : source_(source), sites_(std::move(sites)), frames_(sites_.size(), site_block), force_(all_sites * site_block) {}

    Result<Block> next() override {
        frames_.count = 0;
        TRY(source_.read(frames_));
        std::fill(total_.begin(), total_.end(), 0.0);
        for (std::size_t c = 0; c < sites_.size(); ++c) {
            std::copy_n(frames_.force[c].begin(), frames_.count, force_.begin() + static_cast<std::ptrdiff_t>(sites_[c] * site_block));
            for (std::size_t t = 0; t < frames_.count; ++t) total_[t] += frames_.force[c][t];
        }
        return Block{{force_.data(), site_block}, {total_.data(), frames_.count}};
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

    void find_touched() {
        touched_.clear();
        for (const auto site : map_.sites) {
            const double* force = force_.data() + site * site_block;
            if (std::any_of(force, force + frames_.count, [](double F) { return F != 0; })) touched_.push_back(site);
        }
    }

public:
    TaxelsForce(ForceSource& source, const TaxelLayout& layout, TaxelMap map, const std::vector<std::uint32_t>& taxels,
                std::size_t all_sites)
        : source_(source), map_(std::move(map)), stuck_(layout), channels_(taxels.size()), frames_(taxels.size(), site_block),
          frame_(taxels.size()), force_(all_sites * site_block) {
        for (std::uint32_t c = 0; c < taxels.size(); ++c) channels_[taxels[c]] = c;
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
        }
        find_touched();
        return Block{{force_.data(), site_block, touched_, false}, {total_.data(), frames_.count}};
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
