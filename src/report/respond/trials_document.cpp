// The trials of a run for the report page.

#include "report/envelope.hpp"
#include "report/respond/respond_report.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const auto& bins, const auto& value) {
    Json out = Json::array();
    for (const auto& bin : bins) out.push_back(json_number(value(bin)));
    return out;
}

Json histogram_document(const Histogram& histogram) {
    return {{"label", histogram.label},
            {"group", histogram.group},
            {"edges", numbers(histogram.bins, [](const HistogramBin& b) { return b.from; })},
            {"end", histogram.bins.back().to},
            {"trials", numbers(histogram.bins, [](const HistogramBin& b) { return static_cast<double>(b.rate.copies); })},
            {"rate", numbers(histogram.bins, [](const HistogramBin& b) { return b.rate.mean(); })},
            {"error", numbers(histogram.bins, [](const HistogramBin& b) { return b.standard_error(); })}};
}

}  // namespace

Json trials_document(const TrialCollector& collected, double bin) {
    const auto& responses = collected.responses;
    Json trials = Json::array(), groups = Json::array(), spikes = Json::array(), histograms = Json::array();
    for (std::size_t t = 0; t < responses.trials.size(); ++t) {
        const auto& trial = responses.trials[t];
        const auto& force = collected.forces[t];
        trials.push_back({{"label", trial.label},
                          {"input", collected.inputs[trial.input]},
                          {"zero", json_number(trial.zero)},
                          {"from", json_number(trial.from)},
                          {"to", json_number(trial.to)},
                          {"force", {{"from", force.from}, {"step", force.step}, {"values", base64(std::vector<float>(force.values.begin(), force.values.end()))}}}});
    }
    for (const auto& g : responses.groups) groups.push_back({{"name", g.name}, {"channel", g.channel}});
    for (const auto& r : responses.responses)
        if (!r.spikes.empty())
            spikes.push_back({{"trial", r.trial}, {"group", responses.afferents[r.afferent].group}, {"times", base64(r.spikes)}});
    if (const auto all = responses.histograms(bin, collected.options().window))
        for (const auto& h : *all) histograms.push_back(histogram_document(h));
    return {{"onset", collected.options().uses_onsets()}, {"bin", bin},       {"trials", trials},         {"groups", groups},
            {"spikes", spikes},                           {"labels", responses.labels()}, {"histograms", histograms}};
}

}  // namespace corpuscle
