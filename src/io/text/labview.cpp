#include "io/text/text_layout.hpp"

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view end_of_header = "***End_of_Header***";

/// Implements read_labview_header(). k is an index in lines_.
class LabviewReader {
    const std::vector<std::string>& lines_;
    std::string path_;
    TextLayout& out_;
    Fields fields_;                   // of the current line
    std::vector<std::string> units_;  // of the channels
    double step_ = 0;                 // s, the sample period (Delta_X)
    bool is_time_axis_ = true;        // true if X_Value is the time
    std::string x_columns_ = "One";   // "One": X_Value is one column; "Multi": each channel has its own; "No": it is empty

    /// Splits line k into fields_.
    void split(std::size_t k) { out_.dialect.split(lines_[k], fields_); }

    /// Reads a line of the header: a name, followed by one value for the file or by one value for each channel.
    void read_entry(std::size_t k) {
        split(k);
        if (fields_.size() < 2) return;
        const auto name = fields_[0];
        if (name == "Decimal_Separator") out_.dialect.decimal_comma = fields_[1] == ",";
        if (name == "X_Columns") x_columns_ = fields_[1];
        if (name == "X_Dimension") is_time_axis_ = fields_[1] == "Time";
        if (name == "Y_Unit_Label") units_.assign(fields_.begin() + 1, fields_.end());
        if (name == "Delta_X") {
            out_.dialect.parse_number(fields_[1], step_);
            has_delta_ = true;
        }
    }
    bool has_delta_ = false;  // true if the header has Delta_X

    /// Reads the line with the names of the columns: X_Value, the channels, and Comment. If every channel has its own X_Value, only the
    /// first X_Value is the time.
    void read_names(std::size_t k) {
        split(k);
        std::size_t channel = 0;  // index of the next channel
        for (const auto name : fields_) {
            Column column{std::string(name), ""};
            if (name == "X_Value") {
                const bool first = out_.columns.empty();
                if (first && x_columns_ != "No")
                    column = {is_time_axis_ ? "time" : "X_Value", is_time_axis_ ? "s" : ""};
                else
                    column.exclusion_reason = x_columns_ == "No" ? "is empty" : "is the clock of another channel";
            } else if (name == "Comment") {
                column.exclusion_reason = "holds comments";
            } else {
                if (channel < units_.size()) column.unit = units_[channel];
                ++channel;
            }
            out_.columns.push_back(std::move(column));
        }
        while (!out_.columns.empty() && out_.columns.back().name.empty()) out_.columns.pop_back();
        if (x_columns_ == "No" && has_delta_ && step_ > 0) out_.rate = 1 / step_;
    }

public:
    LabviewReader(const std::vector<std::string>& lines, std::string path, TextLayout& out)
        : lines_(lines), path_(std::move(path)), out_(out) {}

    Result<std::size_t> read() {
        // The separator follows from the first line, unless an entry "Separator" among the first lines states it.
        out_.dialect = {lines_[0].find(',') != std::string::npos && lines_[0].find('\t') == std::string::npos ? ',' : '\t', false};
        for (std::size_t k = 1; k < std::min<std::size_t>(lines_.size(), 12); ++k)
            if (lines_[k].starts_with("Separator"))
                out_.dialect.separator = lower(lines_[k]).find("comma") != std::string::npos ? ',' : '\t';
        std::size_t ends = 0;  // number of lines ***End_of_Header*** so far: one after the file's header, one after that of the segment
        for (std::size_t k = 1; k < lines_.size(); ++k) {
            if (!trimmed(lines_[k]).starts_with(end_of_header)) {
                read_entry(k);
                continue;
            }
            if (++ends < 2) continue;
            if (k + 1 >= lines_.size()) break;
            read_names(k + 1);
            if (out_.columns.empty()) break;
            return k + 2;
        }
        return bad_input(
            "this LabVIEW file has no table: expected two lines ***End_of_Header***, and the column names in the line after the second one",
            {path_});
    }
};

}  // namespace

bool is_labview(std::string_view first_line) { return first_line.starts_with("LabVIEW Measurement"); }

Result<std::size_t> read_labview_header(const std::vector<std::string>& lines, const std::string& path, TextLayout& out) {
    return LabviewReader(lines, path, out).read();
}

}  // namespace corpuscle
