#include "sweep/stats/sweep_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/thread_pool.hpp"
#include "sweep/spec/axis.hpp"
#include "sweep/spec/mismatch_samples.hpp"

namespace corpuscle {
namespace {

/// The indexes of the measures with these names, in this order, each once; without names: of all measures.
Result<std::vector<std::size_t>> find_measures(const SweepResults& results, const std::vector<std::string>& names) {
    std::vector<std::size_t> out;
    std::vector<std::string_view> known;
    for (const auto& m : results.measures) known.push_back(m.name);
    for (std::size_t k = 0; names.empty() && k < known.size(); ++k) out.push_back(k);
    for (const auto& name : names) {
        const auto at = std::find(known.begin(), known.end(), name);
        if (at == known.end())
            return bad_usage(fmt::format("--measure {}: unknown measure{} (known: {})", name, did_you_mean(name, known), joined(known)));
        if (const auto k = static_cast<std::size_t>(at - known.begin()); std::find(out.begin(), out.end(), k) == out.end())
            out.push_back(k);
    }
    return out;
}

/// The distinct values of an axis in ascending order. Empty if there are more than `limit` or, unless the axis is known to be listed, more
/// than half the number of rows. `all`: the value in each row.
std::vector<double> few_values(const std::vector<double>& all, bool is_listed, std::size_t limit) {
    std::vector<double> known;
    double last = std::nan("");
    for (const double x : all) {
        if (x == last || std::isnan(x)) continue;
        last = x;
        const auto at = std::lower_bound(known.begin(), known.end(), x);
        if (at != known.end() && *at == x) continue;
        if (known.size() == limit) return {};
        known.insert(at, x);
    }
    return is_listed || 2 * known.size() <= all.size() ? known : std::vector<double>();
}

/// The columns of a range of items.
struct ReadPart {
    std::vector<std::int64_t> items;
    std::vector<ItemEnd> end;
    std::vector<std::vector<double>> columns;  // [column][row]
};

/// Reads the rows of items [from, to). `columns_sql`: names of the columns, separated by commas; `columns`: their number.
Result<ReadPart> read_part(const SweepResults& results, const std::string& columns_sql, std::size_t columns, std::int64_t from,
                           std::int64_t to) {
    auto rows = TRY(results.file().prepare(
        fmt::format("SELECT item, ended, {} FROM items WHERE item >= {} AND item < {} ORDER BY item", columns_sql, from, to)));
    ReadPart out;
    out.columns.resize(columns);
    while (TRY(rows.step())) {
        out.items.push_back(rows.integer(0));
        out.end.push_back(end_of_name(rows.text(1)));
        for (std::size_t k = 0; k < columns; ++k) out.columns[k].push_back(rows.number(static_cast<int>(k) + 2));
    }
    return out;
}

/// Reads all rows; a large table in several parts in parallel, each with its own connection to the file.
Result<std::vector<ReadPart>> read_parts(const SweepResults& results, const std::string& columns_sql, std::size_t columns) {
    constexpr std::int64_t large = 100000;  // rows
    const auto parts = results.finished_count() > large ? std::size_t{4} : std::size_t{1};
    std::vector<ReadPart> out(parts);
    std::vector<std::optional<Error>> errors(parts);
    ThreadPool(parts == 1 ? 1 : 0).for_each(parts, [&](std::size_t k, unsigned) {
        const auto first_item = [&](std::size_t part) {
            return part == parts ? std::numeric_limits<std::int64_t>::max() : results.item_count / 4 * static_cast<std::int64_t>(part);
        };
        const auto connection =  // not needed for one part
            parts == 1 ? Result<SweepResults>(Error{}) : SweepResults::open_read_only(results.path());
        if (parts > 1 && !connection) return void(errors[k] = connection.error());
        auto read = read_part(parts == 1 ? results : *connection, columns_sql, columns, first_item(k), first_item(k + 1));
        read ? void(out[k] = std::move(*read)) : void(errors[k] = read.error());
    });
    for (auto& e : errors)
        if (e) return *e;
    return out;
}

/// The stored text of the sweep file without the lines for options of the command line ("--seed 3").
std::string file_text(const std::string& stored) {
    std::string out;
    for (std::size_t from = 0; from < stored.size();) {
        const auto end = std::min(stored.find('\n', from), stored.size() - 1) + 1;
        if (stored.compare(from, 2, "--") != 0) out += stored.substr(from, end - from);
        from = end;
    }
    return out;
}

}  // namespace

namespace {

Result<sweeps::SweepText> sweep_text_of(const SweepResults& results) {
    const auto stored = results.about("sweep file");  // empty if the sweep was a netlist with .step or .mc, without a sweep file
    return sweeps::read_sweep_text(file_text(stored), results.path());
}

/// For each axis, whether its values are listed. Those of a netlist's .step come first, then those of the sweep file, then those of the
/// process.
std::vector<bool> listed_axes(const SweepResults& results) {
    std::vector<bool> out(results.axes.size());
    const auto text = sweep_text_of(results);
    if (!text) return out;
    std::vector<bool> sampled;  // for each axis of the sweep file
    for (const auto& axis : text->axes())
        if (!sweeps::is_chips_axis(axis)) sampled.push_back(sweeps::is_sampled(axis));
    const auto of_process = static_cast<std::size_t>(
        std::ranges::count_if(results.axes, [](const SweepColumn& axis) { return axis.name.starts_with("process."); }));
    if (sampled.size() + of_process > out.size()) return out;  // a results file that was changed
    const auto steps = out.size() - of_process - sampled.size();
    for (std::size_t a = 0; a < steps + sampled.size(); ++a) out[a] = a < steps || !sampled[a - steps];
    return out;
}

}  // namespace

bool is_deterministic(const SweepResults& results) {
    if (!results.about(mismatch_metadata_name).empty() || results.axes.empty()) return false;
    for (const auto& axis : results.axes)
        if (axis.name.starts_with("process.")) return false;
    const auto text = sweep_text_of(results);
    if (!text) return false;
    const auto axes = text->axes();
    return std::none_of(axes.begin(), axes.end(),
                        [](const ConfigNode& axis) { return sweeps::is_chips_axis(axis) || sweeps::is_sampled(axis); });
}

bool SweepTable::meets_limits(std::size_t row, std::size_t measure) const {
    if (ends[row] != ItemEnd::done) return false;
    const auto& m = measures[measure];
    const double x = measure_values[measure][row];
    return (!m.min || x >= *m.min) && (!m.max || x <= *m.max);
}

bool SweepTable::varies_by_list() const {
    for (std::size_t a = 0; a < is_listed.size(); ++a)
        if (is_listed[a] && std::ranges::adjacent_find(axis_values[a], std::not_equal_to()) != axis_values[a].end()) return true;
    return false;
}

bool SweepTable::has_limits() const {
    return std::ranges::any_of(measures, [](const SweepColumn& m) { return m.min || m.max; });
}

bool SweepTable::passes(std::size_t row) const {
    if (ends[row] != ItemEnd::done) return false;
    for (std::size_t m = 0; m < measures.size(); ++m)
        if (!meets_limits(row, m)) return false;
    return true;
}

Result<SweepTable> read_table(const SweepResults& results, const std::vector<std::string>& measure_names) {
    const auto wanted = TRY(find_measures(results, measure_names));
    SweepTable out;
    out.item_count = results.item_count, out.axes = results.axes;
    std::vector<std::string> columns_sql;
    for (std::size_t k = 0; k < results.axes.size(); ++k) columns_sql.push_back(sql::quoted_name(results.stored_column_names[k]));
    for (const auto m : wanted)
        columns_sql.push_back(sql::quoted_name(results.stored_column_names[results.axes.size() + m])),
            out.measures.push_back(results.measures[m]);
    const auto has_iterations = TRY(results.file().query_integer("SELECT EXISTS(SELECT 1 FROM items WHERE iterations > 0)"));
    if (has_iterations && measure_names.empty()) {
        columns_sql.emplace_back("iterations");
        out.measures.push_back({"iterations", "", "Newton iterations of the circuit"});
    }
    auto parts = TRY(read_parts(results, joined(columns_sql), columns_sql.size()));
    out.axis_values.resize(out.axes.size()), out.measure_values.resize(out.measures.size());
    const auto append = [](auto& all, auto& part) {
        all.empty() ? void(all = std::move(part)) : void(all.insert(all.end(), part.begin(), part.end()));
    };
    for (auto& part : parts) {
        append(out.items, part.items), append(out.ends, part.end);
        for (std::size_t k = 0; k < columns_sql.size(); ++k) {
            append(k < out.axes.size() ? out.axis_values[k] : out.measure_values[k - out.axes.size()], part.columns[k]);
            std::vector<double>().swap(part.columns[k]);
        }
    }
    out.is_grid = is_deterministic(results), out.is_listed = listed_axes(results);
    for (std::size_t a = 0; a < out.axes.size(); ++a)
        out.points.push_back(few_values(out.axis_values[a], out.is_grid || !out.axes[a].labels.empty(),
                                        out.is_grid ? SweepTable::max_grid_points : SweepTable::max_points));
    return out;
}

Result<std::vector<FailedItem>> failed_items(const SweepResults& results, std::size_t limit) {
    auto rows =
        TRY(results.file().prepare(fmt::format("SELECT item, ended, why FROM items WHERE ended <> 'done' ORDER BY item LIMIT {}", limit)));
    std::vector<FailedItem> out;
    while (TRY(rows.step())) out.push_back({rows.integer(0), rows.text(2).empty() ? rows.text(1) : rows.text(2)});
    return out;
}

}  // namespace corpuscle
