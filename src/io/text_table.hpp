#pragma once
// Text tables of numbers: CSV, TSV, semicolons or blanks, with or without a header, decimal point or comma.

#include "io/heading.hpp"
#include "io/table.hpp"

namespace corpuscle {

/// Skips blank lines, lines that begin with # or %, and lines of another shape before the table. The line above the numbers is the
/// header if one of its fields is not a number. A row of units may follow it, and a comment with the right number of fields can be the
/// header too. The time column is found by its name, unit or time stamps (column_roles.hpp). Without a header, the first of several
/// columns is the time if it increases in equal steps over the first rows.
Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
