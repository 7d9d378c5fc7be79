#pragma once
// The rows of a table as they are to be used: absolute values, what is out of range taken out, bad rows refused, dropped or left
// as gaps (NaN).

#include <vector>

#include "io/recording.hpp"

namespace corpuscle {

class Rows {
    Table& table_;
    const RecordingOptions& options_;
    std::vector<std::size_t> columns_;  // channels, then the time if there is one
    std::size_t channels_;
    std::vector<std::size_t> places_;  // in the table's last block, of the rows kept

    bool drops() const { return options_.bad_fields == BadFields::drop; }
    Result<void> take_out(std::size_t rows, std::vector<std::vector<double>>& block);
    std::size_t keep_whole(std::size_t rows, std::vector<std::vector<double>>& block);

public:
    /// With a time column, its readings stand behind the channels'.
    Rows(Table&, const RecordingOptions&, std::vector<std::size_t> channels, std::optional<std::size_t> time);

    /// The next rows, at most `rows_a_block`; none at the end. Every vector of the block is cut to their number.
    Result<std::size_t> next(std::vector<std::vector<double>>& block);

    /// Where row `row` of the last block stands.
    Place place(std::size_t row) const { return table_.place(table_row(row)); }
    /// Its number in the table's last block.
    std::size_t table_row(std::size_t row) const { return drops() ? places_[row] : row; }

    std::int64_t out_of_range = 0, dropped = 0;
};

}  // namespace corpuscle
