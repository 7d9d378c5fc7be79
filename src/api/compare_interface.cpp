#include "corpuscle/compare.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/result.hpp"
#include "core/text/printable.hpp"
#include "run/compare/comparison.hpp"

namespace corpuscle {
namespace {

using api::value_or_throw;

std::vector<NamedTrain> named(const std::vector<SpikeTrain>& trains) {
    std::vector<NamedTrain> out;
    for (const auto& t : trains) {
        const auto where = [&] { return t.afferent.empty() ? std::string("a train") : "train " + t.afferent; };
        if (!std::ranges::all_of(t.times, [](double x) { return std::isfinite(x); }))
            throw InputError(where() + ": a spike time is not a finite number");
        out.push_back({t.afferent, t.channel, t.times});
        std::ranges::sort(out.back().times);
    }
    return out;
}

void check_above_zero(double value, const char* name, const char* unit) {
    if (!(value > 0 && std::isfinite(value))) throw InputError(fmt::format("{} = {:g} {} must be above 0", name, value, unit));
}

CompareOptions options_of(const ComparisonSettings& settings) {
    check_above_zero(settings.window, "window", "s");
    check_above_zero(settings.tau, "tau", "s");
    if (!(settings.cost >= 0 && std::isfinite(settings.cost)))
        throw InputError(fmt::format("cost = {:g} Hz must be 0 or more", settings.cost));
    return {settings.pairs, settings.by_order, settings.window, settings.cost, settings.tau};
}

TrainComparison comparison_of(const TrainDifference& d) {
    const auto of_matched = [&](double x) { return d.matched > 0 ? x : NAN; };
    return {d.a,
            d.b,
            d.spikes_a,
            d.spikes_b,
            d.matched,
            d.missing(),
            d.extra(),
            of_matched(d.max_shift),
            of_matched(d.rms()),
            d.victor_purpura,
            d.victor_purpura_per_spike(),
            d.van_rossum()};
}

Comparison compare_named(const std::vector<NamedTrain>& a, const std::vector<NamedTrain>& b, const ComparisonSettings& settings) {
    const auto options = options_of(settings);
    const auto go_on = [&](double fraction) { return !settings.progress || settings.progress(fraction); };
    const auto differences = value_or_throw(compare_all(a, b, options, go_on));
    Comparison out;
    for (const auto& pair : differences.pairs) out.pairs.push_back(comparison_of(pair));
    out.total = comparison_of(differences.total);
    out.text = comparison_table(options, differences);
    out.document = json_text(document_of(options, differences));
    return out;
}

}  // namespace

std::vector<SpikeTrain> trains_of(const Response& response) {
    std::vector<SpikeTrain> out;
    for (const auto& afferent : response.afferents) out.push_back({afferent.name, afferent.channel, {}});
    for (std::size_t k = 0; k < response.times.size(); ++k) out[response.indices[k]].times.push_back(response.times[k]);
    return out;
}

Comparison compare(const std::vector<SpikeTrain>& a, const std::vector<SpikeTrain>& b, const ComparisonSettings& settings) {
    return compare_named(named(a), named(b), settings);
}

Comparison compare_files(const std::string& a, const std::string& b, const ComparisonSettings& settings) {
    const auto files = value_or_throw(read_both(a, b, {}));
    return compare_named(files.first, files.second, settings);
}

}  // namespace corpuscle
