#pragma once
// Detects the layout of a text table: its first row, separator and header. Data loggers write other lines before the table (a preamble), a
// row of units below the header, or the header as a comment.

#include "io/table/heading.hpp"
#include "io/text/dialect.hpp"
#include "io/text/line_reader.hpp"
#include "io/text/time_stamp.hpp"

namespace corpuscle {

struct TextLayout {
    Dialect dialect;
    std::vector<Column> columns;
    ColumnRoles roles;
    std::optional<TimeStamp> first_stamp = {};    ///< of the time column, or of the first column with time stamps
    std::optional<double> rate = {};              ///< sample rate, Hz; nullopt: the file does not state it
    std::vector<std::string> notes = {};          ///< notes for the user about skipped lines
    long first_row_line = 1;                      ///< line number of the first row of numbers, counted from 1
    bool has_header = false;                      ///< true: a header names the columns
    bool is_last_field_optional = false;          ///< true: the last field of a row and its separator may be missing
    bool has_row_names = false;                   ///< true: the first field of each row is the name of the row
    std::vector<std::string> first_fields = {};   ///< fields of the first row
    std::vector<std::size_t> trial_columns = {};  ///< indices of columns that may identify trials, the most likely first
};

/// Reads the beginning of the file and rewinds it. Ignores the first `skip` lines. If `rows_are_channels`, each row may begin with the name
/// of its channel.
Result<TextLayout> detect_text_layout(LineReader&, std::size_t skip, bool rows_are_channels);

/// True if a file with this first line is a LabVIEW measurement file (.lvm). It has two headers of names and values, one of the file and
/// one of its first segment, followed by a table.
bool is_labview(std::string_view first_line);

/// Reads the headers and the column names of a LabVIEW file. `lines` are the first lines of the file that are not empty. Sets dialect,
/// columns and rate (only if the table has no times) in `out`. Returns the index in `lines` of the table's first row.
Result<std::size_t> read_labview_header(const std::vector<std::string>& lines, const std::string& path, TextLayout& out);

/// True if a line is blank, or if its first character that is not a blank is # or %.
inline bool is_comment(std::string_view line) {
    for (const char c : line)
        if (c != ' ' && c != '\t') return c == '#' || c == '%';
    return true;
}

/// Splits a line into fields. `columns` is the expected number of fields; 0: not known. An empty field after a separator at the end of the
/// line is removed if `columns` is 0, or if it is one too many.
void split_row(const Dialect&, std::string_view line, std::size_t columns, Fields& out);

}  // namespace corpuscle
