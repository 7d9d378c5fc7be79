#include "io/text_form.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/labview.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t most_preamble = 200;               // lines that are no comments
constexpr std::size_t most_head = std::size_t{1} << 19;  // bytes of them: what a pipe can give twice

struct HeadLine {
    long number;
    std::string text;
    std::string comment;     // the last before it, without its mark
    bool gap_above = false;  // an empty line or a comment
};

/// The first lines of a file that are neither empty nor comments.
Result<std::vector<HeadLine>> read_head(Lines& lines, std::size_t skip) {
    std::vector<HeadLine> head;
    std::string_view line;
    std::string comment;
    bool gap = false;
    for (std::size_t bytes = 0; head.size() < most_preamble + rows_looked_at && bytes < most_head;) {
        const auto more = lines.next(line);
        if (!more) return more.error();
        if (!*more) break;
        if (lines.number() <= static_cast<long>(skip)) continue;
        if (line.find('\0') != line.npos)
            return bad_input("this is no text: it has NUL bytes, as binary files have", {lines.path(), lines.number()});
        if (line.find('\r') != line.npos && line.find('"') == line.npos) {
            const auto command = lines.copy_command("tr '\\r' '\\n'", "-lines");
            return bad_input(fmt::format("its lines end in a way that only old Macs know (CR alone); make a file of it with line feeds{}{}",
                                         command.empty() ? "" : ": ", command),
                             {lines.path(), lines.number()});
        }
        if (is_comment(line)) {
            if (const auto s = trimmed(line); !s.empty()) comment = trimmed(s.substr(1));
            gap = true;
            continue;
        }
        bytes += line.size();
        head.push_back({lines.number(), std::string(line), std::exchange(comment, ""), std::exchange(gap, false)});
    }
    if (auto ok = lines.rewind(); !ok) return ok.error();
    return head;
}

/// Excel's first line: "sep=;" names the separator.
std::optional<char> named_separator(std::string_view line) {
    while (line.ends_with(' ') && line.size() > 5) line.remove_suffix(1);
    if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
    constexpr std::string_view separators = ",;\t|: ~^/&";
    if (line.size() == 5 && lower(line.substr(0, 4)) == "sep=" && separators.find(line[4]) != separators.npos) return line[4];
    return line.size() == 6 && lower(line.substr(0, 4)) == "sep=" && line.substr(4) == "\\t" ? std::optional('\t') : std::nullopt;
}

class FormFinder {
    std::vector<HeadLine> head_;
    std::optional<char> separator_;
    Fields fields_;
    TextForm form_;
    std::size_t row_ = 0, passed_over_ = 0;  // of head_: the first row of the table; lines before its header

    Dialect dialect_of(std::string_view line) const { return separator_ ? Dialect{*separator_, *separator_ != ','} : Dialect::of(line); }

    bool is_number(std::string_view field, const Dialect& d) const {
        double value;
        return !field.empty() && d.number(field, value, true);
    }

    bool is_value(std::string_view field, const Dialect& d) const {
        return is_number(field, d) || (!field.empty() && field[0] >= '0' && field[0] <= '9' && (parse_time_stamp(field) || is_date(field)));
    }

    /// Which fields of a line hold values.
    std::vector<bool> values_in(std::size_t k, const Dialect& d, std::size_t columns = 0) {
        split_row(d, head_[k].text, columns, fields_);
        std::vector<bool> out;
        for (const auto f : fields_) out.push_back(is_value(f, d));
        return out;
    }

    /// Are the lines from `from` to the end of the head rows of so many fields, with values in one column at least throughout?
    bool are_rows(std::size_t from, std::size_t columns, const Dialect& d) {
        std::vector<bool> common(columns, true);
        for (std::size_t k = from; k < head_.size(); ++k) {
            const auto values = values_in(k, d, columns);
            if (values.size() != columns) return false;
            for (std::size_t c = 0; c < columns; ++c) common[c] = common[c] && (values[c] || fields_[c].empty());
        }
        return std::find(common.begin(), common.end(), true) != common.end();
    }

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

    void take_header(const Fields& names) {
        for (const auto f : names) form_.columns.push_back(parse_heading(f));
        form_.named = true;
    }

    void take_units(std::size_t k) {
        split_row(form_.dialect, head_[k].text, form_.columns.size(), fields_);
        for (std::size_t c = 0; c < form_.columns.size(); ++c) {
            auto f = fields_[c];
            if (f.size() > 2 && (f.front() == '[' || f.front() == '(')) f = f.substr(1, f.size() - 2);
            if (form_.columns[c].unit.empty() && f != "-") form_.columns[c].unit = f;
        }
    }

    /// numpy's savetxt, rostopic echo -p and others write the header as a comment. `columns`: of the row under it.
    bool take_commented_header(std::size_t k, std::size_t columns) {
        if (head_[k].comment.empty()) return false;
        Fields names;
        dialect_of(head_[k].comment).split(head_[k].comment, names);
        if (names.size() != columns) return false;
        take_header(names);
        return true;
    }

    /// Is the first line a row, though it holds words, because a comment above it is the header?
    bool is_row_under_comment(std::size_t k, std::size_t columns) {
        Fields names;
        if (head_[k].comment.empty() || columns < 2) return false;
        const auto d = dialect_of(head_[k].comment);
        d.split(head_[k].comment, names);
        if (names.size() != columns || std::any_of(names.begin(), names.end(), [&](auto f) { return is_value(f, d); })) return false;
        const auto first = values_in(k, form_.dialect, columns);
        if (std::find(first.begin(), first.end(), true) == first.end()) return false;
        return k + 1 == head_.size() || values_in(k + 1, form_.dialect, columns) == first;
    }

    /// A header of numbers, as pandas writes it for columns without names: nothing above the index, then 0, 1, 2 ...
    static bool are_numbered(const Fields& fields) {
        bool numbered = fields.size() > 1 && fields[0].empty();
        for (std::size_t c = 1; c < fields.size(); ++c) numbered = numbered && fields[c] == std::to_string(c - 1);
        return numbered;
    }

    /// A word and then values in every row: how many fields each has; 0: it is not so.
    std::size_t fields_of_named_rows() {
        const auto d = dialect_of(head_[0].text);
        const auto columns = values_in(0, d).size();
        if (columns < 2) return 0;
        for (std::size_t k = 0; k < head_.size(); ++k) {
            const auto values = values_in(k, d, columns);
            if (values.size() != columns || fields_[0].empty() || !std::isalpha(static_cast<unsigned char>(fields_[0][0]))) return 0;
            for (std::size_t c = 0; c < columns; ++c)
                if (values[c] == (c == 0) && !(c > 0 && fields_[c].empty())) return 0;
        }
        return columns;
    }

    /// Rows that begin with their names, and no header.
    bool take_named_rows() {
        const auto columns = fields_of_named_rows();
        if (columns == 0) return false;
        form_.dialect = dialect_of(head_[0].text);
        form_.columns.assign(columns, Column{});
        return form_.rows_have_names = true;
    }

    /// A row of times that says so, and channels as rows under it.
    bool are_rows_channels() {
        const auto d = dialect_of(head_[0].text);
        d.split(head_[0].text, fields_);
        return head_.size() > 1 && names_time(parse_heading(fields_[0]).name) && fields_of_named_rows() > 0;
    }

    /// The table as most files have it: from the first line on, with a header or none.
    struct Plain {
        std::size_t columns = 0;
        bool header = false, units = false, whole = false;
    };
    Plain plain_form() {
        Plain p;
        form_.dialect = dialect_of(head_[0].text);
        split_row(form_.dialect, head_[0].text, 0, fields_);
        p.columns = fields_.size();
        p.header = std::any_of(fields_.begin(), fields_.end(), [&](auto f) { return !f.empty() && !is_value(f, form_.dialect); }) ||
                   (head_.size() > 1 && are_numbered(fields_));
        if (p.header && is_row_under_comment(0, p.columns)) p.header = false;
        p.units = p.header && head_.size() > 2 && is_unit_row(1, p.columns, form_.dialect);
        p.whole = !p.header || head_.size() == 1 || are_rows(p.units ? 2 : 1, p.columns, form_.dialect);
        if (!p.header && head_.size() > 1) p.whole = are_rows(0, p.columns, form_.dialect);
        return p;
    }

    void take_plain(const Plain& p) {
        if (p.header) {
            split_row(form_.dialect, head_[0].text, 0, fields_);
            take_header(Fields(fields_));
            row_ = p.units ? 2 : 1;
            if (p.units) take_units(1);
        } else if (!take_commented_header(0, p.columns)) {
            form_.columns.assign(p.columns, Column{});
        }
    }

    /// A header as a whole line above a single column: "Force N".
    bool is_single_heading(std::size_t k) const { return head_[k].text.find_first_of(",;\t") == std::string::npos; }

    /// May the lines before `k` stand before a table, none of them rows of one?
    bool may_stand_before(std::size_t k, const Dialect& plain) {
        std::size_t rows = 0;
        for (std::size_t j = 0; j < k; ++j) {
            const auto values = values_in(j, plain);
            if (std::find(values.begin(), values.end(), false) == values.end()) rows += values.size() > 1 ? 2 : 1;
        }
        return rows < 2;
    }

    /// Is a line the header of a table though the first line has as many fields: words throughout, with a time or a unit?
    bool is_sure_header(std::size_t k, std::size_t columns, const Dialect& d) {
        const auto values = values_in(k, d, columns);
        if (columns < 2 || values.size() != columns || std::find(values.begin(), values.end(), true) != values.end()) return false;
        return std::any_of(fields_.begin(), fields_.end(), [](auto f) {
            const auto heading = parse_heading(f);
            return may_name_time(heading.name) || !heading.unit.empty();
        });
    }

    /// The first line from which all that follows is rows, under a header or a preamble of other shape; false if there is none.
    bool take_after_preamble(const Plain& plain) {
        const auto plain_dialect = form_.dialect;
        for (std::size_t k = 1; k < std::min(head_.size(), most_preamble); ++k) {
            const auto d = dialect_of(head_[k].text);
            split_row(d, head_[k].text, 0, fields_);
            const auto columns = fields_.size();
            const bool alike = columns == plain.columns && d.separator == plain_dialect.separator;
            const auto is_under_header = [&] { return is_sure_header(k - 1, columns, d) || (k > 2 && is_unit_row(k - 1, columns, d)); };
            if ((alike && (k < 2 || !is_under_header())) || !are_rows(k, columns, d)) continue;
            if (head_.size() - k < 2 || !may_stand_before(k, plain_dialect)) continue;
            form_.dialect = d;
            std::size_t header = k - 1;
            const bool units = k >= 2 && is_unit_row(header, columns, d);
            if (units) --header;
            split_row(d, head_[header].text, columns, fields_);
            const bool whole_line = columns == 1 && is_single_heading(header);
            if (fields_.size() == columns || whole_line) {
                take_header(whole_line ? Fields{trimmed(head_[header].text)} : Fields(fields_));
                if (units) take_units(k - 1);
                passed_over_ = header;
            } else if (take_commented_header(k, columns)) {
                passed_over_ = k;
            } else if (fields_.size() == 1 || head_[k].gap_above) {
                form_.columns.assign(columns, Column{});
                passed_over_ = k;
            } else {
                continue;
            }
            row_ = k;
            return true;
        }
        form_.dialect = plain_dialect;
        return false;
    }

    /// Letters behind a name that more often tell sensors apart: a lone one is a unit (skin_C), several are names (left_C, left_A).
    void settle_letters() {
        const auto letter_of = [](const Column& c) {
            const auto n = c.name.size();
            return c.unit.empty() && n > 2 && c.name[n - 2] == '_' ? c.name[n - 1] : '\0';
        };
        const auto letters = std::count_if(form_.columns.begin(), form_.columns.end(),
                                           [&](const Column& c) { return letter_of(c) >= 'A' && letter_of(c) <= 'Z'; });
        for (auto& c : form_.columns)
            if (const char letter = letter_of(c); letters == 1 && (letter == 'C' || letter == 'K')) {
                c.unit = letter;
                c.name.resize(c.name.size() - 2);
            }
    }

    std::vector<FirstFields> first_fields() {
        std::vector<FirstFields> first(form_.columns.size());
        const auto end = std::min(head_.size(), row_ + rows_looked_at);
        for (std::size_t k = row_; k < end; ++k) {
            split_row(form_.dialect, head_[k].text, first.size(), fields_);
            if (form_.last_may_be_missing && fields_.size() + 1 == first.size()) fields_.emplace_back();
            if (fields_.size() != first.size()) continue;
            for (std::size_t c = 0; c < first.size(); ++c) {
                double value;
                if (fields_[c].empty())
                    first[c].add_other(first[c].nothing);
                else if (form_.dialect.number(fields_[c], value, true))
                    first[c].add_number(value);
                else
                    first[c].add_other(parse_time_stamp(fields_[c]) ? first[c].stamps : first[c].words);
            }
        }
        return first;
    }

    void find_trial_columns() {
        const auto add = [&](const auto& suits) {
            for (std::size_t c = 0; c < form_.columns.size(); ++c)
                if (c != form_.roles.time && suits(form_.columns[c])) form_.trials.push_back(c);
        };
        add([](const Column& c) { return names_trial(c.name); });
        if (form_.named) add([](const Column& c) { return !names_trial(c.name) && c.left_out.starts_with("holds words"); });
    }

    void find_first_stamp() {
        auto column = form_.roles.time;
        for (std::size_t c = 0; !(column && form_.columns[*column].stamps) && c < form_.columns.size(); ++c)
            if (form_.columns[c].stamps) column = c;
        for (std::size_t k = row_; column && k < head_.size() && !form_.first_stamp; ++k) {
            split_row(form_.dialect, head_[k].text, form_.columns.size(), fields_);
            if (fields_.size() == form_.columns.size()) form_.first_stamp = parse_time_stamp(fields_[*column]);
        }
    }

    void tell_passed_over() {
        if (passed_over_ == 0) return;
        const auto first = head_[0].number, last = head_[passed_over_ - 1].number;
        form_.remarks.push_back(first == last ? fmt::format("line {} stands before the table and was passed over", first)
                                              : fmt::format("lines {} to {} stand before the table and were passed over", first, last));
    }

public:
    explicit FormFinder(std::vector<HeadLine> head) : head_(std::move(head)) {}

    Result<TextForm> find(const std::string& path, bool rows_are_channels) {
        if (!head_.empty())
            if ((separator_ = named_separator(head_[0].text))) head_.erase(head_.begin());
        if (head_.empty()) return bad_input("no data in this file", {path});
        const auto last = head_.back().number;
        if (is_labview(head_[0].text)) {
            std::vector<std::string> lines;
            for (const auto& h : head_) lines.push_back(h.text);
            auto labview = read_labview_head(lines, path);
            if (!labview) return labview.error();
            form_.dialect = labview->dialect, form_.columns = std::move(labview->columns), form_.rate = labview->rate;
            form_.named = form_.last_may_be_missing = true;
            row_ = labview->first_row;
        } else if (rows_are_channels && take_named_rows()) {
            row_ = 0;
        } else if (!rows_are_channels && are_rows_channels()) {
            return bad_input("every row begins with a name, the first with that of the time; --transpose takes each row as a channel",
                             {path});
        } else if (const auto plain = plain_form(); plain.whole || !take_after_preamble(plain)) {
            take_plain(plain);
        }
        form_.first_row = row_ < head_.size() ? head_[row_].number : last + 1;
        settle_letters();
        const auto first = first_fields();
        const auto rate = form_.rate;
        form_.roles = assign_roles(form_.columns, first, form_.named);
        if (rate) form_.rate = rate;
        if (row_ < head_.size()) {
            split_row(form_.dialect, head_[row_].text, form_.columns.size(), fields_);
            form_.first_fields.assign(fields_.begin(), fields_.end());
        }
        find_first_stamp();
        find_trial_columns();
        tell_passed_over();
        return std::move(form_);
    }
};

}  // namespace

void split_row(const Dialect& dialect, std::string_view line, std::size_t columns, Fields& out) {
    dialect.split(line, out);
    if (out.size() > 1 && out.back().empty() && (columns == 0 || out.size() == columns + 1)) out.pop_back();
}

Result<TextForm> find_text_form(Lines& lines, std::size_t skip, bool rows_are_channels) {
    auto head = read_head(lines, skip);
    if (!head) return head.error();
    return FormFinder(std::move(*head)).find(lines.path(), rows_are_channels);
}

}  // namespace corpuscle
