#include "io/text/text_layout.hpp"

#include <fmt/format.h>
#include <cctype>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_preamble = 200;               // lines before the table, without comments and empty lines
constexpr std::size_t max_head = std::size_t{1} << 19;  // bytes that are inspected; the limit allows a pipe to be rewound

/// One of the first lines of a file that is neither empty nor a comment.
struct HeadLine {
    long number;  // in the file, counted from 1
    std::string text;
    std::string comment;     // the last comment between this line and the one before, without # or %; "": none
    bool gap_above = false;  // true: the line before this one in the file is empty or a comment
};

/// Reads the first lines of a file that are neither empty nor comments, after the first `skip` lines. Rewinds the file.
Result<std::vector<HeadLine>> read_head(LineReader& lines, std::size_t skip) {
    std::vector<HeadLine> head;
    std::string_view line;
    std::string comment;
    bool gap = false;
    for (std::size_t bytes = 0; head.size() < max_preamble + inspected_rows && bytes < max_head;) {
        if (!TRY(lines.next(line))) break;
        if (lines.line_number() <= static_cast<long>(skip)) continue;
        if (line.find('\0') != line.npos)
            return bad_input("not a text file: it contains NUL bytes, as binary files do", {lines.path(), lines.line_number()});
        if (line.find('\r') != line.npos && line.find('"') == line.npos) {
            const auto command = lines.copy_command("tr '\\r' '\\n'", "-lines");
            return bad_input(fmt::format("the lines end with CR alone, as on old Macs; convert the file to line feeds{}{}",
                                         command.empty() ? "" : ": ", command),
                             {lines.path(), lines.line_number()});
        }
        if (is_comment(line)) {
            if (const auto s = trimmed(line); !s.empty()) comment = trimmed(s.substr(1));
            gap = true;
            continue;
        }
        bytes += line.size();
        head.push_back({lines.line_number(), std::string(line), std::exchange(comment, ""), std::exchange(gap, false)});
    }
    TRY(lines.rewind());
    return head;
}

/// The separator that a first line such as "sep=;" states, which Excel reads; nullopt if the line is a different one.
std::optional<char> named_separator(std::string_view line) {
    while (line.ends_with(' ') && line.size() > 5) line.remove_suffix(1);
    if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
    constexpr std::string_view separators = ",;\t|: ~^/&";
    if (line.size() == 5 && lower(line.substr(0, 4)) == "sep=" && separators.find(line[4]) != separators.npos) return line[4];
    return line.size() == 6 && lower(line.substr(0, 4)) == "sep=" && line.substr(4) == "\\t" ? std::optional('\t') : std::nullopt;
}

/// Implements detect_text_layout(). k is an index in head_. A value is a number or a time stamp.
class LayoutDetector {
    std::vector<HeadLine> head_;
    std::optional<char> separator_;  // stated by a first line "sep=;"
    Fields fields_;                  // of the line that was split last
    TextLayout layout_;
    std::size_t row_ = 0;      // index in head_ of the first row of the table
    std::size_t skipped_ = 0;  // number of lines of head_ before the table and its header

    /// The dialect of a line: with the stated separator, or with the one that Dialect::detect() finds.
    Dialect dialect_of(std::string_view line) const {
        return separator_ ? Dialect{*separator_, *separator_ != ','} : Dialect::detect(line);
    }

    bool is_number(std::string_view field, const Dialect& d) const {
        double value;
        return !field.empty() && d.parse_number(field, value, true);
    }

    bool is_value(std::string_view field, const Dialect& d) const {
        return is_number(field, d) || (!field.empty() && field[0] >= '0' && field[0] <= '9' && (parse_time_stamp(field) || is_date(field)));
    }

    /// For each field of line k, true if it holds a value. Leaves the fields in fields_.
    std::vector<bool> values_in(std::size_t k, const Dialect& d, std::size_t columns = 0) {
        split_row(d, head_[k].text, columns, fields_);
        std::vector<bool> out;
        for (const auto f : fields_) out.push_back(is_value(f, d));
        return out;
    }

    /// True if all lines from `from` to the end of head_ have `columns` fields, and in at least one column each field is a value or empty.
    bool are_rows(std::size_t from, std::size_t columns, const Dialect& d) {
        std::vector<bool> common(columns, true);
        for (std::size_t k = from; k < head_.size(); ++k) {
            const auto values = values_in(k, d, columns);
            if (values.size() != columns) return false;
            for (std::size_t c = 0; c < columns; ++c) common[c] = common[c] && (values[c] || fields_[c].empty());
        }
        return std::find(common.begin(), common.end(), true) != common.end();
    }

    /// True if line k is a row of units: it has `columns` fields, none is a value, and most of those that are not empty are units.
    bool is_unit_row(std::size_t k, std::size_t columns, const Dialect& d) {
        split_row(d, head_[k].text, columns, fields_);
        std::size_t units = 0, others = 0;
        for (auto f : fields_) {
            if (is_value(f, d)) return false;
            if (f.size() > 2 && ((f.front() == '[' && f.back() == ']') || (f.front() == '(' && f.back() == ')')))
                f = f.substr(1, f.size() - 2);
            if (!f.empty() && f != "-") ++(is_unit(f) ? units : others);
        }
        return fields_.size() == columns && units > others;
    }

    /// Defines the columns by the fields of the header.
    void set_header(const Fields& names) {
        for (const auto f : names) layout_.columns.push_back(parse_heading(f));
        layout_.has_header = true;
    }

    /// Takes the units of the columns from line k, which is a row of units with as many fields as there are columns.
    void set_units(std::size_t k) {
        split_row(layout_.dialect, head_[k].text, layout_.columns.size(), fields_);
        for (std::size_t c = 0; c < layout_.columns.size(); ++c) {
            auto f = fields_[c];
            if (f.size() > 2 && (f.front() == '[' || f.front() == '(')) f = f.substr(1, f.size() - 2);
            if (layout_.columns[c].unit.empty() && f != "-") layout_.columns[c].unit = f;
        }
    }

    /// Uses the comment above line k as the header, as numpy.savetxt and rostopic echo -p write it. `columns` is the number of fields of
    /// line k. Returns false if there is no comment, or if it has another number of fields.
    bool use_commented_header(std::size_t k, std::size_t columns) {
        if (head_[k].comment.empty()) return false;
        Fields names;
        dialect_of(head_[k].comment).split(head_[k].comment, names);
        if (names.size() != columns) return false;
        set_header(names);
        return true;
    }

    /// True if line k is a row of the table although it contains words, because the comment above it is the header.
    bool is_row_under_comment(std::size_t k, std::size_t columns) {
        Fields names;
        if (head_[k].comment.empty() || columns < 2) return false;
        const auto d = dialect_of(head_[k].comment);
        d.split(head_[k].comment, names);
        if (names.size() != columns || std::any_of(names.begin(), names.end(), [&](auto f) { return is_value(f, d); })) return false;
        const auto first = values_in(k, layout_.dialect, columns);
        if (std::find(first.begin(), first.end(), true) == first.end()) return false;
        return k + 1 == head_.size() || values_in(k + 1, layout_.dialect, columns) == first;
    }

    /// True for a header of numbers, as pandas writes it for columns without names: the first field, above the index, is empty, and the
    /// others are 0, 1, 2 ...
    static bool are_numbered(const Fields& fields) {
        bool numbered = fields.size() > 1 && fields[0].empty();
        for (std::size_t c = 1; c < fields.size(); ++c) numbered = numbered && fields[c] == std::to_string(c - 1);
        return numbered;
    }

    /// The number of fields in each row if every line of head_ is a row that begins with a word, followed by values; otherwise 0.
    std::size_t field_count_of_named_rows() {
        const auto d = dialect_of(head_[0].text);
        const auto columns = values_in(0, d).size();
        if (columns < 2) return 0;
        for (std::size_t k = 0; k < head_.size(); ++k) {
            const auto values = values_in(k, d, columns);
            if (values.size() != columns || fields_[0].empty() || !std::isalpha(static_cast<unsigned char>(fields_[0][0]))) return 0;
            for (std::size_t c = 0; c < columns; ++c)  // field 0 must not be a value, the others must be values or empty
                if (values[c] == (c == 0) && !(c > 0 && fields_[c].empty())) return 0;
        }
        return columns;
    }

    /// If every row begins with its name and there is no header, sets this layout. Otherwise returns false.
    bool use_named_rows() {
        const auto columns = field_count_of_named_rows();
        if (columns == 0) return false;
        layout_.dialect = dialect_of(head_[0].text);
        layout_.columns.assign(columns, Column{});
        return layout_.has_row_names = true;
    }

    /// True if every row begins with its name, and the first row is named as the time: each row is a channel.
    bool are_rows_channels() {
        const auto d = dialect_of(head_[0].text);
        d.split(head_[0].text, fields_);
        return head_.size() > 1 && is_time_name(parse_heading(fields_[0]).name) && field_count_of_named_rows() > 0;
    }

    /// The common layout: the table begins at the first line, with or without a header.
    struct PlainLayout {
        std::size_t columns = 0;  ///< number of columns
        bool has_header = false;  ///< true: the first line is the header
        bool has_units = false;   ///< true: a row of units follows the header
        bool fits = false;        ///< true: all other lines of head_ are rows of this layout
    };
    /// Determines this layout from the first line, and sets the dialect.
    PlainLayout plain_layout() {
        PlainLayout p;
        layout_.dialect = dialect_of(head_[0].text);
        split_row(layout_.dialect, head_[0].text, 0, fields_);
        p.columns = fields_.size();
        p.has_header = std::any_of(fields_.begin(), fields_.end(), [&](auto f) { return !f.empty() && !is_value(f, layout_.dialect); }) ||
                       (head_.size() > 1 && are_numbered(fields_));
        if (p.has_header && is_row_under_comment(0, p.columns)) p.has_header = false;
        p.has_units = p.has_header && head_.size() > 2 && is_unit_row(1, p.columns, layout_.dialect);
        p.fits = !p.has_header || head_.size() == 1 || are_rows(p.has_units ? 2 : 1, p.columns, layout_.dialect);
        if (!p.has_header && head_.size() > 1) p.fits = are_rows(0, p.columns, layout_.dialect);
        return p;
    }

    /// Sets this layout, with the comment above the first line as the header if it fits.
    void use_plain_layout(const PlainLayout& p) {
        if (p.has_header) {
            split_row(layout_.dialect, head_[0].text, 0, fields_);
            set_header(Fields(fields_));
            row_ = p.has_units ? 2 : 1;
            if (p.has_units) set_units(1);
        } else if (!use_commented_header(0, p.columns)) {
            layout_.columns.assign(p.columns, Column{});
        }
    }

    /// True if line k can be the heading of a table with a single column, "Force N", because it has no separator except blanks.
    bool is_single_heading(std::size_t k) const { return head_[k].text.find_first_of(",;\t") == std::string::npos; }

    /// True if the lines before line k can be a preamble: at most one of them consists of a single value, and none of several values.
    bool may_be_preamble(std::size_t k, const Dialect& plain) {
        std::size_t rows = 0;  // lines of a single value, and twice the lines of several values
        for (std::size_t j = 0; j < k; ++j) {
            const auto values = values_in(j, plain);
            if (std::find(values.begin(), values.end(), false) == values.end()) rows += values.size() > 1 ? 2 : 1;
        }
        return rows < 2;
    }

    /// True if line k is certainly a header with `columns` fields, even if the first line has as many fields: no field is a value, and at
    /// least one may be the name of a time or has a unit.
    bool is_sure_header(std::size_t k, std::size_t columns, const Dialect& d) {
        const auto values = values_in(k, d, columns);
        if (columns < 2 || values.size() != columns || std::find(values.begin(), values.end(), true) != values.end()) return false;
        return std::any_of(fields_.begin(), fields_.end(), [](auto f) {
            const auto heading = parse_heading(f);
            return may_be_time_name(heading.name) || !heading.unit.empty();
        });
    }

    /// Finds the first line from which on all lines are rows, below a header or below a preamble with another number of fields or another
    /// separator. Sets the layout of this table. Returns false if there is no such line.
    bool find_table_after_preamble(const PlainLayout& plain) {
        const auto plain_dialect = layout_.dialect;
        for (std::size_t k = 1; k < std::min(head_.size(), max_preamble); ++k) {
            const auto d = dialect_of(head_[k].text);
            split_row(d, head_[k].text, 0, fields_);
            const auto columns = fields_.size();
            const bool same_shape = columns == plain.columns && d.separator == plain_dialect.separator;
            const auto is_under_header = [&] { return is_sure_header(k - 1, columns, d) || (k > 2 && is_unit_row(k - 1, columns, d)); };
            if ((same_shape && (k < 2 || !is_under_header())) || !are_rows(k, columns, d)) continue;
            if (head_.size() - k < 2 || !may_be_preamble(k, plain_dialect)) continue;
            layout_.dialect = d;
            std::size_t header = k - 1;
            const bool units = k >= 2 && is_unit_row(header, columns, d);
            if (units) --header;
            split_row(d, head_[header].text, columns, fields_);
            const bool is_one_heading = columns == 1 && is_single_heading(header);
            if (fields_.size() == columns || is_one_heading) {
                set_header(is_one_heading ? Fields{trimmed(head_[header].text)} : Fields(fields_));
                if (units) set_units(k - 1);
                skipped_ = header;
            } else if (use_commented_header(k, columns)) {
                skipped_ = k;
            } else if (fields_.size() == 1 || head_[k].gap_above) {
                layout_.columns.assign(columns, Column{});
                skipped_ = k;
            } else {
                continue;
            }
            row_ = k;
            return true;
        }
        layout_.dialect = plain_dialect;
        return false;
    }

    /// Decides whether a single letter at the end of a column's name is a unit. If only one column ends with a letter, C and K are units
    /// (skin_C). If several columns do, the letters distinguish sensors (left_C, left_A).
    void resolve_letter_suffixes() {
        const auto letter_of = [](const Column& c) {
            const auto n = c.name.size();
            return c.unit.empty() && n > 2 && c.name[n - 2] == '_' ? c.name[n - 1] : '\0';
        };
        const auto letters = std::count_if(layout_.columns.begin(), layout_.columns.end(),
                                           [&](const Column& c) { return letter_of(c) >= 'A' && letter_of(c) <= 'Z'; });
        for (auto& c : layout_.columns)
            if (const char letter = letter_of(c); letters == 1 && (letter == 'C' || letter == 'K')) {
                c.unit = letter;
                c.name.resize(c.name.size() - 2);
            }
    }

    /// For each column, the fields of the rows that are inspected.
    std::vector<FirstFields> first_fields() {
        std::vector<FirstFields> first(layout_.columns.size());
        const auto end = std::min(head_.size(), row_ + inspected_rows);
        for (std::size_t k = row_; k < end; ++k) {
            split_row(layout_.dialect, head_[k].text, first.size(), fields_);
            if (layout_.is_last_field_optional && fields_.size() + 1 == first.size()) fields_.emplace_back();
            if (fields_.size() != first.size()) continue;
            for (std::size_t c = 0; c < first.size(); ++c) {
                double value;
                if (fields_[c].empty())
                    first[c].add_other(first[c].empty_count);
                else if (layout_.dialect.parse_number(fields_[c], value, true))
                    first[c].add_number(value);
                else
                    first[c].add_other(parse_time_stamp(fields_[c]) ? first[c].stamp_count : first[c].word_count);
            }
        }
        return first;
    }

    /// Finds the columns that may identify trials: first those with the name of a trial, then those of words.
    void find_trial_columns() {
        const auto add = [&](const auto& matches) {
            for (std::size_t c = 0; c < layout_.columns.size(); ++c)
                if (c != layout_.roles.time_column && matches(layout_.columns[c])) layout_.trial_columns.push_back(c);
        };
        add([](const Column& c) { return is_trial_name(c.name); });
        if (layout_.has_header)
            add([](const Column& c) { return !is_trial_name(c.name) && c.exclusion_reason.starts_with("holds words"); });
    }

    /// Finds the first time stamp of the time column. If this holds no time stamps, that of the first column that does.
    void find_first_stamp() {
        auto column = layout_.roles.time_column;
        for (std::size_t c = 0; !(column && layout_.columns[*column].holds_time_stamps) && c < layout_.columns.size(); ++c)
            if (layout_.columns[c].holds_time_stamps) column = c;
        for (std::size_t k = row_; column && k < head_.size() && !layout_.first_stamp; ++k) {
            split_row(layout_.dialect, head_[k].text, layout_.columns.size(), fields_);
            if (fields_.size() == layout_.columns.size()) layout_.first_stamp = parse_time_stamp(fields_[*column]);
        }
    }

    void note_skipped_lines() {
        if (skipped_ == 0) return;
        const auto first = head_[0].number, last = head_[skipped_ - 1].number;
        layout_.notes.push_back(first == last ? fmt::format("skipped line {} before the table", first)
                                              : fmt::format("skipped lines {} to {} before the table", first, last));
    }

public:
    explicit LayoutDetector(std::vector<HeadLine> head) : head_(std::move(head)) {}

    /// Detects the layout. `path` is the path of the file, for messages; `rows_are_channels` as for detect_text_layout().
    Result<TextLayout> find(const std::string& path, bool rows_are_channels) {
        if (!head_.empty())
            if ((separator_ = named_separator(head_[0].text))) head_.erase(head_.begin());
        if (head_.empty()) return bad_input("no data in this file", {path});
        const auto last = head_.back().number;
        if (is_labview(head_[0].text)) {
            std::vector<std::string> lines;
            for (const auto& h : head_) lines.push_back(h.text);
            row_ = TRY(read_labview_header(lines, path, layout_));
            layout_.has_header = layout_.is_last_field_optional = true;
        } else if (rows_are_channels && use_named_rows()) {
            row_ = 0;
        } else if (!rows_are_channels && are_rows_channels()) {
            return bad_input("every row begins with a name, and the first row is the time; use --transpose to take each row as a channel",
                             {path});
        } else if (const auto plain = plain_layout(); plain.fits || !find_table_after_preamble(plain)) {
            use_plain_layout(plain);
        }
        layout_.first_row_line = row_ < head_.size() ? head_[row_].number : last + 1;
        resolve_letter_suffixes();
        const auto first = first_fields();
        layout_.roles = assign_roles(layout_.columns, first, layout_.has_header);
        if (row_ < head_.size()) {
            split_row(layout_.dialect, head_[row_].text, layout_.columns.size(), fields_);
            layout_.first_fields.assign(fields_.begin(), fields_.end());
        }
        find_first_stamp();
        find_trial_columns();
        note_skipped_lines();
        return std::move(layout_);
    }
};

}  // namespace

void split_row(const Dialect& dialect, std::string_view line, std::size_t columns, Fields& out) {
    dialect.split(line, out);
    if (out.size() > 1 && out.back().empty() && (columns == 0 || out.size() == columns + 1)) out.pop_back();
}

Result<TextLayout> detect_text_layout(LineReader& lines, std::size_t skip, bool rows_are_channels) {
    return LayoutDetector(TRY(read_head(lines, skip))).find(lines.path(), rows_are_channels);
}

}  // namespace corpuscle
