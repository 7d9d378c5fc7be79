#pragma once
// LabVIEW measurement files (.lvm): two headers of names and values, one of the file and one of its first segment, followed by a table.

#include "io/table/table.hpp"
#include "io/text/dialect.hpp"

namespace corpuscle {

struct LabviewHeader {
    Dialect dialect;
    std::vector<Column> columns;
    std::optional<double> rate = {};  ///< Hz; only if the table has no times
    std::size_t first_row = 0;        ///< index of the table's first row in the lines passed to read_labview_header()
};

/// True if a file with this first line is a LabVIEW measurement file.
bool is_labview(std::string_view first_line);

/// Reads the headers and the column names. `lines` are the first lines of the file that are not empty.
Result<LabviewHeader> read_labview_header(const std::vector<std::string>& lines, const std::string& path);

}  // namespace corpuscle
