#pragma once
// Tables as text.

#include <fmt/format.h>
#include <string>
#include <vector>

namespace corpuscle {

/// The rows of a table, each with its cells.
using TableRows = std::vector<std::vector<std::string>>;

/// Formats rows as a table: columns are padded to their widest cell, columns of numbers are aligned right, others left. If `has_heading`,
/// the first row is the heading. In a table wider than 100 columns the heading is wrapped; if it is still too wide, the table is split into
/// blocks.
std::string format_table(const TableRows& rows, bool has_heading = true);

/// A row of a table.
template <class... T>
std::vector<std::string> table_row(const T&... cells) {
    return {fmt::format("{}", cells)...};
}

}  // namespace corpuscle
