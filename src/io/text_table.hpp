#pragma once
// Tables of numbers as text: CSV, TSV, semicolons or blanks, with or without a header, decimal point or comma.

#include "io/lines.hpp"
#include "io/table.hpp"

namespace corpuscle {

/// Lines that are empty or begin with # or % are passed over. The first line with a field that is no number is the header.
/// A header's unit stands behind the name: "fz_N", "fz [N]", "fz (N)". The time is a column called time, timestamp or t; without
/// a header it is the first of several columns if it rises by like steps over the first rows.
Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& = {});

/// The name and the unit in a header's field.
Column parse_heading(std::string_view field);

/// Is a column of this name the time?
bool names_time(std::string_view name);

}  // namespace corpuscle
