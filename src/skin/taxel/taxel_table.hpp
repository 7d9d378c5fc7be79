#pragma once
// The table of a layout of taxels: its columns, with their units, and the numbers in its current row.

#include <array>

#include "io/text/named_columns.hpp"

namespace corpuscle {

enum class TaxelColumn {
    name,
    channel,
    x,
    y,
    area,
    width,
    height,
    patch,
    region,
    patch_x,
    patch_y,
    rotation,
    dead,
    x_axis,
    y_axis,
    z_axis
};
inline constexpr std::size_t taxel_column_count = 16;

class TaxelTable {
    using enum TaxelColumn;

    NamedColumns table_;
    std::array<std::optional<std::size_t>, taxel_column_count> columns_ = {};  // index of each column in the table
    std::array<double, taxel_column_count> factors_ = {};                      // units of the columns, in m, m2 or degrees

    std::size_t index(TaxelColumn c) const { return *columns_[static_cast<std::size_t>(c)]; }
    Result<double> factor_of(TaxelColumn, std::size_t field) const;
    Result<void> read_heading(std::size_t field);
    Result<void> check_columns() const;

public:
    explicit TaxelTable(LineReader lines) : table_(std::move(lines)) {}
    /// Reads the header. Unknown columns, columns without a unit, and combinations that say nothing are errors.
    Result<void> read_header();
    /// Reads the next row. Returns false at the end.
    Result<bool> next();

    const std::string& path() const { return table_.path(); }
    bool has(TaxelColumn c) const { return columns_[static_cast<std::size_t>(c)].has_value(); }
    /// The field in the current row; "" without the column.
    std::string_view text(TaxelColumn c) const;
    /// The number in the current row, in m, m2 or degrees; nullopt if the column does not exist or the field is empty. A magnitude above
    /// `limit` is an error.
    Result<std::optional<double>> number(TaxelColumn, double limit) const;
    /// The same for a column that needs a number in every row.
    Result<double> required(TaxelColumn, double limit) const;

    /// An error at this column in the current row.
    Error error_at(std::string message, TaxelColumn c) const { return table_.error_at(std::move(message), index(c)); }
    Error error_at(std::string message) const { return table_.error_at(std::move(message)); }
    long line() const { return table_.error_at("").location.line; }  ///< number of the current line
};

}  // namespace corpuscle
