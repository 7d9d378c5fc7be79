#include "run/summary/skin_summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace corpuscle {
namespace {

/// For each afferent, the site with its largest weight; the first such site if several weights are equal.
std::vector<std::uint32_t> main_sites(const Innervation& skin) {
    std::vector<std::uint32_t> site(skin.afferents.size());
    std::vector<double> weight(skin.afferents.size());
    for (std::size_t c = 0; c < skin.fields.size(); ++c) {
        const auto& field = skin.fields[c];
        for (std::uint32_t s = 0; s + 1 < field.begin.size(); ++s)
            for (std::size_t k = field.begin[s]; k < field.begin[s + 1]; ++k)
                if (const auto afferent_index = skin.class_begin[c] + field.afferent[k]; field.weight[k] > weight[afferent_index])
                    weight[afferent_index] = field.weight[k], site[afferent_index] = s;
    }
    return site;
}

/// The median; changes the order of the values.
double median_of(std::vector<double>& values) {
    if (values.empty()) return no_value;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.size() % 2 == 1 ? *middle : (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace

Result<void> SkinSummary::begin(const Input& input) {
    skin_ = &input.skin();
    name_ = input.name, description_ = input.description, clock_ = input.clock, phases_ = input.phases;
    since_start_ = input.clock_since_start();
    const auto afferents = skin_->afferents.size();
    if (phases_.size() * afferents > max_phase_counts) phases_.clear();
    samples_ = all_spikes_ = 0, min_force_ = max_force_ = 0, touch_start_ = no_value;
    counts_.assign(afferents, 0), first_times_.assign(afferents, no_value);
    last_times_.assign(afferents, -INFINITY), shortest_intervals_.assign(afferents, INFINITY);
    phase_counts_.assign(phases_.size() * afferents, 0);
    site_touched_samples_.assign((phases_.size() + 1) * skin_->plan.sites.size(), 0);
    spikes_while_touched_.assign((phases_.size() + 1) * skin_->plan.classes.size() * (skin_->plan.sites.regions.size() + 1), 0);
    main_site_ = main_sites(*skin_);
    return {};
}

/// The index of the phase that contains the time t, s since the start of the force; SkinSummaryRow::all if none does, because such a time
/// counts only in the rows of all phases. Phases do not overlap.
std::size_t SkinSummary::phase_of(double t) const {
    const auto found = std::find_if(phases_.begin(), phases_.end(), [t](const Phase& p) { return t >= p.from && t < p.to; });
    return found == phases_.end() ? SkinSummaryRow::all : static_cast<std::size_t>(found - phases_.begin());
}

std::size_t SkinSummary::site_index(std::size_t phase, std::size_t site) const {
    return std::min(phase, phases_.size()) * skin_->plan.sites.size() + site;
}

std::size_t SkinSummary::group_index(std::size_t phase, std::size_t class_index, std::size_t region) const {
    const auto regions = skin_->plan.sites.regions.size();
    return (std::min(phase, phases_.size()) * skin_->plan.classes.size() + class_index) * (regions + 1) + std::min(region, regions);
}

/// True if the site where the afferent has its largest weight has force at this sample, counted from the start of the force. The sample
/// must be in the block.
bool SkinSummary::is_touched(const RunBlock& block, std::size_t afferent_index, std::int64_t sample) const {
    const auto site = main_site_[afferent_index];
    const auto& [data, stride, touched, reads_all] = block.sites;
    if (!reads_all && !std::binary_search(touched.begin(), touched.end(), site)) return false;
    return data[site * stride + static_cast<std::size_t>(sample - block.first_sample)] > 0;
}

/// Counts spikes. `block`: the block in which they arrive; null if they arrive after the force has ended.
void SkinSummary::count_spikes(std::span<const Spike> spikes, const RunBlock* block) {
    for (const auto& s : spikes) {
        const double t = since_start_.time(s.step, s.offset);
        const auto phase = phase_of(t);
        if (counts_[s.afferent_index]++ == 0) first_times_[s.afferent_index] = t;
        shortest_intervals_[s.afferent_index] =
            std::min(shortest_intervals_[s.afferent_index], t - std::exchange(last_times_[s.afferent_index], t));
        const bool is_in_phase = phase != SkinSummaryRow::all;
        if (is_in_phase) ++phase_counts_[phase * counts_.size() + s.afferent_index];
        if (!block || !is_touched(*block, s.afferent_index, s.step)) continue;
        const auto& afferent = skin_->afferents[s.afferent_index];
        for (const auto region : {std::size_t{afferent.region}, SkinSummaryRow::all}) {
            ++spikes_while_touched_[group_index(SkinSummaryRow::all, afferent.class_index, region)];
            if (is_in_phase) ++spikes_while_touched_[group_index(phase, afferent.class_index, region)];
        }
    }
    all_spikes_ += static_cast<std::int64_t>(spikes.size());
}

/// Splits the block at the edges of phases, and counts the samples with force of each site in each phase.
void SkinSummary::count_touched_samples(const RunBlock& block) {
    const auto time = [&](std::size_t k) { return since_start_.time(block.first_sample + static_cast<std::int64_t>(k)); };
    for (std::size_t from = 0, to = 0; from < block.steps; from = to) {
        const auto phase = phase_of(time(from));
        while (to < block.steps && phase_of(time(to)) == phase) ++to;
        block.sites.for_each_site(skin_->plan.sites.size(), [&](std::size_t s) {
            const double* force = block.sites.data + s * block.sites.stride;
            const auto samples = std::count_if(force + from, force + to, [](double f) { return f > 0; });
            site_touched_samples_[site_index(SkinSummaryRow::all, s)] += samples;
            if (phase != SkinSummaryRow::all) site_touched_samples_[site_index(phase, s)] += samples;
        });
    }
}

Result<void> SkinSummary::block(const Input&, const RunBlock& block) {
    for (std::size_t k = 0; k < block.steps; ++k) {
        const double f = block.force[0][k];
        if (block.first_sample == 0 && k == 0) min_force_ = max_force_ = f;
        min_force_ = std::min(min_force_, f), max_force_ = std::max(max_force_, f);
        if (f > 0 && std::isnan(touch_start_)) touch_start_ = since_start_.time(block.first_sample + static_cast<std::int64_t>(k));
    }
    count_touched_samples(block);
    count_spikes(block.spikes, &block);
    return {};
}

double SkinSummary::seconds() const { return since_start_.time(samples_); }

/// The row of these afferents, which are those of the class in the region.
SkinSummaryRow SkinSummary::row(std::size_t class_index, std::size_t region, std::size_t phase,
                                std::span<const std::uint32_t> afferents) const {
    SkinSummaryRow r{
        .class_index = class_index, .region = region, .phase = phase, .afferents = static_cast<std::int64_t>(afferents.size())};
    r.seconds = phase == SkinSummaryRow::all ? seconds() : std::max(std::min(phases_[phase].to, seconds()) - phases_[phase].from, 0.0);
    std::int64_t max_spikes = 0;  // of one afferent
    std::int64_t total_touched_samples = 0;
    std::vector<double> first_times;
    for (const auto u : afferents) {
        const std::int64_t spikes = phase == SkinSummaryRow::all ? counts_[u] : phase_counts_[phase * counts_.size() + u];
        const auto samples = site_touched_samples_[site_index(phase, main_site_[u])];
        r.spikes += spikes, r.active += spikes > 0, r.touched += samples > 0;
        max_spikes = std::max(max_spikes, spikes), total_touched_samples += samples;
        if (phase == SkinSummaryRow::all && spikes > 0) first_times.push_back(first_times_[u]);
    }
    if (max_spikes == 1)
        r.max_rate = no_value;
    else if (r.seconds > 0)
        r.max_rate = static_cast<double>(max_spikes) / r.seconds;
    if (total_touched_samples > 0 && r.spikes != 1)
        r.touched_rate =
            static_cast<double>(spikes_while_touched_[group_index(phase, class_index, region)]) / since_start_.time(total_touched_samples);
    if (!first_times.empty()) r.first_spike = *std::min_element(first_times.begin(), first_times.end());
    r.median_first_spike = median_of(first_times);
    return r;
}

void SkinSummary::add_rows(std::size_t class_index, std::size_t region, const std::vector<std::uint32_t>& afferents) {
    rows_.push_back(row(class_index, region, SkinSummaryRow::all, afferents));
    for (std::size_t p = 0; p < phases_.size(); ++p) rows_.push_back(row(class_index, region, p, afferents));
}

Result<void> SkinSummary::end(const Input&, std::int64_t samples, std::span<const Spike> last) {
    count_spikes(last, nullptr);
    samples_ = samples;
    touched_times_.clear();
    for (const auto site : main_site_)
        touched_times_.push_back(since_start_.time(site_touched_samples_[site_index(SkinSummaryRow::all, site)]));
    rows_.clear();
    const auto regions = skin_->plan.sites.regions.size();
    for (std::size_t c = 0; c + 1 < skin_->class_begin.size(); ++c) {
        std::vector<std::uint32_t> all;
        std::vector<std::vector<std::uint32_t>> of_region(regions);
        for (std::size_t u = skin_->class_begin[c]; u < skin_->class_begin[c + 1]; ++u)
            all.push_back(static_cast<std::uint32_t>(u)), of_region[skin_->afferents[u].region].push_back(static_cast<std::uint32_t>(u));
        add_rows(c, SkinSummaryRow::all, all);
        for (std::size_t r = 0; regions > 1 && r < regions; ++r)
            if (!of_region[r].empty()) add_rows(c, r, of_region[r]);
    }
    return {};
}

std::pair<std::size_t, double> SkinSummary::count_faster_than(std::size_t class_index, double rate) const {
    const auto from = shortest_intervals_.begin() + static_cast<std::ptrdiff_t>(skin_->class_begin[class_index]),
               to = shortest_intervals_.begin() + static_cast<std::ptrdiff_t>(skin_->class_begin[class_index + 1]);
    const auto afferents = std::count_if(from, to, [&](double interval) { return interval < 1 / rate; });
    return {static_cast<std::size_t>(afferents), from == to ? 0 : 1 / *std::min_element(from, to)};
}

std::vector<SkinSummary::FirstSpike> SkinSummary::first_spikes(std::size_t count) const {
    std::vector<FirstSpike> all;
    for (std::size_t u = 0; u < first_times_.size(); ++u)
        if (!std::isnan(first_times_[u])) all.push_back({u, first_times_[u]});
    const auto end_of_first = all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()));
    std::partial_sort(all.begin(), end_of_first, all.end(), [](const FirstSpike& a, const FirstSpike& b) {
        return std::pair(a.time, a.afferent_index) < std::pair(b.time, b.afferent_index);
    });
    all.erase(end_of_first, all.end());
    for (auto& f : all) f.time += clock_.t0;
    return all;
}

}  // namespace corpuscle
