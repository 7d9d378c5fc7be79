#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/columns.hpp"
#include "io/lines.hpp"
#include "io/text_table.hpp"
#include "io/trains.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

struct Field {
    std::string text;
    long column = 1;  // 1-based, in bytes
};

/// A line's fields; quotes may hold separators, and a doubled quote is one. False if a quote is left open.
bool split(std::string_view line, char separator, std::vector<Field>& out) {
    out.clear();
    for (std::size_t at = 0;;) {
        const auto begin = std::min(line.find_first_not_of(separator == '\t' ? " " : " \t", at), line.size());
        Field field{"", static_cast<long>(begin) + 1};
        auto end = std::min(line.find(separator, at), line.size());
        if (begin < line.size() && line[begin] == '"') {
            bool open = true;
            std::size_t k = begin + 1;
            for (; open && k < line.size(); ++k) {
                if (line[k] == '"' && !line.substr(k).starts_with("\"\"")) {
                    open = false;
                } else {
                    field.text += line[k];
                    k += line[k] == '"';
                }
            }
            if (open) return out.push_back(std::move(field)), false;
            end = std::min(line.find(separator, k), line.size());
        } else {
            field.text = trimmed(line.substr(at, end - at));
        }
        out.push_back(std::move(field));
        if (end == line.size()) return true;
        at = end + 1;
    }
}

/// A table of text with a row a spike.
class TextSpikes {
    Lines lines_;
    char separator_ = ',';
    std::vector<Field> fields_;
    std::optional<std::size_t> time_, afferent_, channel_;
    std::size_t columns_ = 0;
    double seconds_ = 1;  // that one unit of the time column is
    Trains trains_;

    Error at(std::string sentence, long column = 0) const {
        return bad_input(std::move(sentence), {lines_.path(), lines_.number(), column});
    }

    /// The next line that is not empty or a comment, in fields.
    Result<bool> next() {
        std::string_view line;
        for (;;) {
            const auto more = lines_.next(line);
            if (!more || !*more) return more;
            const auto plain = trimmed(line);
            if (!plain.empty() && plain.front() != '#' && plain.front() != '%') break;
        }
        if (columns_ == 0) separator_ = line.find('\t') != line.npos ? '\t' : line.find(';') != line.npos ? ';' : ',';
        if (!split(line, separator_, fields_)) return at("a quote that is opened here does not end", fields_.back().column);
        return true;
    }

    Result<void> read_header() {
        columns_ = fields_.size();
        for (std::size_t c = 0; c < columns_; ++c) {
            const auto heading = parse_heading(fields_[c].text);
            const auto name = lower(heading.name);
            if (!time_ && (name == "time" || name == "times" || name == "t" || name == "timestamp" || name == "spike_time")) {
                const auto seconds = seconds_per_unit(heading, {}, lines_.path());
                if (!seconds) return at(fmt::format("'{}' is no unit of time; write s, ms, us or min", heading.unit), fields_[c].column);
                time_ = c, seconds_ = *seconds;
            }
            if (name == "afferent" || (name == "unit" && !afferent_)) afferent_ = c;
            if (name == "channel") channel_ = c;
        }
        if (time_ && (afferent_ || channel_ || columns_ == 1)) return {};
        std::vector<std::string> names;
        for (const auto& f : fields_) names.push_back("'" + f.text.substr(0, 40) + "'");
        if (names.size() > 12) names.resize(12), names.push_back("...");
        const auto wanted = time_ ? "that says whose each spike is; one is to be called unit, afferent or channel"
                                  : "of spike times; one is to be called time_s (or time, t [ms] ...)";
        return at(fmt::format("no column {}; there are {}", wanted, fmt::join(names, ", ")));
    }

    Result<void> add_row() {
        if (fields_.size() != columns_) return at(fmt::format("{} columns where {} should be", fields_.size(), columns_));
        const auto& [text, column] = fields_[*time_];
        double t = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), t);
        if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(t * seconds_))
            return at(fmt::format("'{}' where a time should be", text.substr(0, 40)), column);
        const auto word = [this](const std::optional<std::size_t>& c) { return c ? fields_[*c].text : std::string(); };
        trains_.of(word(afferent_), word(channel_)).push_back(t * seconds_);
        return {};
    }

public:
    explicit TextSpikes(Lines lines) : lines_(std::move(lines)) {}

    Result<std::vector<NamedTrain>> read() {
        const auto header = next();
        if (!header) return header.error();
        if (!*header) return bad_input("no header and no spikes in this file", {lines_.path()});
        if (auto ok = read_header(); !ok) return ok.error();
        for (;;) {
            const auto more = next();
            if (!more) return more.error();
            if (!*more) return std::move(trains_).in_order();
            if (auto ok = add_row(); !ok) return ok.error();
        }
    }
};

}  // namespace

Result<std::vector<NamedTrain>> read_text_spikes(const std::string& path) {
    auto lines = Lines::open(path);
    if (!lines) return lines.error();
    return TextSpikes(std::move(*lines)).read();
}

}  // namespace corpuscle
