#include "run/summary/skin_summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.hpp"

namespace corpuscle {
namespace {

/// For each afferent, the site with its largest weight; the first such site if several weights are equal.
std::vector<std::uint32_t> main_sites(const Innervation& skin) {
    std::vector<std::uint32_t> site(skin.afferents.size());
    std::vector<double> weight(skin.afferents.size());
    for (std::size_t c = 0; c < skin.fields.size(); ++c) {
        const auto& field = skin.fields[c];
        const auto afferent_of = [&](std::uint32_t number) { return field.receptors == 1 ? number : number / field.receptors; };
        for (std::uint32_t s = 0; s + 1 < field.begin.size(); ++s)
            for (std::size_t k = field.begin[s]; k < field.begin[s + 1]; ++k)
                if (const auto afferent_index = skin.class_begin[c] + afferent_of(field.afferent[k]);
                    field.weight[k] > weight[afferent_index])
                    weight[afferent_index] = field.weight[k], site[afferent_index] = s;
    }
    return site;
}

}  // namespace

Result<void> SkinSummary::begin(const Input& begun) {
    skin = &begun.skin(), input = begun;
    const auto afferents = skin->afferents.size();
    if (input.phases.size() * afferents > max_phase_counts) input.phases.clear();
    samples = spikes = 0, min_force = max_force = 0, touch_start = no_value;
    counts.assign(afferents, 0), first_times.assign(afferents, no_value);
    last_times_.assign(afferents, -INFINITY), shortest_intervals_.assign(afferents, INFINITY);
    phase_counts_.assign(input.phases.size() * afferents, 0);
    site_touched_samples_.assign((input.phases.size() + 1) * skin->plan.sites.size(), 0);
    spikes_while_touched_.assign((input.phases.size() + 1) * skin->plan.classes.size() * (skin->plan.sites.regions.size() + 1), 0);
    main_site_ = main_sites(*skin);
    return {};
}

/// The index of the phase that contains the time t, s since the start of the force; SkinSummaryRow::all if none does, because such a time
/// counts only in the rows of all phases. Phases do not overlap.
std::size_t SkinSummary::phase_of(double t) const {
    const auto found = std::find_if(input.phases.begin(), input.phases.end(), [t](const Phase& p) { return t >= p.from && t < p.to; });
    return found == input.phases.end() ? SkinSummaryRow::all : static_cast<std::size_t>(found - input.phases.begin());
}

std::size_t SkinSummary::site_index(std::size_t phase, std::size_t site) const {
    return std::min(phase, input.phases.size()) * skin->plan.sites.size() + site;
}

std::size_t SkinSummary::group_index(std::size_t phase, std::size_t class_index, std::size_t region) const {
    const auto regions = skin->plan.sites.regions.size();
    return (std::min(phase, input.phases.size()) * skin->plan.classes.size() + class_index) * (regions + 1) + std::min(region, regions);
}

/// True if the site where the afferent has its largest weight has force at this sample, counted from the start of the force. The sample
/// must be in the block.
bool SkinSummary::is_touched(const RunBlock& block, std::size_t afferent_index, std::int64_t sample) const {
    const auto site = main_site_[afferent_index];
    const auto& touched = block.sites.touched;
    if (!block.sites.reads_all && !std::binary_search(touched.begin(), touched.end(), site)) return false;
    return block.sites.is_touched(site, static_cast<std::size_t>(sample - block.first_sample));
}

/// Counts spikes. `block`: the block in which they arrive; null if they arrive after the force has ended.
void SkinSummary::count_spikes(std::span<const Spike> added, const RunBlock* block) {
    const auto since_start = input.clock_since_start();
    for (const auto& s : added) {
        const double t = since_start.time(s.step, s.offset);
        const auto phase = phase_of(t);
        if (counts[s.afferent_index]++ == 0) first_times[s.afferent_index] = t;
        shortest_intervals_[s.afferent_index] =
            std::min(shortest_intervals_[s.afferent_index], t - std::exchange(last_times_[s.afferent_index], t));
        const bool is_in_phase = phase != SkinSummaryRow::all;
        if (is_in_phase) ++phase_counts_[phase * counts.size() + s.afferent_index];
        if (!block || !is_touched(*block, s.afferent_index, s.step)) continue;
        const auto& afferent = skin->afferents[s.afferent_index];
        for (const auto region : {std::size_t{afferent.region}, SkinSummaryRow::all}) {
            ++spikes_while_touched_[group_index(SkinSummaryRow::all, afferent.class_index, region)];
            if (is_in_phase) ++spikes_while_touched_[group_index(phase, afferent.class_index, region)];
        }
    }
    spikes += static_cast<std::int64_t>(added.size());
}

/// Splits the block at the edges of phases, and counts the samples with force of each site in each phase.
void SkinSummary::count_touched_samples(const RunBlock& block) {
    const auto time = [&, clock = input.clock_since_start()](std::size_t k) {
        return clock.time(block.first_sample + static_cast<std::int64_t>(k));
    };
    for (std::size_t from = 0, to = 0; from < block.steps; from = to) {
        const auto phase = phase_of(time(from));
        while (to < block.steps && phase_of(time(to)) == phase) ++to;
        block.sites.for_each_site(skin->plan.sites.size(), [&](std::size_t s) {
            std::ptrdiff_t touched = 0;
            for (auto t = from; t < to; ++t) touched += block.sites.is_touched(s, t);
            site_touched_samples_[site_index(SkinSummaryRow::all, s)] += touched;
            if (phase != SkinSummaryRow::all) site_touched_samples_[site_index(phase, s)] += touched;
        });
    }
}

Result<void> SkinSummary::block(const Input&, const RunBlock& block) {
    for (std::size_t k = 0; k < block.steps; ++k) {
        const double f = block.force[0][k];
        if (block.first_sample == 0 && k == 0) min_force = max_force = f;
        min_force = std::min(min_force, f), max_force = std::max(max_force, f);
        if (f > 0 && std::isnan(touch_start)) touch_start = input.since_start(block.first_sample + static_cast<std::int64_t>(k));
    }
    count_touched_samples(block);
    count_spikes(block.spikes, &block);
    return {};
}

/// The row of these afferents, which are those of the class in the region.
SkinSummaryRow SkinSummary::row(std::size_t class_index, std::size_t region, std::size_t phase,
                                std::span<const std::uint32_t> afferents) const {
    SkinSummaryRow r{
        .class_index = class_index, .region = region, .phase = phase, .afferents = static_cast<std::int64_t>(afferents.size())};
    r.seconds =
        phase == SkinSummaryRow::all ? seconds() : std::max(std::min(input.phases[phase].to, seconds()) - input.phases[phase].from, 0.0);
    std::int64_t max_spikes = 0;  // of one afferent
    std::int64_t total_touched_samples = 0;
    std::vector<double> firsts;  // times of the first spikes
    for (const auto u : afferents) {
        const std::int64_t fired = phase == SkinSummaryRow::all ? counts[u] : phase_counts_[phase * counts.size() + u];
        const auto touched = site_touched_samples_[site_index(phase, main_site_[u])];
        r.spikes += fired, r.active += fired > 0, r.touched += touched > 0;
        max_spikes = std::max(max_spikes, fired), total_touched_samples += touched;
        if (phase == SkinSummaryRow::all && fired > 0) firsts.push_back(first_times[u]);
    }
    if (max_spikes == 1)
        r.max_rate = no_value;
    else if (r.seconds > 0)
        r.max_rate = static_cast<double>(max_spikes) / r.seconds;
    if (total_touched_samples > 0 && r.spikes != 1)
        r.touched_rate =
            static_cast<double>(spikes_while_touched_[group_index(phase, class_index, region)]) / input.since_start(total_touched_samples);
    for (double* rate : {&r.max_rate, &r.touched_rate})
        if (*rate * input.clock.T() > 1) *rate = no_value;  // several spikes in each sample
    if (!firsts.empty()) r.first_spike = *std::min_element(firsts.begin(), firsts.end());
    r.median_first_spike = median_of(firsts);
    return r;
}

void SkinSummary::add_rows(std::size_t class_index, std::size_t region, const std::vector<std::uint32_t>& afferents) {
    rows.push_back(row(class_index, region, SkinSummaryRow::all, afferents));
    for (std::size_t p = 0; p < input.phases.size(); ++p) rows.push_back(row(class_index, region, p, afferents));
}

Result<void> SkinSummary::end(const Input&, std::int64_t count, std::span<const Spike> last) {
    count_spikes(last, nullptr);
    samples = count;
    touched_times.clear();
    for (const auto site : main_site_)
        touched_times.push_back(input.since_start(site_touched_samples_[site_index(SkinSummaryRow::all, site)]));
    rows.clear();
    const auto regions = skin->plan.sites.regions.size();
    for (std::size_t c = 0; c + 1 < skin->class_begin.size(); ++c) {
        std::vector<std::uint32_t> all;
        std::vector<std::vector<std::uint32_t>> of_region(regions);
        for (std::size_t u = skin->class_begin[c]; u < skin->class_begin[c + 1]; ++u)
            all.push_back(static_cast<std::uint32_t>(u)), of_region[skin->afferents[u].region].push_back(static_cast<std::uint32_t>(u));
        add_rows(c, SkinSummaryRow::all, all);
        for (std::size_t r = 0; regions > 1 && r < regions; ++r)
            if (!of_region[r].empty()) add_rows(c, r, of_region[r]);
    }
    return {};
}

std::pair<std::size_t, double> SkinSummary::count_faster_than(std::size_t class_index, double rate) const {
    const auto from = shortest_intervals_.begin() + static_cast<std::ptrdiff_t>(skin->class_begin[class_index]),
               to = shortest_intervals_.begin() + static_cast<std::ptrdiff_t>(skin->class_begin[class_index + 1]);
    const auto afferents = std::count_if(from, to, [&](double interval) { return interval < 1 / rate; });
    return {static_cast<std::size_t>(afferents), from == to ? 0 : 1 / *std::min_element(from, to)};
}

std::vector<SkinSummary::FirstSpike> SkinSummary::first_spikes(std::size_t count) const {
    std::vector<FirstSpike> all;
    for (std::size_t u = 0; u < first_times.size(); ++u)
        if (!std::isnan(first_times[u])) all.push_back({u, first_times[u]});
    const auto end_of_first = all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()));
    std::partial_sort(all.begin(), end_of_first, all.end(), [](const FirstSpike& a, const FirstSpike& b) {
        return std::pair(a.time, a.afferent_index) < std::pair(b.time, b.afferent_index);
    });
    all.erase(end_of_first, all.end());
    for (auto& f : all) f.time += input.clock.t0;
    return all;
}

}  // namespace corpuscle
