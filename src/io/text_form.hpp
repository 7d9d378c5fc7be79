#pragma once
// How the table in a file of text lies: where its rows begin, what separates the fields, what the header says. Loggers put lines of
// their own before it, a row of units under the header, the header into a comment.

#include "io/column_roles.hpp"
#include "io/dialect.hpp"
#include "io/lines.hpp"
#include "io/time_stamp.hpp"

namespace corpuscle {

struct TextForm {
    Dialect dialect;
    std::vector<Column> columns;
    ColumnRoles roles;
    std::optional<TimeStamp> first_stamp = {};  ///< of the time, or of the first column that holds some
    std::optional<double> rate = {};            ///< Hz, if the file says it
    std::vector<std::string> remarks = {};
    long first_row = 1;                    ///< its line
    bool named = false;                    ///< by a header
    bool last_may_be_missing = false;      ///< the last field of a row, with its separator
    bool rows_have_names = false;          ///< the first field of each
    std::vector<std::string> first_fields = {};  ///< of the first row
    std::vector<std::size_t> trials = {};  ///< columns that may tell trials apart, the likeliest first
};

/// Reads the head of the file and rewinds it. `skip`: lines that are not looked at. `rows_are_channels`: they may begin with a name.
Result<TextForm> find_text_form(Lines&, std::size_t skip, bool rows_are_channels);

/// A line that is empty or begins with # or %.
inline bool is_comment(std::string_view line) {
    for (const char c : line)
        if (c != ' ' && c != '\t') return c == '#' || c == '%';
    return true;
}

/// Splits as the dialect does; a separator at the end of a line makes no column. `columns`: how many there are to be, 0: not known.
void split_row(const Dialect&, std::string_view line, std::size_t columns, Fields& out);

}  // namespace corpuscle
