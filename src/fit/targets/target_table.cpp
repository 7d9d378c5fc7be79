#include "fit/targets/target_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/text/named_columns.hpp"

namespace corpuscle {
namespace {

constexpr double default_range = 0.2;  // of a target without low and high
constexpr std::string_view column_names[] = {"stimulus", "settings", "measure", "value", "low", "high", "weight", "set", "source"};
enum TargetColumn : std::size_t { stimulus, settings, measure, value, low, high, weight, set, source };

class TargetReader {
    NamedColumns table_;
    std::optional<std::size_t> columns_[std::size(column_names)] = {};

    /// The field of a column in the current line; "" if the table lacks the column.
    std::string_view field(TargetColumn c) const { return columns_[c] ? trimmed(table_.fields()[*columns_[c]]) : std::string_view(); }
    Error error_at(TargetColumn c, std::string message) const {
        return table_.error_at(std::move(message), columns_[c].value_or(std::string::npos));
    }

    Result<void> read_headings() {
        if (!TRY(table_.read_header())) return bad_input("no targets in this file: it is empty", {table_.path()});
        for (std::size_t c = 0; c < std::size(column_names); ++c) columns_[c] = table_.find({column_names[c]});
        for (std::size_t f = 0; f < table_.headings().size(); ++f) {
            const auto name = lower(table_.headings()[f].name);
            if (std::find(std::begin(column_names), std::end(column_names), name) != std::end(column_names)) continue;
            return table_.error_at(fmt::format("unknown column '{}'{} (a table of targets has {})", name.substr(0, 40),
                                               did_you_mean(name, column_names), joined(column_names)),
                                   f);
        }
        for (const auto c : {stimulus, measure, value})
            if (!columns_[c])
                return table_.error_at(
                    fmt::format("the column '{}' is missing; this header has: {}", column_names[c], joined(table_.fields())));
        return {};
    }

    Result<double> quantity(TargetColumn c, std::string_view unit) const {
        auto number = parse_quantity(field(c), unit);
        return number ? number : error_at(c, fmt::format("{}: {}", column_names[c], number.error().message));
    }

    /// Reads "F_max=4N; t_up=100ms" and checks it by making the stimulus.
    Result<void> read_stimulus(TargetRow& row) const {
        row.stimulus = field(stimulus), row.settings_text = field(settings);
        if (!is_stimulus(row.stimulus)) {
            const auto failed = make_stimulus(row.stimulus, 1e3, 0);
            return error_at(stimulus, failed ? "not a stimulus" : failed.error().message);
        }
        for (auto part : split(row.settings_text, ';')) {
            part = trimmed(part);
            if (part.empty()) continue;
            const auto has_target = part.substr(0, part.find('=')).find('.') != part.npos;
            auto parsed = parse_override(has_target ? std::string(part) : row.stimulus + "." + std::string(part));
            if (!parsed) return error_at(settings, fmt::format("'{}' is not a setting; write F_max=4N; t_up=100ms", part.substr(0, 40)));
            row.settings.push_back(std::move(*parsed));
        }
        const auto made = make_stimulus(row.stimulus, row.settings, 1e3, 0);
        if (!made) return error_at(settings, made.error().message);
        if (!made->unused.empty())
            return error_at(settings, fmt::format("'{}' is for none of the stimuli of this row", made->unused[0].text()));
        return check_measure(row, *made->result);
    }

    /// Reads "mean_rate@plateau", "mean_rate@0.4s..0.6s".
    Result<void> read_measure(TargetRow& row) const {
        row.measure_text = field(measure);
        const auto at = row.measure_text.find('@');
        const auto name = row.measure_text.substr(0, at);
        row.measure = find_target_measure(name);
        if (!row.measure) {
            std::vector<std::string_view> names;
            for (const auto& m : target_measures()) names.push_back(m.info.name);
            return error_at(measure, fmt::format("unknown measure '{}'{} (there are {})", name.substr(0, 40), did_you_mean(name, names),
                                                 joined(names)));
        }
        if (at == std::string::npos) return {};
        row.phase = row.measure_text.substr(at + 1);
        const auto dots = row.phase.find("..");
        if (dots == std::string::npos) return {};
        const auto from = parse_quantity(row.phase.substr(0, dots), "s"), to = parse_quantity(row.phase.substr(dots + 2), "s");
        if (!from || !to || !(*from < *to))
            return error_at(measure,
                            fmt::format("'{}' is not a window; write FROM..TO, such as mean_rate@0.4s..0.6s", row.phase.substr(0, 40)));
        row.window = {*from, *to}, row.phase.clear();
        return {};
    }

    /// Checks that the stimulus has what the measure needs.
    Result<void> check_measure(const TargetRow& row, const ForceSource& source) const {
        const auto phases = source.phases();
        if (!row.phase.empty() && std::none_of(phases.begin(), phases.end(), [&](const Phase& p) { return p.name == row.phase; })) {
            std::vector<std::string> names;
            for (const auto& p : phases) names.push_back(p.name);
            return error_at(measure, fmt::format("{} has no phase '{}'; {}", row.stimulus, row.phase.substr(0, 40),
                                                 names.empty() ? "write a window, such as @0.4s..0.6s" : "it has " + joined(names)));
        }
        if (row.measure->needs_cycle && !(source.cycle_frequency() > 0))
            return error_at(measure, fmt::format("{} needs a periodic stimulus, such as sine; {} is not periodic", row.measure->info.name,
                                                 row.stimulus));
        return {};
    }

    Result<void> read_numbers(TargetRow& row) const {
        const auto unit = row.measure->info.unit;
        row.value = TRY(quantity(value, unit));
        const bool has_low = !field(low).empty(), has_high = !field(high).empty();
        if (!has_low && !has_high && row.value == 0)
            return error_at(value, "a target of 0 needs the column high: the largest value that is still good");
        row.low = has_low ? TRY(quantity(low, unit)) : has_high ? row.value : row.value - default_range * std::abs(row.value);
        row.high = has_high ? TRY(quantity(high, unit)) : has_low ? row.value : row.value + default_range * std::abs(row.value);
        if (!(row.low <= row.value && row.value <= row.high && row.low < row.high))
            return error_at(value, fmt::format("value {:g} must lie between low {:g} and high {:g}", row.value, row.low, row.high));
        if (row.measure->is_logarithmic && !(row.low > 0))
            return error_at(columns_[low] && has_low ? low : value,
                            fmt::format("{} must be above 0, and its low, too", row.measure->info.name));
        if (row.value < 0) return error_at(value, fmt::format("value {:g}: {} cannot be negative", row.value, row.measure->info.name));
        if (field(weight).empty()) return {};
        row.weight = TRY(quantity(weight, ""));
        if (!(row.weight > 0))
            return error_at(weight, fmt::format("weight {:g} must be above 0; delete the row to leave it out", row.weight));
        return {};
    }

    Result<TargetRow> read_row() const {
        if (table_.fields().size() != table_.headings().size())
            return table_.error_at(
                fmt::format("{} columns where {} are expected; put quotes around a field with commas, or separate settings by ';'",
                            table_.fields().size(), table_.headings().size()));
        TargetRow row;
        row.location = table_.error_at("").location, row.measure_location = error_at(measure, "").location;
        TRY(read_measure(row));
        TRY(read_stimulus(row));
        TRY(read_numbers(row));
        const auto set_text = field(set);
        if (set_text != "" && set_text != "train" && set_text != "test")
            return error_at(set, fmt::format("set '{}': write train (or nothing) for a row that is fitted, test for one that is held out",
                                             set_text.substr(0, 40)));
        row.is_test = set_text == "test", row.source = field(source);
        return row;
    }

public:
    explicit TargetReader(LineReader lines) : table_(std::move(lines)) {}

    Result<std::vector<TargetRow>> read() {
        TRY(read_headings());
        std::vector<TargetRow> out;
        while (TRY(table_.next())) out.push_back(TRY(read_row()));
        if (out.empty()) return bad_input("the table has no targets, only a header", {table_.path()});
        return out;
    }
};

}  // namespace

Result<std::vector<TargetRow>> read_targets(const std::string& path) {
    auto lines = TRY(LineReader::open(path));
    return TargetReader(std::move(lines)).read();
}

}  // namespace corpuscle
