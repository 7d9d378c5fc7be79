#include "study/sweep/sweep_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "signal/field.hpp"
#include "signal/pool.hpp"
#include "study/sweep/grid.hpp"
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
            return bad_usage(fmt::format("--measure {}: there is no such measure{}; there are {}", name, did_you_mean(name, known),
                                         fmt::join(known, ", ")));
        if (const auto k = static_cast<std::size_t>(at - known.begin()); std::find(out.begin(), out.end(), k) == out.end())
            out.push_back(k);
    }
    return out;
}

/// An axis's values in rising order, if they are few; else nothing.
std::vector<double> few_values(const std::vector<double>& all, bool listed, std::size_t most) {
    std::vector<double> known;
    double last = std::nan("");
    for (const double x : all) {
        if (x == last || std::isnan(x)) continue;
        last = x;
        const auto at = std::lower_bound(known.begin(), known.end(), x);
        if (at != known.end() && *at == x) continue;
        if (known.size() == most) return {};
        known.insert(at, x);
    }
    return listed || 2 * known.size() <= all.size() ? known : std::vector<double>();
}

/// What is read of each row, in the order of the columns asked for.
struct ReadPart {
    std::vector<std::int64_t> unit;
    std::vector<UnitEnd> end;
    std::vector<std::vector<double>> columns;
};

/// The rows of units [from, to).
Result<ReadPart> read_part(const SweepResults& results, const std::string& asked, std::size_t columns, std::int64_t from, std::int64_t to) {
    auto rows = sql::Statement::make(
        results.handle(), results.path(),
        fmt::format("SELECT unit, ended, {} FROM units WHERE unit >= {} AND unit < {} ORDER BY unit", asked, from, to));
    if (!rows) return rows.error();
    ReadPart out;
    out.columns.resize(columns);
    for (;;) {
        const auto more = rows->step();
        if (!more) return more.error();
        if (!*more) return out;
        out.unit.push_back(rows->integer(0));
        const auto ended = rows->text(1);
        out.end.push_back(ended == "done" ? UnitEnd::done : ended == "capped" ? UnitEnd::capped : UnitEnd::lost);
        for (std::size_t k = 0; k < columns; ++k) out.columns[k].push_back(rows->number(static_cast<int>(k) + 2));
    }
}

/// Large tables in several parts at once, each by a connection of its own.
Result<std::vector<ReadPart>> read_parts(const SweepResults& results, const std::string& asked, std::size_t columns) {
    constexpr std::int64_t large = 100000;
    const auto parts = results.finished() > large ? std::size_t{4} : std::size_t{1};
    std::vector<ReadPart> out(parts);
    std::vector<std::optional<Error>> errors(parts);
    Pool(parts == 1 ? 1 : 0).each(parts, [&](std::size_t k, unsigned) {
        const auto at = [&](std::size_t part) {
            return part == parts ? std::numeric_limits<std::int64_t>::max() : results.units() / 4 * static_cast<std::int64_t>(part);
        };
        const auto own = parts == 1 ? Result<SweepResults>(Error{}) : SweepResults::look(results.path());
        if (parts > 1 && !own) return void(errors[k] = own.error());
        auto read = read_part(parts == 1 ? results : *own, asked, columns, at(k), at(k + 1));
        read ? void(out[k] = std::move(*read)) : void(errors[k] = read.error());
    });
    for (auto& e : errors)
        if (e) return *e;
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
    std::vector<std::string> asked;
    for (std::size_t k = 0; k < results.axes().size(); ++k) asked.push_back(sql::name(results.stored()[k]));
    for (const auto m : *wanted)
        asked.push_back(sql::name(results.stored()[results.axes().size() + m])), out.measures.push_back(results.measures()[m]);
    const auto works = sql::integer(results.handle(), results.path(), "SELECT EXISTS(SELECT 1 FROM units WHERE iterations > 0)");
    if (!works) return works.error();
    if (*works && measures.empty()) {
        asked.emplace_back("iterations");
        out.measures.push_back({"iterations", "", "Newton's, of the circuit"});
    }
    auto parts = read_parts(results, fmt::format("{}", fmt::join(asked, ", ")), asked.size());
    if (!parts) return parts.error();
    out.axis_values.resize(out.axes.size()), out.measure_values.resize(out.measures.size());
    const auto put = [](auto& all, auto& part) {
        all.empty() ? void(all = std::move(part)) : void(all.insert(all.end(), part.begin(), part.end()));
    };
    for (auto& part : *parts) {
        put(out.unit, part.unit), put(out.end, part.end);
        for (std::size_t k = 0; k < asked.size(); ++k) {
            put(k < out.axes.size() ? out.axis_values[k] : out.measure_values[k - out.axes.size()], part.columns[k]);
            std::vector<double>().swap(part.columns[k]);
        }
    }
    out.is_grid = draws_nothing(results);
    for (std::size_t a = 0; a < out.axes.size(); ++a)
        out.points.push_back(few_values(out.axis_values[a], out.is_grid || !out.axes[a].words.empty(),
                                        out.is_grid ? SweepTable::most_levels : SweepTable::most_points));
    return out;
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
