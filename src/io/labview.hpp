#pragma once
// LabVIEW measurement files (.lvm): two blocks of names and values, followed by a table.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/dialect.hpp"
#include "io/table.hpp"

namespace corpuscle {

struct LabviewHeader {
    Dialect dialect;
    std::vector<Column> columns;
    std::optional<double> rate = {};  ///< Hz, if the times are not in the table
    std::size_t first_row = 0;        ///< index into the given lines
};

bool is_labview(std::string_view first_line);

/// `lines` are the first lines that are not empty.
Result<LabviewHeader> read_labview_header(const std::vector<std::string>& lines, const std::string& path);

}  // namespace corpuscle
