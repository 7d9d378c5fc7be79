#include "run/trials/epoch_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "core/text/quantity.hpp"
#include "io/table/heading.hpp"
#include "io/text/json_records.hpp"
#include "io/text/named_columns.hpp"
#include "run/trials/epoch_formats.hpp"

namespace corpuscle {
namespace {

using Names = std::vector<std::string_view>;
const Names start_names = {"start", "start_time", "onset", "begin", "from"}, stop_names = {"stop", "stop_time", "end", "end_time", "offset", "to"},
            duration_names = {"duration", "length"};
constexpr const char* form = "write start,stop,label in seconds, such as 1.5,2.25,rough";

/// One row of a table of epochs: the text of each field. `error_at` makes an error at a field.
struct EpochRow {
    std::span<const std::string_view> fields;
    long line;
    std::function<Error(std::string message, std::size_t field)> error_at;
};

/// Turns rows into trials. The columns are known from the headings.
class EpochReader {
    std::vector<Column> headings_;
    std::optional<std::size_t> start_ = {}, stop_ = {}, duration_ = {}, label_ = {};
    std::vector<Trial> trials_ = {};

    std::optional<std::size_t> find(std::span<const std::string_view> names) const {
        for (const auto name : names)
            for (std::size_t c = 0; c < headings_.size(); ++c)
                if (lower(headings_[c].name) == name) return c;
        return {};
    }

    Result<double> seconds(const EpochRow& row, std::size_t c) const {
        const auto field = trimmed(row.fields[c]);
        const auto& [name, unit] = std::pair(headings_[c].name, headings_[c].unit);
        const auto bare = parse_bare_number<double>(field.starts_with('+') ? field.substr(1) : field);
        const auto time = bare ? Result<double>(*bare * (unit.empty() ? 1 : *seconds_per_time_unit(unit))) : parse_quantity(field, "s");
        if (!time || !std::isfinite(*time))
            return row.error_at(fmt::format("'{}': {} is not a time; {}", name, field.empty() ? "an empty field" : fmt::format("'{}'", field.substr(0, 40)), form), c);
        return *time;
    }

public:
    explicit EpochReader(std::vector<Column> headings) : headings_(std::move(headings)) {}

    /// Finds the columns. `error`: makes an error at the header.
    Result<void> find_columns(const std::optional<std::string>& label, const std::function<Error(std::string)>& error) {
        const std::string wanted = lower(label.value_or(""));
        std::vector<std::string> names;
        for (const auto& h : headings_) names.push_back(h.name);
        start_ = find(start_names), stop_ = find(stop_names), duration_ = find(duration_names);
        if (!start_ || (!stop_ && !duration_))
            return error(fmt::format("a table of trials has the columns start, stop and label; this one has: {}; rename its columns",
                                     joined(std::span(names).first(std::min<std::size_t>(names.size(), 12)))));
        for (const auto c : {start_, stop_, duration_})
            if (c && !headings_[*c].unit.empty() && !seconds_per_time_unit(headings_[*c].unit))
                return error(fmt::format("'{}' is in '{}', which is not a unit of time; write {}_s or {}_ms", headings_[*c].name,
                                         headings_[*c].unit, headings_[*c].name, headings_[*c].name));
        label_ = label ? find(Names{wanted}) : find(epoch_label_names);
        if (label && !label_)
            return error(fmt::format("--label {}: there is no such column; there are: {}", *label,
                                     joined(std::span(names).first(std::min<std::size_t>(names.size(), 12)))));
        return {};
    }

    Result<void> add(const EpochRow& row) {
        if (row.fields.size() != headings_.size())
            return row.error_at(fmt::format("{} columns where {} are expected; {}", row.fields.size(), headings_.size(), form),
                                std::string::npos);
        const double start = TRY(seconds(row, *start_));
        const double stop = stop_ ? TRY(seconds(row, *stop_)) : start + TRY(seconds(row, *duration_));
        if (!(stop > start)) {
            const auto message = stop_ ? fmt::format("the trial stops at {:g} s, but starts at {:g} s; stop must be after start", stop, start)
                                       : fmt::format("the trial lasts {:g} s; its duration must be above 0", stop - start);
            return row.error_at(message, stop_ ? *stop_ : *duration_);
        }
        trials_.push_back({start, stop, label_ ? std::string(trimmed(row.fields[*label_])) : std::string(default_trial_label), row.line});
        return {};
    }

    EpochTable finish() {
        std::vector<std::string> unused;
        for (std::size_t c = 0; c < headings_.size(); ++c)
            if (c != start_ && c != stop_ && c != label_ && !(c == duration_ && !stop_)) unused.push_back(headings_[c].name);
        return make_epoch_table(std::move(trials_), unused, label_.has_value());
    }
};

/// The text of a JSON value as a field.
std::string text_of(const nlohmann::ordered_json& value) {
    return value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
}

Result<EpochTable> read_json(LineReader& lines, const std::optional<std::string>& label) {
    const auto path = lines.path();
    std::optional<EpochReader> reader;
    std::vector<std::string> names;
    const auto add = [&](std::span<const JsonField> fields, long line) -> Result<void> {
        const auto error = [&](std::string message, std::size_t = 0) { return bad_input(std::move(message), {path, line}); };
        if (!reader) {
            std::vector<Column> headings;
            for (const auto& f : fields) names.push_back(f.name), headings.push_back(parse_heading(f.name));
            reader.emplace(std::move(headings));
            TRY(reader->find_columns(label, error));
        }
        std::vector<std::string> texts(names.size());
        for (const auto& f : fields)
            if (const auto at = std::find(names.begin(), names.end(), f.name); at != names.end())
                texts[static_cast<std::size_t>(at - names.begin())] = text_of(*f.value);
        const std::vector<std::string_view> views(texts.begin(), texts.end());
        return reader->add({views, line, error});
    };
    TRY(read_json_records(lines, add));
    return reader ? reader->finish() : EpochTable{};
}

Result<EpochTable> read_text(LineReader lines, const std::optional<std::string>& label) {
    NamedColumns table(std::move(lines));
    if (!TRY(table.read_header())) return EpochTable{};
    EpochReader reader(table.headings());
    TRY(reader.find_columns(label, [&](std::string message) { return table.error_at(std::move(message)); }));
    while (TRY(table.next()))
        TRY(reader.add({table.fields(), table.error_at("").location.line, [&](std::string message, std::size_t field) { return table.error_at(std::move(message), field); }}));
    return reader.finish();
}

}  // namespace

EpochTable make_epoch_table(std::vector<Trial> trials, const std::vector<std::string>& unused, bool has_labels) {
    std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
        return std::tie(a.start, a.stop, a.label) < std::tie(b.start, b.stop, b.label);
    });
    EpochTable out{std::move(trials), {}};
    std::vector<std::string> names;
    for (const auto& name : unused) names.push_back("'" + name + "'");
    if (names.size() > 6) names.resize(6), names.push_back("...");
    if (!names.empty())
        out.notes.push_back(fmt::format("{} {} not used{}", joined(names), names.size() == 1 ? "is" : "are",
                                        has_labels ? "" : "; --label NAME takes the labels from a column"));
    return out;
}

Result<EpochTable> read_epochs(const std::string& path, const std::optional<std::string>& label) {
    if (peek_input(path, 4) == "\x89HDF") return read_nwb_epochs(path, label);
    auto lines = TRY(LineReader::open(path));
    const auto is_json = TRY(looks_like_json(lines));
    auto table = TRY(is_json ? read_json(lines, label) : read_text(std::move(lines), label));
    if (table.trials.empty()) return bad_input(fmt::format("there are no trials in this file; {}", form), {path});
    return table;
}

}  // namespace corpuscle
