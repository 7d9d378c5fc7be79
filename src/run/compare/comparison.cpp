#include "run/compare/comparison.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text/aligned_table.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json document_of(const TrainDifference& d) {
    // Shifts exist only if spikes match.
    const auto seconds = [&](double x) { return d.matched > 0 ? Json(x) : Json(nullptr); };
    return {{"spikes_a", d.spikes_a},
            {"spikes_b", d.spikes_b},
            {"matched", d.matched},
            {"missing", d.missing()},
            {"extra", d.extra()},
            {"max_shift_s", seconds(d.max_shift)},
            {"rms_shift_s", seconds(d.rms())},
            {"victor_purpura", d.victor_purpura},
            {"victor_purpura_per_spike", d.victor_purpura_per_spike()},
            {"van_rossum", d.van_rossum()}};
}

std::vector<std::string> line_of(const TrainDifference& d, const std::string& a, const std::string& b) {
    const auto milliseconds = [&](double x) { return d.matched > 0 ? fmt::format("{:.3f}", 1e3 * x) : "-"; };
    return table_row(a, b, d.spikes_a, d.spikes_b, d.matched, d.missing(), d.extra(), milliseconds(d.max_shift), milliseconds(d.rms()),
                     fmt::format("{:.2f}", d.victor_purpura), fmt::format("{:.3f}", d.victor_purpura_per_spike()),
                     fmt::format("{:.2f}", d.van_rossum()));
}

}  // namespace

Json document_of(const CompareOptions& options, const TrainDifferences& differences) {
    Json out = {{"window_s", options.window}, {"cost_Hz", options.cost}, {"tau_s", options.tau}};
    out["pairs"] = Json::array();
    for (const auto& d : differences.pairs) {
        Json row = {{"a", d.a}, {"b", d.b}};
        row.update(document_of(d));
        out["pairs"].push_back(std::move(row));
    }
    out["total"] = document_of(differences.total);
    return out;
}

std::string comparison_table(const CompareOptions& options, const TrainDifferences& differences) {
    TableRows rows = {
        {"A", "B", "in A", "in B", "matched", "missing", "extra", "max (ms)", "RMS (ms)", "Victor-Purpura", "per spike", "van Rossum"}};
    const auto shown = [](const std::string& name) { return name.empty() ? "-" : name; };
    for (const auto& d : differences.pairs) rows.push_back(line_of(d, shown(d.a), shown(d.b)));
    if (differences.pairs.size() > 1) rows.push_back(line_of(differences.total, "total", ""));
    return format_table(rows) + fmt::format("Matching window {}; Victor-Purpura cost {:g} per second; van Rossum time constant {}.\n",
                                            format_quantity(options.window, "s"), options.cost, format_quantity(options.tau, "s"));
}

Result<std::pair<std::vector<NamedTrain>, std::vector<NamedTrain>>> read_both(const std::string& a, const std::string& b,
                                                                              const SpikeColumns& columns) {
    auto first = read_spikes(a, columns), second = read_spikes(b, columns);
    const bool has_columns = columns.time || columns.train;
    if (has_columns && !first && second)
        if (auto with_defaults = read_spikes(a)) first = std::move(with_defaults);
    if (has_columns && first && !second)
        if (auto with_defaults = read_spikes(b)) second = std::move(with_defaults);
    if (!first) return first.error();
    if (!second) return second.error();
    return std::pair(std::move(*first), std::move(*second));
}

Result<TrainDifferences> compare_all(const std::vector<NamedTrain>& a, const std::vector<NamedTrain>& b, const CompareOptions& options,
                                     const std::function<bool(double)>& should_continue) {
    TrainDifferences out;
    const auto pairs = TRY(pair_trains(a, b, options));
    for (const auto& pair : pairs) {
        if (!should_continue(static_cast<double>(out.pairs.size()) / static_cast<double>(pairs.size()))) return interrupted_error();
        out.pairs.push_back(TRY(compare_trains(pair, options)));
        out.total.add(out.pairs.back());
    }
    return out;
}

}  // namespace corpuscle
