#include "run/skin/skin_force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "skin/plan/sites.hpp"
#include "skin/taxel/stuck_taxels.hpp"
#include "skin/taxel/taxel_frames.hpp"

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
    StuckTaxels stuck_;
    TaxelFrames taxels_;
    std::vector<std::uint32_t> channels_;  // the channel of each taxel
    Frames frames_;
    std::vector<double> frame_;                      // of the taxels at one sample, N
    std::vector<double> force_, shear_x_, shear_y_;  // [site][step], N; 0 at sites without a taxel; the last two are empty without shear
    std::vector<double> total_ = std::vector<double>(site_block);
    std::vector<std::uint32_t> touched_;  // sites with force in the block

    SiteForce site_force() const {
        SiteForce out{force_.data(), site_block, touched_, false};
        if (taxels_.has_shear()) out.shear_x = shear_x_.data(), out.shear_y = shear_y_.data();
        return out;
    }

    void find_touched() {
        touched_.clear();
        const auto all = site_force();
        for (const auto site : taxels_.map().sites) {
            bool is_touched = false;
            all.for_each_component([&](const double* component) {
                const double* force = component + site * site_block;
                is_touched = is_touched || std::any_of(force, force + frames_.count, [](double F) { return F != 0; });
            });
            if (is_touched) touched_.push_back(site);
        }
    }

    static double* shear_at(std::vector<double>& shear, std::size_t t) { return shear.empty() ? nullptr : shear.data() + t; }

    void collect_frame(std::size_t t) {
        for (std::size_t k = 0; k < channels_.size(); ++k) {
            const auto c = channels_[k];
            const double normal = frames_.force[c][t];
            stuck_.add(k, normal);
            if (taxels_.has_shear())
                frame_[3 * k] = frames_.shear_x[c][t], frame_[3 * k + 1] = frames_.shear_y[c][t], frame_[3 * k + 2] = normal;
            else
                frame_[k] = normal;
        }
    }

public:
    TaxelsForce(ForceSource& source, const TaxelLayout& layout, TaxelMap map, const std::vector<std::uint32_t>& taxels,
                std::size_t all_sites, std::unique_ptr<TaxelTexture> texture)
        : source_(source), stuck_(layout), taxels_(layout, std::move(map), source.has_shear()), channels_(taxels.size()),
          frames_(taxels.size(), site_block, source.has_shear()), frame_(taxels_.frame_size()), force_(all_sites * site_block) {
        taxels_.set_texture(std::move(texture));
        for (std::uint32_t c = 0; c < taxels.size(); ++c) channels_[taxels[c]] = c;
        if (source.has_shear()) shear_x_ = shear_y_ = force_;
    }

    Result<Block> next() override {
        frames_.count = 0;
        TRY(source_.read(frames_));
        for (std::size_t t = 0; t < frames_.count; ++t) {
            collect_frame(t);
            total_[t] = taxels_.spread(frame_.data(), force_.data() + t, shear_at(shear_x_, t), shear_at(shear_y_, t), site_block);
        }
        find_touched();
        return Block{site_force(), {total_.data(), frames_.count}};
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
                                            const std::vector<std::uint32_t>& taxels, std::size_t all_sites,
                                            std::unique_ptr<TaxelTexture> texture) {
    return std::make_unique<TaxelsForce>(source, layout, std::move(map), taxels, all_sites, std::move(texture));
}

Result<void> check_shear(const TaxelLayout& layout, const ForceSource& source) {
    if (!layout.has_axes || source.has_shear()) return {};
    return bad_input(
        fmt::format("the taxels have axes, but {} has one force for each; remove the columns x_axis, y_axis and z_axis, or use a "
                    "recording with the columns {}.Fx, {}.Fy and {}.Fz",
                    source.name(), layout.taxels[0].name, layout.taxels[0].name, layout.taxels[0].name),
        {layout.file});
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
            fmt::format("{} has {} channel{}, but {} has {} sites, named {} ...; name the channels after sites with "
                        "--layout, select one channel for each site with --channel, or use a population with its sites at the channels "
                        "(sites = \"channels\")",
                        source.name(), source.channels().size(), source.channels().size() == 1 ? "" : "s", plan.name, plan.sites.size(),
                        plan.sites.names[0]));
    return in_order;
}

}  // namespace corpuscle
