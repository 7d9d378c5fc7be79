#pragma once
// Reads the rows of a table: takes absolute values, removes values out of range, and rejects bad rows, drops them or marks them as
// gaps (NaN).

#include <vector>

#include "io/recording.hpp"

namespace corpuscle {

class RowReader {
    Table& table_;
    const RecordingOptions& options_;
    std::vector<std::size_t> columns_;  // the channels, followed by the time column if there is one
    std::size_t channels_;
    std::vector<std::size_t> table_rows_;  // index of each row in the table's last block

    bool drops_rows() const { return options_.bad_fields == BadFields::drop; }
    Result<void> apply_range(std::size_t rows, std::vector<std::vector<double>>& block);
    std::size_t drop_incomplete(std::size_t rows, std::vector<std::vector<double>>& block);

public:
    /// If there is a time column, it follows the channels in each block.
    RowReader(Table&, const RecordingOptions&, std::vector<std::size_t> channels, std::optional<std::size_t> time);

    /// Reads the next rows, at most `rows_per_block`, and resizes the vectors of the block to their number. Returns 0 at the end.
    Result<std::size_t> next(std::vector<std::vector<double>>& block);

    /// The location of row `row` of the last block.
    SourceLocation location(std::size_t row) const { return table_.location(table_row(row)); }
    /// The index of row `row` in the table's last block.
    std::size_t table_row(std::size_t row) const { return drops_rows() ? table_rows_[row] : row; }

    std::int64_t out_of_range = 0, dropped = 0;
};

}  // namespace corpuscle
