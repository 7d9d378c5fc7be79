#pragma once
// Tables of numbers as text: CSV, TSV, semicolons or blanks, with or without a header, decimal point or comma.

#include "io/heading.hpp"
#include "io/table.hpp"

namespace corpuscle {

/// Lines that are empty or begin with # or % are passed over, and so are lines of another shape before the table. The line above the
/// numbers is the header if it has a field that is no number, a row of units under it, or a comment above them with as many fields.
/// The time is found by its name, its unit or its stamps (column_roles.hpp); without a header it is the first of several columns if it
/// rises by like steps over the first rows.
Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
