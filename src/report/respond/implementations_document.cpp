#include <algorithm>

#include "report/respond/respond_report.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;
using Count = ImplementationComparison::PhaseCount;

/// The names of the phases of all inputs, each once, in order of first occurrence.
std::vector<std::string> phases_of(const ImplementationComparisons& comparisons) {
    std::vector<std::string> all;
    for (const auto& c : comparisons.rows)
        for (const auto& p : c.phases)
            if (std::find(all.begin(), all.end(), p.phase) == all.end()) all.push_back(p.phase);
    return all;
}

/// The first cells of a row: afferent, channel, spike count in total and in each phase. `count` selects the counts of the compared
/// implementation or of the reference. Null for a phase that this input does not have.
Json counts_row(const ImplementationComparison& c, const std::string& afferent, const std::vector<std::string>& phases,
                std::size_t Count::* count) {
    Json row = {afferent, c.channel, c.total.*count};
    for (const auto& phase : phases) {
        const auto p = std::find_if(c.phases.begin(), c.phases.end(), [&](const Count& one) { return one.phase == phase; });
        row.push_back(p == c.phases.end() ? Json(nullptr) : Json((*p).*count));
    }
    return row;
}

/// The complete row of an implementation that is compared with the reference.
Json row_document(const ImplementationComparison& c, const std::vector<std::string>& phases) {
    auto row = counts_row(c, c.afferent, phases, &Count::spikes);
    row.push_back(json_number(100 * c.total.excess()));
    row.push_back(c.matched);
    for (const double x : {1e3 * c.mean_shift, 1e3 * c.median_shift, c.victor_purpura, c.van_rossum}) row.push_back(json_number(x));
    return row;
}

}  // namespace

Json implementations_document(const ImplementationComparisons& comparisons) {
    const auto phases = phases_of(comparisons);
    Json columns = {"afferent", "channel", "spikes"}, decimals = {nullptr, nullptr, 0}, rows = Json::array();
    for (const auto& p : phases) columns.push_back(p), decimals.push_back(0);
    for (const auto& [name, places] : {std::pair{"change (%)", 1},
                                       {"matched", 0},
                                       {"mean shift (ms)", 2},
                                       {"median shift (ms)", 2},
                                       {"Victor-Purpura", 2},
                                       {"van Rossum", 2}})
        columns.push_back(name), decimals.push_back(places);
    const ImplementationComparison* last = nullptr;  // of the previous row; comparisons with one reference on one channel are adjacent
    for (const auto& c : comparisons.rows) {
        if (!last || last->reference != c.reference || last->channel != c.channel) {
            rows.push_back(counts_row(c, c.reference, phases, &Count::reference_spikes));
            while (rows.back().size() < columns.size()) rows.back().push_back(nullptr);
        }
        rows.push_back(row_document(c, phases));
        last = &c;
    }
    return {{"columns", columns},
            {"decimals", decimals},
            {"rows", rows},
            {"cost", ImplementationComparisons::cost},
            {"tau", ImplementationComparisons::tau}};
}

}  // namespace corpuscle
