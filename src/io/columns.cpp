#include "io/columns.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <span>

#include "signal/field.hpp"
#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
    std::size_t n = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (status != std::errc{} || end != text.data() + text.size()) return {};
    return n;
}

bool called(const Column& column, std::string_view name) {
    return column.name == name || (!column.unit.empty() && column.name + "_" + column.unit == name);
}

/// The columns of a table that are channels, and how they are asked for.
struct Chooser {
    const Table& table;
    std::optional<std::size_t> time;
    std::string path;
    std::vector<std::size_t> data;  // columns other than the time

    Chooser(const Table& t, std::optional<std::size_t> time_column, std::string p) : table(t), time(time_column), path(std::move(p)) {
        for (std::size_t c = 0; c < table.columns().size(); ++c)
            if (c != time) data.push_back(c);
    }

    Error unknown(std::string_view wanted) const {
        std::vector<std::string_view> names;
        for (const auto c : data) names.push_back(table.columns()[c].name);
        const auto shown = std::span(names).first(std::min<std::size_t>(names.size(), 24));
        return bad_input(fmt::format("no channel '{}'{}; there are {}: {}{}", wanted, did_you_mean(wanted, names), names.size(),
                                     fmt::join(shown, ", "), shown.size() < names.size() ? " ..." : ""),
                         {path});
    }

    Result<void> add(std::string_view wanted, std::vector<std::size_t>& chosen) const {
        for (const auto c : data) {
            const auto& column = table.columns()[c];
            if (called(column, wanted)) return chosen.push_back(c), Result<void>{};
        }
        const auto dash = wanted.find('-');
        const auto from = whole_number(wanted.substr(0, dash)),
                   to = dash == std::string_view::npos ? from : whole_number(wanted.substr(dash + 1));
        if (!from || !to || *from < 1 || *to > data.size() || *from > *to) return unknown(wanted);
        for (std::size_t n = *from; n <= *to; ++n) chosen.push_back(data[n - 1]);
        return {};
    }

    Result<std::vector<std::size_t>> choose(const std::vector<std::string>& wanted) const {
        std::vector<std::size_t> chosen;
        if (data.empty()) return bad_input("there is no channel besides the time", {path});
        if (wanted.empty()) return data;
        for (const auto& list : wanted)
            for (std::size_t at = 0; at <= list.size();) {
                const auto end = std::min(list.find(',', at), list.size());
                if (auto ok = add(std::string_view(list).substr(at, end - at), chosen); !ok) return ok.error();
                at = end + 1;
            }
        std::vector<std::size_t> once;
        for (const auto c : chosen)
            if (std::find(once.begin(), once.end(), c) == once.end()) once.push_back(c);
        return once;
    }
};

}  // namespace

Result<std::vector<std::size_t>> choose_columns(const Table& table, std::optional<std::size_t> time, const std::vector<std::string>& wanted,
                                                const std::string& path) {
    return Chooser(table, time, path).choose(wanted);
}

Result<std::optional<std::size_t>> choose_time(const Table& table, const std::optional<std::string>& wanted, const std::string& path) {
    if (!wanted) return table.time_column();
    if (*wanted == "none") return std::optional<std::size_t>();
    const auto& columns = table.columns();
    const auto named = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return called(c, *wanted); });
    if (named != columns.end()) return std::optional(static_cast<std::size_t>(named - columns.begin()));
    if (const auto number = whole_number(*wanted); number && *number >= 1 && *number <= columns.size()) return std::optional(*number - 1);
    return bad_input(fmt::format("no column '{}' to take as time; give its name, its number or 'none'", *wanted), {path});
}

Result<double> newtons_per_unit(const Column& column, const RecordingOptions& options, const std::string& path) {
    if (options.scale) return *options.scale;
    const std::string& unit = options.unit ? *options.unit : column.unit;
    if (unit.empty()) return 1.0;
    constexpr std::string_view newtons[] = {"Newton", "newton", "Newtons", "newtons"};
    if (std::find(std::begin(newtons), std::end(newtons), unit) != std::end(newtons)) return 1.0;
    const auto known = unit == "raw" ? Result<Unit>(bad_input("")) : parse_unit(unit);
    if (known && known->same_kind(*parse_unit("N"))) return known->factor;
    const auto what = options.unit ? fmt::format("'{}' is read as {}", column.name, unit) : fmt::format("'{}' is in {}", column.name, unit);
    const auto why = known           ? "which is no force"
                     : unit == "raw" ? "which needs a scale"
                                     : "which is no unit of force known here (N, mN, gf, kgf, lbf ...)";
    const auto else_ = options.unit ? "" : ", --unit N if the header is wrong, or --channel if it is another column that holds the force";
    return bad_input(fmt::format("{}, {}; say --scale S, so that what is read times S is newtons{}", what, why, else_), {path});
}

Result<double> seconds_per_unit(const Column& column, const RecordingOptions& options, const std::string& path) {
    const std::string& unit = options.time_unit ? *options.time_unit : column.unit;
    if (unit.empty()) return 1.0;
    constexpr std::pair<std::string_view, double> words[] = {{"sec", 1},     {"secs", 1},      {"second", 1},    {"seconds", 1},
                                                             {"msec", 1e-3}, {"msecs", 1e-3},  {"millis", 1e-3}, {"milliseconds", 1e-3},
                                                             {"usec", 1e-6}, {"micros", 1e-6}, {"h", 3600}};
    for (const auto& [word, factor] : words)
        if (word == unit) return factor;
    const auto known = parse_unit(unit);
    if (known && known->same_kind(*parse_unit("s"))) return known->factor;
    if (options.time_unit) return bad_usage(fmt::format("--time-unit {}: no unit of time; say s, ms, us or min", unit));
    return bad_input(
        fmt::format(
            "the time column '{}' is in '{}', which is no time; --time-unit says what it is in, --time names another column, or none",
            column.name, unit),
        {path});
}

}  // namespace corpuscle
