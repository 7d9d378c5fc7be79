// Merges the rows of one results file into another. In the SQL below, `main` is the file that receives the rows, `source` the other one.

#include <fmt/format.h>
#include <sqlite3.h>
#include <filesystem>

#include "sweep/store/sweep_results.hpp"

namespace corpuscle {
namespace {

constexpr int max_listed = 3;  // items listed in a message about differences

/// The statement that copies the rows that `main` lacks from `source`. `items`: number of items of the sweep.
std::string insertion_of(std::string_view table, const std::string& columns, std::int64_t items) {
    return fmt::format("INSERT INTO main.{0}({1}) SELECT {1} FROM source.{0} WHERE item >= 0 AND item < {2} ON CONFLICT DO NOTHING;", table,
                       columns, items);
}

/// The query for items that both files have, with different results.
std::string select_differing(const ResultsLayout& layout) {
    std::string text = fmt::format("SELECT item FROM main.items i JOIN source.items s USING(item) WHERE ({}) IS NOT ({})",
                                   layout.columns("i."), layout.columns("s."));
    // A spike train or probe differs if the other file has other bytes or no row for it; so both directions are compared.
    for (const auto& [table, index, bytes] : {std::tuple{"spikes", "train", "times"}, std::tuple{"traces", "trace", "samples"}})
        for (const auto& [one, other] : {std::pair{"main", "source"}, std::pair{"source", "main"}})
            text += fmt::format(
                " UNION SELECT item FROM {0}.{2} a WHERE EXISTS(SELECT 1 FROM {1}.items b WHERE b.item = a.item) AND EXISTS(SELECT 1 FROM "
                "{0}.items b WHERE b.item = a.item) AND a.{4} IS NOT (SELECT b.{4} FROM {1}.{2} b WHERE b.item = a.item AND b.{3} = a.{3})",
                one, other, table, index, bytes);
    return text + " ORDER BY item";
}

/// Returns an error if an item has different results in the two files. `from`: path of `source`.
Result<void> check_differences(const sql::Database& file, const ResultsLayout& layout, const std::string& from) {
    auto rows = TRY(file.prepare(select_differing(layout)));
    std::string listed;
    for (int k = 0; k <= max_listed && TRY(rows.step()); ++k)
        listed += k == max_listed ? " ..." : fmt::format("{}{}", k > 0 ? ", " : "", rows.integer(0));
    if (listed.empty()) return {};
    return bad_input(
        fmt::format("the results of item {} differ from those in {}, although the sweep is the same: one of the two was changed or made by "
                    "another program; nothing was merged",
                    listed, file.path),
        {from});
}

}  // namespace

Result<void> SweepResults::check_same_sweep(const SweepResults& other) const {
    for (const auto* results : {this, &other}) TRY(results->check_current_format(results->path()));
    const auto found = difference(*this, other);
    if (found.empty()) return {};
    return bad_input(fmt::format("belongs to another sweep than {}: {}", other.path(), found), {path()});
}

Result<std::int64_t> SweepResults::merge(const SweepResults& from) {
    TRY(from.check_same_sweep(*this));
    std::error_code status;
    if (std::filesystem::equivalent(path(), from.path(), status)) return bad_input("is also the file to merge into", {from.path()});
    TRY(begin_writing());
    auto attach = TRY(file_.prepare("ATTACH ? AS source"));
    if (auto ok = attach.set(1, std::string_view(from.path())).finish(); !ok)
        return Error{ok.error().code, ok.error().message, {from.path()}};
    const auto before = finished_;
    auto ok = check_differences(file_, *this, from.path());
    if (ok) {
        ok = file_.run("BEGIN IMMEDIATE;" + insertion_of("items", columns(), item_count) +
                       insertion_of("spikes", "item, train, times", item_count) +
                       insertion_of("traces", "item, trace, samples", item_count) + "COMMIT");
        if (!ok && !sqlite3_get_autocommit(file_.file.get())) (void)file_.run("ROLLBACK");
    }
    if (ok) ok = count_rows();
    if (auto detached = file_.run("DETACH source"); ok) ok = detached;
    if (!ok) return ok.error();
    return finished_ - before;
}

}  // namespace corpuscle
