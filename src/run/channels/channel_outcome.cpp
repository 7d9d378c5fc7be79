#include "run/channels/channel_outcome.hpp"

#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

#include "run/channels/channel_warnings.hpp"
#include "run/channels/sensor_noise.hpp"

namespace corpuscle {
namespace {

/// Adds texts about a source.
void add_of(std::vector<std::string>& to, const std::string& source, const std::vector<std::string>& texts) {
    for (const auto& text : texts) to.push_back(fmt::format("{}: {}", source, text));
}

void append(std::vector<std::string>& to, std::vector<std::string> more) { std::move(more.begin(), more.end(), std::back_inserter(to)); }

/// The highest firing rate of a row, Hz; infinite if several spikes come within one sample.
double highest_rate_of_row(const MeasureRow& row) {
    const auto peak = measure_index<PeakRate>();
    if (row.has_unresolved_rate) return std::numeric_limits<double>::infinity();
    return row.copy_statistics.empty() ? row.values[peak] : row.copy_statistics[peak].max;
}

}  // namespace

ChannelOutcome::ChannelOutcome(const ChannelPlan& plan, const RespondOptions& run)
    : afferents(plan.afferents), copies(plan.copies), options(run) {
    options.pool = nullptr, options.should_continue = {};  // they end with the run
}

void ChannelOutcome::start(Sources sources) {
    for (const auto& source : sources) add_of(notes, source->name(), source->notes());
    append(warnings, rate_warnings(sources, afferents));
    append(warnings, noise_warnings(afferents, options.noise));
    append(warnings, equal_chips_warnings(afferents));
}

void ChannelOutcome::finish(Sources sources, const RunStats& run) {
    stats = run;
    add_quality();
    add_sensor_noise_warnings(sources);
    append(warnings, response_warnings(stats));
    add_rate_warnings(sources[0]->clock().T());
}

void ChannelOutcome::add_quality() {
    for (const auto& i : summary.inputs) add_of(notes, i.name, i.quality.descriptions), add_of(warnings, i.name, i.quality.warnings);
}

void ChannelOutcome::add_sensor_noise_warnings(Sources sources) {
    std::vector<NoiseSubject> subjects;
    for (const auto& a : afferents) subjects.push_back({a.name, &a});
    for (const auto& source : sources)
        if (const auto text = sensor_noise_warning(*source, subjects, options.for_clock(source->clock())); !text.empty())
            add_of(warnings, source->name(), {text});
}

/// Warns of afferents that fire faster than a nerve fibre can; for each of them, the warning names the channel with the highest rate.
void ChannelOutcome::add_rate_warnings(double T) {
    for (const auto& plan : afferents) {
        const MeasureRow* fastest = nullptr;
        double rate = max_nerve_rate;
        for (const auto& row : summary.rows)
            if (const double r = highest_rate_of_row(row); row.afferent == plan.name && r > rate) fastest = &row, rate = r;
        if (fastest) warnings.push_back(channel_rate_warning(rate, T, plan, fastest->channel));
    }
}

std::vector<std::string> ChannelOutcome::silence_notes(std::span<const SilentClass> silent) const {
    std::vector<std::string> out;
    for (const auto& s : silent) out.push_back(silence_note(afferents[s.class_index], s));
    return out;
}

nlohmann::ordered_json ChannelOutcome::document(std::span<const SilentClass> silent) const {
    auto out = summary.document(afferents, stats, options, warnings);
    if (copies.count > 0) out["copies"] = document_of(copies);
    for (const auto& s : silent)
        out["silent"].push_back({{"afferent", afferents[s.class_index].name},
                                 {"force_max_N", s.max_force},
                                 {"factor_to_fire", s.factor ? nlohmann::ordered_json(*s.factor) : nlohmann::ordered_json(nullptr)}});
    return out;
}

}  // namespace corpuscle
