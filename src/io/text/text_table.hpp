#pragma once
// Tables of numbers in text files. Fields are separated by commas, tabs, semicolons or blanks; numbers have a decimal point or comma. JSON
// is also read.

#include "io/table/heading.hpp"
#include "io/table/table.hpp"

namespace corpuscle {

/// Skips blank lines, lines that begin with # or %, and a preamble, whose lines differ from rows in their number of fields or their
/// separator. The line above the rows is the header if at least one of its fields is not a number. A row of units may follow it. A comment
/// with as many fields as the rows can also be the header. The time column is found by its name, unit or time stamps (column_roles.hpp).
/// Without a header, the first of several columns is the time if it increases in similar steps over the first rows.
Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
