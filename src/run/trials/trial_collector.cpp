#include "run/trials/trial_collector.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "run/channels/channel_population.hpp"
#include "run/summary/json_number.hpp"
#include "run/trials/epoch_table.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t force_points = 200;  // of the picture of a trial

/// The name of an afferent's channel, without the name of the input.
std::string channel_of(const Population& population, std::size_t u) {
    const auto* on_channels = population.on_channels();
    return on_channels ? on_channels->sensors()[on_channels->channel_of(u)].name : population.channel_name(u);
}

/// The force of a trial's measured part as means.
TrialForceCurve force_of(const AlignedTrial& trial, std::span<const double> force, const Clock& clock) {
    if (!trial.has_zero() || force.empty()) return {};
    const double T = clock.T();
    const auto index = [&](double t) {
        return static_cast<std::size_t>(std::clamp(std::ceil((trial.zero + t - clock.t0) / T - 1e-6), 0.0, static_cast<double>(force.size())));
    };
    const std::size_t first = index(trial.from), count = index(trial.to) - first, part = std::max<std::size_t>((count + force_points - 1) / force_points, 1);
    TrialForceCurve out{clock.time(static_cast<std::int64_t>(first)) - trial.zero, static_cast<double>(part) * T};
    for (std::size_t k = 0; k < count; k += part) {
        const std::size_t end = std::min(k + part, count);
        double sum = 0;
        for (std::size_t i = k; i < end; ++i) sum += force[first + i];
        out.values.push_back(sum / static_cast<double>(end - k));
    }
    return out;
}

Json statistics_document(std::span<const CopyStatistics> statistics) {
    Json out = Json::object();
    for (std::size_t m = 0; m < statistics.size(); ++m)
        out[measure_key(measures[m])] = {{"mean", json_number(statistics[m].mean())},
                                         {"standard_deviation", json_number(statistics[m].standard_deviation())},
                                         {"trials", statistics[m].copies}};
    return out;
}

Json histogram_document(const Histogram& histogram, const TrialGroup& group) {
    Json from = Json::array(), to = Json::array(), trials = Json::array(), rate = Json::array(), error = Json::array();
    for (const auto& bin : histogram.bins) {
        from.push_back(bin.from), to.push_back(bin.to), trials.push_back(bin.rate.copies);
        rate.push_back(json_number(bin.rate.mean())), error.push_back(json_number(bin.standard_error()));
    }
    return {{"label", histogram.label}, {"afferent", group.name}, {"channel", group.channel}, {"from_s", from},
            {"to_s", to},               {"trials", trials},       {"rate_Hz", rate},          {"standard_error_Hz", error}};
}

}  // namespace

Result<std::unique_ptr<TrialCollector>> make_trial_collector(const TrialOptions& options) {
    if (options.table.empty()) return std::make_unique<TrialCollector>(options, std::vector<Trial>());
    auto table = TRY(read_epochs(options.table, options.label));
    auto out = std::make_unique<TrialCollector>(options, std::move(table.trials));
    for (auto& note : table.notes) out->notes.push_back(fmt::format("{}: {}", options.table, note));
    return out;
}

Result<void> TrialCollector::begin(const Input& input) {
    const auto& population = input.population;
    responses.keeps_silent = population.on_channels() != nullptr;
    inputs.push_back(input.name);
    trains_.assign(population.size(), {}), indexes_.clear(), force_.clear();
    for (std::size_t u = 0; u < population.size(); ++u) {
        const auto name = population.afferent_name(u);
        indexes_.push_back(responses.add_afferent(name, channel_of(population, u),
                                                  population.skin() ? population.class_plan(population.class_of(u)).name : name));
    }
    return {};
}

void TrialCollector::add(const Input& input, std::span<const Spike> spikes) {
    for (const auto& s : spikes) trains_[input.afferent_of(s)].push_back(input.clock.time(s.step, s.offset));
}

Result<void> TrialCollector::block(const Input& input, const RunBlock& block) {
    add(input, block.spikes);
    const auto first = force_.size();
    force_.resize(first + block.steps);
    for (const auto& channel : block.force)
        for (std::size_t k = 0; k < block.steps; ++k) force_[first + k] += channel[k];
    return {};
}

std::vector<Trial> TrialCollector::trials_of(const Input& input, double stop, const Contacts& found) const {
    if (!epochs_.empty()) return epochs_;
    std::vector<Trial> out;
    if (!options_.are_contacts)
        return {{input.clock.t0, stop, input.index < input_labels.size() ? input_labels[input.index] : label_of_input(input.name)}};
    for (const auto& c : found.contacts) out.push_back({c.onset, std::min(c.release, stop), "contact"});
    return out;
}

void TrialCollector::add_notes(const Input& input, const Contacts& found, std::span<const AlignedTrial> trials) {
    if (input.input_count > 1 && !options_.are_contacts) {
        if (options_.uses_onsets()) thresholds_.push_back(found.threshold);
    } else if (options_.uses_onsets()) {
        notes.push_back(fmt::format("{}: {} contact{} above {}; level at rest {}, noise {}, release below {}", input.name, found.contacts.size(),
                                    found.contacts.size() == 1 ? "" : "s", format_quantity(found.threshold, "N"),
                                    format_quantity(found.level, "N"), format_quantity(found.noise, "N"), format_quantity(found.release, "N")));
    }
    if (!thresholds_.empty() && input.index + 1 == input.input_count) {
        const auto [low, high] = std::minmax_element(thresholds_.begin(), thresholds_.end());
        notes.push_back(fmt::format("contact onset at {}", *low == *high ? format_quantity(*low, "N")
                                                                         : fmt::format("thresholds from {} to {}", format_quantity(*low, "N"),
                                                                                       format_quantity(*high, "N"))));
    }
    std::vector<std::string> missing;
    for (std::size_t t = 0; t < trials.size(); ++t)
        if (!trials[t].has_zero()) missing.push_back(std::to_string(responses.trials.size() + t + 1));
    const auto count = missing.size();
    if (count > 12) missing.resize(12), missing.push_back("...");
    if (count > 0)
        notes.push_back(fmt::format("{}: {} of {} trials have no contact onset and are left out of means: {}", input.name, count,
                                    trials.size(), joined(missing)));
}

Result<void> TrialCollector::end(const Input& input, std::int64_t samples, std::span<const Spike> last) {
    add(input, last);
    // Spikes that nerve fibres are still conducting arrive after the force.
    const double stop = input.clock.time(last.empty() ? samples : std::max(samples, last.back().step + 1));
    const auto found = options_.uses_onsets() ? find_contacts(force_, input.clock, options_.onset_threshold) : Contacts{};
    const auto trials = trials_of(input, stop, found);
    if (trials.empty())
        return bad_input(fmt::format("no contact in {}: the force never rises above {}; lower it with --onset-threshold, such as "
                                     "--onset-threshold {}",
                                     input.name, format_quantity(found.threshold, "N"),
                                     format_quantity(found.level + (found.threshold - found.level) / 2, "N")));
    const auto onsets = found.onsets();
    auto aligned = align_trials(trials, input.clock.t0, stop, onsets, options_);
    if (!aligned) return bad_input(aligned.error().message, {options_.table, aligned.error().location.line});
    add_notes(input, found, *aligned);
    for (auto& trial : *aligned) trial.input = input.index, forces.push_back(force_of(trial, force_, input.clock));
    responses.add(*aligned, trains_, indexes_);
    trains_.clear(), force_.clear(), force_.shrink_to_fit();
    return {};
}

Json TrialCollector::document(std::optional<double> bin) const {
    const auto& [trials, afferents, groups] = std::tie(responses.trials, responses.afferents, responses.groups);
    Json all = Json::array(), by_label = Json::array();
    for (std::size_t t = 0; t < trials.size(); ++t)
        all.push_back({{"trial", t + 1},
                       {"label", trials[t].label},
                       {"input", inputs[trials[t].input]},
                       {"start_s", trials[t].start},
                       {"stop_s", trials[t].stop},
                       {"zero_s", json_number(trials[t].zero)},
                       {"from_s", json_number(trials[t].from)},
                       {"to_s", json_number(trials[t].to)}});
    for (const auto& row : responses.label_rows()) {
        Json one = {{"label", row.label}, {"afferent", groups[row.group].name}, {"channel", groups[row.group].channel}};
        one.update(statistics_document(row.statistics));
        by_label.push_back(std::move(one));
    }
    Json out = {{"align", options_.uses_onsets() ? "onset" : "start"}, {"trials", all}, {"labels", by_label}, {"notes", notes}};
    if (!bin) return out;
    out["responses"] = Json::array();
    for (const auto& r : responses.responses) {
        Json one = {{"trial", r.trial + 1}, {"afferent", afferents[r.afferent].name}, {"channel", afferents[r.afferent].channel}};
        for (std::size_t m = 0; m < r.values.size(); ++m) one[measure_key(measures[m])] = json_number(r.values[m]);
        one["times_s"] = r.spikes;
        out["responses"].push_back(std::move(one));
    }
    out["bin_s"] = *bin, out["histograms"] = Json::array();
    if (const auto histograms = responses.histograms(*bin, options_.window))
        for (const auto& h : *histograms) out["histograms"].push_back(histogram_document(h, groups[h.group]));
    return out;
}

}  // namespace corpuscle
