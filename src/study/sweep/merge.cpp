// Rows of one file of results into another.

#include <fmt/format.h>
#include <sqlite3.h>
#include <filesystem>

#include "study/sweep/results_held.hpp"

namespace corpuscle {
namespace {

constexpr int most_named = 3;  // units of which a message says that they differ

/// "u.ended, u.steps, ..."
std::string all_columns(const std::string& table, const ResultsLayout& layout) {
    std::string out;
    for (const char* name : {"ended", "steps", "iterations", "alone", "why"})
        out += fmt::format("{}{}.{}", out.empty() ? "" : ", ", table, name);
    for (const auto& name : layout.stored) out += fmt::format(", {}.{}", table, sql::name(name));
    return out;
}

std::string unit_columns(const ResultsLayout& layout) {
    std::string out = "unit, ended, steps, iterations, alone, why";
    for (const auto& name : layout.stored) out += ", " + sql::name(name);
    return out;
}

/// The rows of the other file's units that this one lacks; of units that the sweep has.
std::string taking(std::string_view table, const std::string& columns, std::int64_t units) {
    return fmt::format("INSERT INTO main.{0}({1}) SELECT {1} FROM source.{0} WHERE unit >= 0 AND unit < {2} ON CONFLICT DO NOTHING;", table,
                       columns, units);
}

/// Units that both have, and not the same.
std::string differing(const ResultsLayout& layout) {
    std::string text = fmt::format("SELECT unit FROM main.units u JOIN source.units s USING(unit) WHERE ({}) IS NOT ({})",
                                   all_columns("u", layout), all_columns("s", layout));
    for (const auto& [table, number, bytes] : {std::tuple{"spikes", "train", "times"}, std::tuple{"traces", "trace", "samples"}})
        for (const auto& [one, other] : {std::pair{"main", "source"}, std::pair{"source", "main"}})
            text += fmt::format(
                " UNION SELECT unit FROM {0}.{2} a WHERE EXISTS(SELECT 1 FROM {1}.units b WHERE b.unit = a.unit) AND EXISTS(SELECT 1 FROM "
                "{0}.units b WHERE b.unit = a.unit) AND a.{4} IS NOT (SELECT b.{4} FROM {1}.{2} b WHERE b.unit = a.unit AND b.{3} = a.{3})",
                one, other, table, number, bytes);
    return text + " ORDER BY unit";
}

Result<void> refuse_differing(sqlite3* file, const ResultsLayout& layout, const std::string& path, const std::string& from) {
    auto rows = sql::Statement::make(file, path, differing(layout));
    if (!rows) return rows.error();
    std::string named;
    for (int k = 0;; ++k) {
        const auto more = rows->step();
        if (!more) return more.error();
        if (!*more) break;
        if (k == most_named) {
            named += " ...";
            break;
        }
        named += fmt::format("{}{}", named.empty() ? "" : ", ", rows->integer(0));
    }
    if (named.empty()) return {};
    return bad_input(fmt::format("of unit {} it has other results than {}: the same sweep, and yet one of the two was changed or made by "
                                 "another program; nothing of it was taken",
                                 named, path),
                     {from});
}

}  // namespace

Result<void> SweepResults::same_sweep(const SweepResults& as) const {
    const auto difference = held_->layout.differs_from(as.held_->layout);
    if (difference.empty()) return {};
    return bad_input(fmt::format("is of another sweep than {}: {}", as.path(), difference), {path()});
}

Result<std::int64_t> SweepResults::take(const SweepResults& from) {
    auto& held = *held_;
    if (auto same = from.same_sweep(*this); !same) return same.error();
    std::error_code none;
    if (std::filesystem::equivalent(path(), from.path(), none)) return bad_input("is the file that is merged into", {from.path()});
    if (auto ok = held.begin_writing(); !ok) return ok.error();
    auto* file = held.file.get();
    auto attach = sql::Statement::make(file, path(), "ATTACH ? AS source");
    if (!attach) return attach.error();
    if (auto ok = attach->set(1, std::string_view(from.path())).finish(); !ok)
        return Error{ok.error().code, ok.error().sentence, {from.path()}};
    const auto before = held.finished;
    auto ok = refuse_differing(file, held.layout, path(), from.path());
    if (ok) {
        ok = sql::run(file, path(),
                      "BEGIN IMMEDIATE;" + taking("units", unit_columns(held.layout), units()) +
                          taking("spikes", "unit, train, times", units()) + taking("traces", "unit, trace, samples", units()) + "COMMIT");
        if (!ok && !sqlite3_get_autocommit(file)) (void)sql::run(file, path(), "ROLLBACK");
    }
    if (ok) {
        const auto rows = sql::integer(file, path(), "SELECT count(*) FROM main.units");
        rows ? void(held.finished = *rows) : void(ok = rows.error());
    }
    if (auto detached = sql::run(file, path(), "DETACH source"); ok) ok = detached;
    if (!ok) return ok.error();
    return held.finished - before;
}

}  // namespace corpuscle
