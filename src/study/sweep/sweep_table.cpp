#include "study/sweep/sweep_table.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "signal/field.hpp"
#include "study/sweep/sqlite.hpp"

namespace corpuscle {
namespace {

Result<std::vector<std::size_t>> measures_called(const SweepResults& results, const std::vector<std::string>& names) {
    std::vector<std::size_t> out;
    std::vector<std::string_view> known;
    for (const auto& m : results.measures()) known.push_back(m.name);
    for (std::size_t k = 0; names.empty() && k < known.size(); ++k) out.push_back(k);
    for (const auto& name : names) {
        const auto at = std::find(known.begin(), known.end(), name);
        if (at == known.end())
            return bad_usage(fmt::format("--measure {}: there is no such measure{}; there are {}", name, did_you_mean(name, known), fmt::join(known, ", ")));
        if (const auto k = static_cast<std::size_t>(at - known.begin()); std::find(out.begin(), out.end(), k) == out.end()) out.push_back(k);
    }
    return out;
}

}  // namespace

bool SweepTable::keeps(std::size_t row, std::size_t measure) const {
    if (end[row] != UnitEnd::done) return false;
    const auto& m = measures[measure];
    const double x = measure_values[measure][row];
    return (!m.at_least || x >= *m.at_least) && (!m.at_most || x <= *m.at_most);
}

bool SweepTable::has_limits() const {
    for (std::size_t m = 0; m < measures.size(); ++m)
        if (has_limits(m)) return true;
    return false;
}

bool SweepTable::passes(std::size_t row) const {
    if (end[row] != UnitEnd::done) return false;
    for (std::size_t m = 0; m < measures.size(); ++m)
        if (!keeps(row, m)) return false;
    return true;
}

Result<SweepTable> read_table(const SweepResults& results, const std::vector<std::string>& measures) {
    const auto wanted = measures_called(results, measures);
    if (!wanted) return wanted.error();
    SweepTable out;
    out.units = results.units(), out.axes = results.axes();
    std::string asked = "unit, (ended = 'capped') + 2 * (ended = 'lost')";
    for (std::size_t k = 0; k < results.axes().size(); ++k) asked += ", " + sql::name(results.stored()[k]);
    for (const auto m : *wanted) asked += ", " + sql::name(results.stored()[results.axes().size() + m]), out.measures.push_back(results.measures()[m]);
    const auto works = sql::integer(results.handle(), results.path(), "SELECT EXISTS(SELECT 1 FROM units WHERE iterations > 0)");
    if (!works) return works.error();
    if (*works && measures.empty()) {
        asked += ", iterations";
        out.measures.push_back({"iterations", "", "Newton's, of the circuit"});
    }
    auto rows = sql::Statement::make(results.handle(), results.path(), fmt::format("SELECT {} FROM units ORDER BY unit", asked));
    if (!rows) return rows.error();
    out.axis_values.resize(out.axes.size()), out.measure_values.resize(out.measures.size());
    std::vector<std::vector<double>*> columns;
    for (auto& c : out.axis_values) columns.push_back(&c);
    for (auto& c : out.measure_values) columns.push_back(&c);
    const auto finished = static_cast<std::size_t>(results.finished());
    out.unit.reserve(finished), out.end.reserve(finished);
    for (auto* c : columns) c->reserve(finished);
    for (;;) {
        const auto more = rows->step();
        if (!more) return more.error();
        if (!*more) return out;
        out.unit.push_back(rows->integer(0));
        out.end.push_back(static_cast<UnitEnd>(rows->integer(1)));
        for (std::size_t k = 0; k < columns.size(); ++k) columns[k]->push_back(rows->number(static_cast<int>(k) + 2));
    }
}

Result<std::vector<LostUnit>> lost_units(const SweepResults& results, std::size_t most) {
    auto rows = sql::Statement::make(results.handle(), results.path(),
                                     fmt::format("SELECT unit, ended, why FROM units WHERE ended <> 'done' ORDER BY unit LIMIT {}", most));
    if (!rows) return rows.error();
    std::vector<LostUnit> out;
    for (;;) {
        const auto more = rows->step();
        if (!more) return more.error();
        if (!*more) return out;
        out.push_back({rows->integer(0), rows->text(2).empty() ? rows->text(1) : rows->text(2)});
    }
}

}  // namespace corpuscle
