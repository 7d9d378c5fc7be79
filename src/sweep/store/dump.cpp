#include <fmt/format.h>
#include <cmath>

#include "core/text/ascii_text.hpp"
#include "core/text/csv_field.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {
namespace {

/// The text of a value: its label if the column has labels, otherwise a number.
std::string value_text(double x, const SweepColumn& column) {
    const auto& labels = column.labels;
    if (!labels.empty() && x >= 0 && x < static_cast<double>(labels.size()) && x == std::floor(x))
        return quote_csv_field(labels[static_cast<std::size_t>(x)]);
    return std::isnan(x) ? "" : fmt::format("{}", x);
}

/// Reads the blobs (arrays of T) of one table, in the order of the items.
template <class T>
class BlobReader {
    sql::Statement rows_;
    bool has_row_ = false;  // false: all rows are read

    Result<void> advance() {
        has_row_ = TRY(rows_.step());
        return {};
    }

public:
    /// Starts a query whose columns are item, index of the train or probe, and blob, sorted by the first two.
    Result<void> begin(const sql::Database& file, const std::string& query) {
        rows_ = TRY(file.prepare(query));
        return advance();
    }

    /// Appends the blobs of an item to the text as `columns` fields; a train or probe without a blob gives an empty field.
    Result<void> append(std::int64_t item, std::size_t columns, std::string& text) {
        while (has_row_ && rows_.integer(0) < item) TRY(advance());
        for (std::size_t k = 0; k < columns; ++k) {
            text += ",";
            if (!has_row_ || rows_.integer(0) != item || rows_.integer(1) != static_cast<std::int64_t>(k)) continue;
            text += fmt::format("{}", fmt::join(rows_.numbers<T>(2), " "));
            TRY(advance());
        }
        return {};
    }
};

std::string header_line(const SweepResults& results) {
    auto text = joined(ResultsLayout::item_columns, ",");
    for (const auto& name : results.stored_column_names) text += "," + quote_csv_field(name);
    for (const auto& name : results.train_names) text += "," + quote_csv_field("spikes of " + name);
    for (const auto& name : results.probe_names) text += "," + quote_csv_field("trace of " + name);
    return text + "\n";
}

}  // namespace

Result<void> dump_results(const SweepResults& results, const std::function<bool(const std::string&)>& put) {
    BlobReader<double> spikes;
    BlobReader<float> probes;
    const auto& file = results.file();
    TRY(file.run("BEGIN"));  // one consistent state, also during a run
    auto ok = spikes.begin(file, "SELECT item, train, times FROM spikes ORDER BY item, train");
    if (ok) ok = probes.begin(file, "SELECT item, trace, samples FROM traces ORDER BY item, trace");
    bool should_continue = ok && put(header_line(results));
    Result<void> row_result;
    if (should_continue)
        row_result = results.for_each_row([&](const std::vector<double>& axes, const ItemOutcome& row) {
            auto text = fmt::format("{},{},{},{},{},{}", row.item, end_name(row.end), row.steps, row.iterations, row.ran_alone ? 1 : 0,
                                    quote_csv_field(row.reason));
            for (std::size_t k = 0; k < axes.size(); ++k) text += "," + value_text(axes[k], results.axes[k]);
            for (std::size_t k = 0; k < row.measures.size(); ++k) text += "," + value_text(row.measures[k], results.measures[k]);
            ok = spikes.append(row.item, results.train_names.size(), text);
            if (ok) ok = probes.append(row.item, results.probe_names.size(), text);
            should_continue = ok && put(text + "\n");
            return should_continue;
        });
    spikes = {}, probes = {};  // ends their queries, before the transaction
    const auto ended = file.run("END");
    return !ok ? ok : !row_result ? row_result : ended;
}

}  // namespace corpuscle
