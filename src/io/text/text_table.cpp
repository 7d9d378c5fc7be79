#include "io/recording/recording_formats.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/text/ascii_text.hpp"
#include "io/recording/field_advice.hpp"
#include "io/text/json_records.hpp"
#include "io/text/text_layout.hpp"

namespace corpuscle {
namespace {

class TextTable final : public Table {
    LineReader lines_;
    TextLayout layout_;
    Dialect dialect_;
    std::size_t skip_;                   // lines to ignore at the beginning of the file
    bool rows_are_channels_;             // true: --transpose was given
    Fields fields_;                      // of the current line
    std::vector<long> line_numbers_;     // line numbers of the last block's rows
    std::vector<double*> destinations_;  // for each column: the array to which its numbers are written; null: not requested
    std::size_t wanted_end_ = 0;         // one past the last requested column
    double last_stamp_ = 0;              // the latest time of day in the time column, as seconds from the first one
    double days_ = 0;                    // the midnights passed before it, times the length of a day, s
    bool quoted_rows_ = false;           // set by find_trials(): true if a row contains quotes
    bool quoted_separators_ = false;     // set by find_trials(): true if a field contains the separator

    /// An error in the current line; `column` is a position in bytes, counted from 1, 0: not known.
    Error error_at(std::string message, long column = 0) const {
        return bad_input(std::move(message), {lines_.path(), lines_.line_number(), column});
    }

    /// A column for messages: its name, or its number (counted from 1) if the file has no header.
    std::string column_label(std::size_t c) const {
        return layout_.has_header ? fmt::format("'{}'", info_.columns[c].name) : fmt::format("{}", c + 1);
    }

    /// Reads the next line of the table that is a row. Returns false at the end of the file.
    Result<bool> next_row(std::string_view& line) {
        for (;;) {
            const auto more = lines_.next(line);
            if (!more || !*more) return more;
            if (lines_.line_number() >= layout_.first_row_line && !is_comment(line)) return true;
        }
    }

    /// The time stamp in field c of the current line, as seconds from the first one; nullopt if the field is none. In the time column,
    /// times of day without a date continue after midnight.
    std::optional<double> stamp_in(std::size_t c) {
        const auto stamp = parse_time_stamp(fields_[c]);
        if (!stamp || !layout_.first_stamp || stamp->has_date != layout_.first_stamp->has_date) return {};
        double t = seconds_between(*layout_.first_stamp, *stamp) + days_;
        if (stamp->has_date || c != info_.time_column) return t;
        constexpr double day = 86'400;
        if (t < last_stamp_ - day / 2) days_ += day, t += day;
        return last_stamp_ = t;
    }

    /// The end of a message: the options that help with a field in column c that cannot be read.
    std::string remedy(std::size_t c) const {
        const bool first = lines_.line_number() <= layout_.first_row_line;
        if (c == info_.time_column)
            return fmt::format("; use {}--rate, such as --rate 1kHz, to take the rows as evenly spaced, or --time to name another column",
                               first ? "" : "--bad-fields drop to skip the row, ");
        return fmt::format("; use --bad-fields interpolate to fill it in, or --bad-fields drop to skip the row{}",
                           first ? ", or --skip LINES to skip lines before the table" : "");
    }

    /// The number in field c of `line`, whose fields are in fields_.
    Result<double> number_in(std::string_view line, std::size_t c) {
        double value = 0;
        if (info_.columns[c].holds_time_stamps) {
            if (const auto t = stamp_in(c)) return *t;
        } else if (dialect_.parse_number(fields_[c], value)) {
            return value;
        }
        if (allows_gaps_) return std::numeric_limits<double>::quiet_NaN();
        const auto column = fields_[c].data() ? fields_[c].data() - line.data() + 1 : 0;  // in bytes; 0 for a missing optional field
        const auto found = fields_[c].empty() ? std::string("an empty field") : fmt::format("'{}'", fields_[c].substr(0, 40));
        const auto advice = info_.columns[c].holds_time_stamps ? "" : advice_for(fields_[c]);
        return error_at(
            fmt::format("column {}: {} where a {} is expected{}", column_label(c), found,
                        info_.columns[c].holds_time_stamps ? "time" : "number", advice.empty() ? remedy(c) : "; it contains " + advice),
            column);
    }

    /// The unsupported form of a field that should be a number, and how to convert the file. "" if the form is not recognised.
    std::string advice_for(std::string_view field) const {
        const auto advice = advise_on_field(field);
        if (advice.feature.empty()) return "";
        const auto command = advice.filter.empty() ? "" : lines_.copy_command(advice.filter, "-plain");
        if (!command.empty()) return fmt::format("{}; convert the file: {}", advice.feature, command);
        return fmt::format("{}; {}", advice.feature, advice.remedy.empty() ? "save the table without it" : advice.remedy);
    }

    /// Stores Column::exclusion_evidence of the columns that hold words, for the error message if no column holds numbers.
    void store_evidence() {
        constexpr std::size_t max_evidence = 8;  // columns; only one is reported
        std::size_t count = 0;
        for (std::size_t c = 0; c < std::min(info_.columns.size(), layout_.first_fields.size()) && count < max_evidence; ++c) {
            const auto& word = layout_.first_fields[c];
            if (!info_.columns[c].exclusion_reason.starts_with("holds words") || word.empty()) continue;
            ++count;
            const auto advice = advice_for(word);
            info_.columns[c].exclusion_evidence = fmt::format("line {} has '{}'{}{}", layout_.first_row_line, word.substr(0, 40),
                                                              advice.empty() ? "" : ", which contains ", advice);
        }
    }

    /// Splits a row into fields_, with an empty field for a missing optional one.
    void split(std::string_view line) {
        split_row(dialect_, line, info_.columns.size(), fields_);
        if (layout_.is_last_field_optional && fields_.size() + 1 == info_.columns.size()) fields_.emplace_back();
    }

    /// For a table without a header: the first of several columns is the time if it increases over the first rows, each step between 50 %
    /// and 150 % of the mean step.
    Result<void> find_unnamed_time() {
        if (!info_.columns[0].exclusion_reason.empty()) return {};
        std::vector<std::vector<double>> first(1);
        const auto rows = TRY(read({0}, 64, first));
        const auto& t = first[0];
        if (rows >= 3 && info_.columns.size() > 1) {
            const double mean = (t[rows - 1] - t[0]) / static_cast<double>(rows - 1);
            bool even = mean > 0;
            for (std::size_t k = 1; k < rows; ++k) even = even && t[k] > t[k - 1] && std::abs(t[k] - t[k - 1] - mean) < 0.5 * mean;
            if (even) info_.time_column = 0;
        }
        return rewind();
    }

    /// Sets the destinations of the requested columns.
    void set_columns(const std::vector<std::size_t>& wanted, std::vector<std::vector<double>>& out) {
        destinations_.assign(info_.columns.size(), nullptr);
        for (std::size_t i = 0; i < wanted.size(); ++i) destinations_[wanted[i]] = out[i].data();
        wanted_end_ = wanted.empty() ? 0 : *std::max_element(wanted.begin(), wanted.end()) + 1;
    }

    /// True if the rest of a line, from `p` to `end`, has `fields` fields, without quotes and without an empty field at the end.
    bool ends_after(const char* p, const char* end, std::size_t fields) const {
        const auto left = static_cast<std::size_t>(end - p);
        return left > 0 && end[-1] != dialect_.separator && !std::memchr(p, '"', left) &&
               static_cast<std::size_t>(std::count(p, end, dialect_.separator)) + 1 == fields;
    }

    /// Reads the common form of a line fast into row `row` of the destinations. Returns false if the line has another form, which
    /// read_row() reads.
    bool read_plain_row(std::string_view line, std::size_t row) const {
        const char *p = line.data(), *const end = p + line.size();
        const char separator = dialect_.separator;
        for (std::size_t c = 0; c < destinations_.size(); ++c) {
            if (c > 0) {
                if (p == end) return false;
                ++p;
            }
            if (c == wanted_end_ && separator != ' ') return ends_after(p, end, destinations_.size() - c);
            if (!destinations_[c] && separator != ' ') {
                while (p < end && *p != separator && *p != '"') ++p;
                if (p < end && *p == '"') return false;
                continue;
            }
            double value;
            if (!dialect_.parse_plain_number(p, end, value)) return false;
            if (destinations_[c]) destinations_[c][row] = value;
        }
        return p == end;
    }

    /// Reads a line into row `row` of the columns of `out`.
    Result<void> read_row(std::string_view line, std::size_t row, const std::vector<std::size_t>& wanted,
                          std::vector<std::vector<double>>& out) {
        if (read_plain_row(line, row)) return {};
        if (layout_.is_last_field_optional && line.starts_with("Channels")) {  // only LabVIEW files have an optional last field
            const auto command = lines_.copy_command(fmt::format("head -n {}", lines_.line_number() - 1), "-first");
            return error_at(fmt::format("another segment of the measurement begins here, but only one can be read; keep the first{}{}",
                                        command.empty() ? "" : ": ", command));
        }
        split(line);
        if (fields_.size() != info_.columns.size()) {
            if (!allows_gaps_)
                return error_at(fmt::format("{} columns where {} are expected; use --bad-fields drop to skip such rows", fields_.size(),
                                            info_.columns.size()));
            for (auto& column : out) column[row] = std::numeric_limits<double>::quiet_NaN();  // fields cannot be assigned to columns
            return {};
        }
        for (std::size_t i = 0; i < wanted.size(); ++i) out[i][row] = TRY(number_in(line, wanted[i]));
        return {};
    }

    /// A column that identifies trials.
    struct TrialColumn {
        std::size_t column;  ///< its index
        std::string first;   ///< its field in the first row
        bool changes;        ///< true: changes at the row where the time decreases; false: constant up to that row
    };

    /// The columns that distinguish the first trial from the others. Line `trial_line`, where the time decreases, begins another trial.
    /// Reads the rows up to this line again. Empty if no column changes there.
    Result<std::vector<TrialColumn>> find_trials(long trial_line) {
        std::vector<TrialColumn> found;
        if (layout_.trial_columns.empty()) return found;
        TRY(lines_.rewind());
        // The fields of the trial columns in the first row, in the current row, and in the row before it.
        std::vector<std::string> first, current, last;
        std::vector<bool> constant(layout_.trial_columns.size(), true);  // of each trial column, before `trial_line`
        quoted_rows_ = quoted_separators_ = false;
        for (std::string_view line; lines_.line_number() < trial_line;) {
            if (!TRY(next_row(line))) return found;
            split(line);
            if (line.find('"') != line.npos) {
                quoted_rows_ = true;
                const auto inside = [&](auto field) { return field.find(dialect_.separator) != field.npos; };
                quoted_separators_ = quoted_separators_ || std::any_of(fields_.begin(), fields_.end(), inside);
            }
            last = std::move(current);
            current.clear();
            for (const auto c : layout_.trial_columns) current.emplace_back(c < fields_.size() ? fields_[c] : std::string_view());
            if (first.empty()) first = current;
            for (std::size_t k = 0; k < current.size() && lines_.line_number() < trial_line; ++k)
                constant[k] = constant[k] && current[k] == first[k];
        }
        if (last.empty()) return found;
        for (std::size_t k = 0; k < current.size(); ++k) {
            const bool changes = current[k] != last[k];
            if (changes || (constant[k] && is_trial_name(info_.columns[layout_.trial_columns[k]].name)))
                found.push_back({layout_.trial_columns[k], first[k], changes});
        }
        // Keep the most likely one of the columns that change, and the constant columns, because they may change later in the file.
        const auto changing = std::find_if(found.begin(), found.end(), [](const TrialColumn& t) { return t.changes; });
        if (changing == found.end()) return std::vector<TrialColumn>();
        const auto changing_column = changing->column;
        std::erase_if(found, [&](const TrialColumn& t) { return t.changes && t.column != changing_column; });
        return found;
    }

    /// An awk command that keeps the lines before the table and the rows of the first trial. "" if awk could not split or compare the
    /// fields.
    std::string trial_filter(const std::vector<TrialColumn>& trials) const {
        const char separator = dialect_.separator;
        if (std::string_view("\"'\\^]").find(separator) != std::string_view::npos || quoted_separators_) return "";
        std::string wanted;  // the condition for a row of the first trial
        for (const auto& t : trials) {
            // Other characters would need quoting.
            const bool is_safe = !t.first.empty() && std::all_of(t.first.begin(), t.first.end(), [](unsigned char c) {
                return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' || c == '-';
            });
            if (!is_safe && t.changes) return "";
            if (!is_safe) continue;
            double number;
            wanted += fmt::format("{}${}=={}", wanted.empty() ? "" : " && ", t.column + 1,
                                  dialect_.parse_number(t.first, number) ? t.first : "\"" + t.first + "\"");
        }
        const auto fields = separator == ' ' ? "" : separator == '\t' ? " -F'\\t'" : fmt::format(" -F' *[{}] *'", separator);
        // Remove CR, which would be part of the last field, and quotes, which would be part of any field.
        return quoted_rows_ ? fmt::format("awk{} '{{sub(/\\r$/, \"\"); row=$0; gsub(/\"/, \"\")}} NR<{} || ({}) {{print row}}'", fields,
                                          layout_.first_row_line, wanted)
                            : fmt::format("awk{} '{{sub(/\\r$/, \"\")}} NR<{} || ({})'", fields, layout_.first_row_line, wanted);
    }

    /// Names the columns without a name: "time" for the time, otherwise ch1, ch2 ... The numbers count all columns but the time.
    void name_columns() {
        std::size_t number = 0;
        for (std::size_t c = 0; c < info_.columns.size(); ++c) {
            if (info_.time_column == c) {
                if (info_.columns[c].name.empty()) info_.columns[c].name = "time";
                continue;
            }
            ++number;
            if (info_.columns[c].name.empty()) info_.columns[c].name = fmt::format("ch{}", number);
        }
    }

public:
    TextTable(LineReader lines, std::size_t skip, bool rows_are_channels)
        : lines_(std::move(lines)), skip_(skip), rows_are_channels_(rows_are_channels) {}

    Result<void> open() {
        layout_ = TRY(detect_text_layout(lines_, skip_, rows_are_channels_));
        dialect_ = layout_.dialect, info_.columns = layout_.columns, info_.time_column = layout_.roles.time_column;
        info_.is_orientation_known = false;
        info_.rate = layout_.rate, info_.notes = layout_.notes, info_.time_notes = layout_.roles.notes;
        if (!layout_.has_header && !info_.time_column && !layout_.has_row_names) TRY(find_unnamed_time());
        info_.is_time_guessed = info_.time_column && (!layout_.has_header || layout_.roles.is_time_guessed);
        name_columns();
        store_evidence();
        if (info_.time_column && layout_.first_stamp)
            if (const auto& time = info_.columns[*info_.time_column]; time.holds_time_stamps)
                info_.time_notes.push_back(origin_note(*layout_.first_stamp, time.name));
        return {};
    }

    std::string single_trial_advice(std::size_t row) override {
        auto trials = find_trials(location(row).line);
        if (!trials || trials->empty()) return "";
        const auto distinguishing = std::find_if(trials->begin(), trials->end(), [](const TrialColumn& t) { return t.changes; });
        const auto filter = trial_filter(*trials);
        const auto command = filter.empty() ? filter : lines_.copy_command(filter, "-trial1");
        return fmt::format("the file has several trials, identified by '{0}'; 'corpuscle respond' reads all of them with --by {0}; or make a file of {1}{2}",
                           info_.columns[distinguishing->column].name, command.empty() ? "each" : "one: ", command);
    }

    Result<std::vector<std::string>> texts(std::size_t column) override {
        TRY(rewind());
        std::vector<std::string> out;
        std::string_view line;
        while (TRY(next_row(line))) {
            split(line);
            if (fields_.size() != info_.columns.size())
                return error_at(fmt::format("{} columns where {} are expected", fields_.size(), info_.columns.size()));
            if (fields_[column].empty())
                return error_at(fmt::format("column {}: an empty field where the name of a trial is expected", column_label(column)));
            out.emplace_back(fields_[column]);
        }
        return out;
    }

    Result<std::vector<std::string>> row_names() override {
        std::vector<std::string> names;
        if (!layout_.has_row_names) return names;
        std::string_view line;
        while (TRY(next_row(line))) {
            split(line);
            names.emplace_back(fields_.empty() ? std::string_view() : fields_[0]);
        }
        return names;
    }

    double progress() const override { return lines_.progress(); }
    SourceLocation location(std::size_t row) const override { return {lines_.path(), row < line_numbers_.size() ? line_numbers_[row] : 0}; }

    Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) override {
        for (auto& column : out) column.resize(rows);
        line_numbers_.clear();
        set_columns(wanted, out);
        std::size_t row = 0;
        for (std::string_view line; row < rows; ++row) {
            if (!TRY(next_row(line))) break;
            TRY(read_row(line, row, wanted, out));
            line_numbers_.push_back(lines_.line_number());
        }
        return row;
    }

    Result<void> rewind() override {
        last_stamp_ = days_ = 0;
        return lines_.rewind();
    }
};

}  // namespace

Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& options) {
    if (options.dataset) return bad_usage(fmt::format("--dataset {}: a text file has only one table", *options.dataset));
    auto lines = TRY(LineReader::open(path));
    if (TRY(looks_like_json(lines))) return open_json_table(std::move(lines), options.should_continue);
    auto table = std::make_unique<TextTable>(std::move(lines), options.skip_lines, options.transpose == true);
    TRY(table->open());
    return std::unique_ptr<Table>(std::move(table));
}

}  // namespace corpuscle
