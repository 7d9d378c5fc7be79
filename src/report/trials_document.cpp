#include "report/trials_document.hpp"

#include <set>

#include "report/envelope.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const auto& bins, const auto& value) {
    Json out = Json::array();
    for (const auto& bin : bins) out.push_back(json_number(value(bin)));
    return out;
}

/// `group`: the index of its group in the document.
Json histogram_document(const Histogram& histogram, std::size_t group) {
    return {{"label", histogram.label},
            {"group", group},
            {"edges", numbers(histogram.bins, [](const HistogramBin& b) { return b.from; })},
            {"end", histogram.bins.back().to},
            {"trials", numbers(histogram.bins, [](const HistogramBin& b) { return static_cast<double>(b.rate.copies); })},
            {"rate", numbers(histogram.bins, [](const HistogramBin& b) { return b.rate.mean(); })},
            {"error", numbers(histogram.bins, [](const HistogramBin& b) { return b.standard_error(); })}};
}

/// The trials, and what holds for the whole document.
Json common_document(const TrialCollector& collected, double bin) {
    const auto& responses = collected.responses;
    Json trials = Json::array();
    for (std::size_t t = 0; t < responses.trials.size(); ++t) {
        const auto& trial = responses.trials[t];
        const auto& force = collected.forces[t];
        const std::vector<float> values(force.values.begin(), force.values.end());
        trials.push_back({{"label", trial.label},
                          {"input", collected.inputs[trial.input]},
                          {"zero", json_number(trial.zero)},
                          {"from", json_number(trial.from)},
                          {"to", json_number(trial.to)},
                          {"force", {{"from", force.from}, {"step", force.step}, {"values", array_document(values)}}}});
    }
    return {{"onset", collected.options().uses_onsets()},
            {"bin", bin},
            {"trials", trials},
            {"labels", responses.labels()},
            {"groups", Json::array()},
            {"histograms", Json::array()}};
}

/// Appends groups, and the histograms of all labels of each. `is_shown`: for each group.
void append_groups(Json& out, std::span<const TrialGroup> groups, const Result<std::vector<Histogram>>& histograms,
                   const std::vector<bool>& is_shown) {
    std::vector<std::size_t> index(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!is_shown[g]) continue;
        index[g] = out["groups"].size();
        out["groups"].push_back({{"name", groups[g].name}, {"channel", groups[g].channel}, {"afferents", groups[g].afferents}});
    }
    if (!histograms) return;
    for (const auto& h : *histograms)
        if (is_shown[h.group]) out["histograms"].push_back(histogram_document(h, index[h.group]));
}

/// For each group, whether any afferent on its channel fired in a trial.
std::vector<bool> fired_channels(const TrialResponses& responses) {
    std::set<std::string_view> fired;
    for (const auto& r : responses.responses)
        if (!r.spikes.empty()) fired.insert(responses.groups[responses.afferents[r.afferent].group].channel);
    std::vector<bool> out;
    for (const auto& g : responses.groups) out.push_back(fired.contains(g.channel));
    return out;
}

}  // namespace

Json trials_document(const TrialCollector& collected, double bin) {
    const auto& responses = collected.responses;
    auto out = common_document(collected, bin);
    append_groups(out, responses.groups, responses.histograms(bin, collected.options().window), std::vector(responses.groups.size(), true));
    out["spikes"] = Json::array();
    for (const auto& r : responses.responses)
        if (!r.spikes.empty())
            out["spikes"].push_back(
                {{"trial", r.trial}, {"group", responses.afferents[r.afferent].group}, {"times", array_document(r.spikes)}});
    return out;
}

Json skin_trials_document(const TrialCollector& collected, double bin) {
    const auto& responses = collected.responses;
    const auto& window = collected.options().window;
    auto out = common_document(collected, bin);
    const auto classes = responses.groups_by_name();
    out["classes"] = classes.groups.size();
    append_groups(out, classes.groups, responses.histograms(bin, window, classes), std::vector(classes.groups.size(), true));
    append_groups(out, responses.groups, responses.histograms(bin, window), fired_channels(responses));
    return out;
}

}  // namespace corpuscle
