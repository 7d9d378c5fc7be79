#pragma once
// Detects the layout of a text table: its first row, separator and header. Loggers write extra lines before the table, a row of units
// under the header, or the header as a comment.

#include "io/column_roles.hpp"
#include "io/dialect.hpp"
#include "io/line_reader.hpp"
#include "io/time_stamp.hpp"

namespace corpuscle {

struct TextLayout {
    Dialect dialect;
    std::vector<Column> columns;
    ColumnRoles roles;
    std::optional<TimeStamp> first_stamp = {};  ///< of the time column, or of the first column with time stamps
    std::optional<double> rate = {};            ///< Hz, if the file contains it
    std::vector<std::string> notes = {};
    long first_row_line = 1;                      ///< line number of the first row
    bool has_header = false;                      ///< the columns are named by a header
    bool is_last_field_optional = false;          ///< the last field of a row and its separator may be missing
    bool has_row_names = false;                   ///< the first field of each row is its name
    std::vector<std::string> first_fields = {};   ///< fields of the first row
    std::vector<std::size_t> trial_columns = {};  ///< columns that may identify trials, the most likely first
};

/// Reads the beginning of the file and rewinds it. Ignores the first `skip` lines. If `rows_are_channels`, rows may begin with a name.
Result<TextLayout> detect_text_layout(LineReader&, std::size_t skip, bool rows_are_channels);

/// True if a line is blank or begins with # or %.
inline bool is_comment(std::string_view line) {
    for (const char c : line)
        if (c != ' ' && c != '\t') return c == '#' || c == '%';
    return true;
}

/// Splits a line into fields. A separator at the end of the line does not add a field. `columns` is the expected number of fields, 0 if
/// unknown.
void split_row(const Dialect&, std::string_view line, std::size_t columns, Fields& out);

}  // namespace corpuscle
