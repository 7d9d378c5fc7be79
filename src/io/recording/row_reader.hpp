#pragma once
// Reads the rows of a table as the options require: takes absolute values, and treats values that are not numbers or are outside --range.
// Such a value is an error, or its row is dropped, or it becomes a gap (NaN).

#include <vector>

#include "io/recording/recording.hpp"

namespace corpuscle {

class RowReader {
    Table& table_;
    const RecordingOptions& options_;
    std::vector<std::size_t> columns_;     // the channels, followed by the time column if there is one
    std::size_t channels_;                 // number of channels
    std::vector<std::size_t> table_rows_;  // if rows are dropped: for each row of the last block, its index in the block before dropping

    bool drops_rows() const { return options_.bad_fields == BadFields::drop; }
    Result<void> apply_range(std::size_t rows, std::vector<std::vector<double>>& block);
    std::size_t drop_incomplete(std::size_t rows, std::vector<std::vector<double>>& block);

public:
    /// `channels` and `time` are indices of columns of the table. In each block the time column, if there is one, follows the channels.
    RowReader(Table&, const RecordingOptions&, std::vector<std::size_t> channels, std::optional<std::size_t> time);

    /// Reads the next rows, at most `rows_per_block`, into one vector for each column, and resizes the vectors to the number of rows.
    /// Returns this number; 0 at the end of the table.
    Result<std::size_t> next(std::vector<std::vector<double>>& block);

    /// The location in the file of row `row` of the last block.
    SourceLocation location(std::size_t row) const { return table_.location(table_row(row)); }
    /// The index that row `row` of the last block had before rows were dropped.
    std::size_t table_row(std::size_t row) const { return drops_rows() ? table_rows_[row] : row; }

    std::int64_t out_of_range = 0, dropped = 0;  ///< numbers so far: of values outside --range, and of dropped rows
};

}  // namespace corpuscle
