#include "io/columns.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <span>

#include "io/heading.hpp"
#include "signal/field.hpp"
#include "signal/quantity.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
    std::size_t n = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (status != std::errc{} || end != text.data() + text.size()) return {};
    return n;
}

/// By its name, its name and unit, or as its heading reads: "Zeit [s]".
bool called(const Column& column, std::string_view name) {
    if (column.name == name || (!column.unit.empty() && column.name + "_" + column.unit == name)) return true;
    const auto heading = parse_heading(name);
    return !heading.unit.empty() && column.name == heading.name && column.unit == heading.unit;
}

bool is_newtons(std::string_view unit) {
    constexpr std::string_view words[] = {"Newton", "newton", "Newtons", "newtons"};
    return std::find(std::begin(words), std::end(words), unit) != std::end(words);
}

bool is_force(std::string_view unit) {
    if (is_newtons(unit)) return true;
    const auto known = unit.empty() || unit == "raw" ? Result<Unit>(bad_input("")) : parse_unit(unit);
    return known && known->same_kind(*parse_unit("N"));
}

std::string_view without_quotes(std::string_view s) {
    s = trimmed(s);
    return s.size() > 2 && (s.front() == '\'' || s.front() == '"') && s.back() == s.front() ? s.substr(1, s.size() - 2) : s;
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

    /// Where a column of this name stands among the data.
    std::optional<std::size_t> named(std::string_view wanted) const {
        for (std::size_t k = 0; k < data.size(); ++k)
            if (called(table.columns()[data[k]], wanted)) return k;
        return {};
    }

    /// The word by which --channel selects it: its name if another column has its number as name, else its number.
    std::string option_of(std::size_t k) const {
        auto number = std::to_string(k + 1);
        const auto other = named(number);
        return other && *other != k ? table.columns()[data[k]].name : number;
    }

    std::string name_of(std::size_t k) const { return fmt::format("'{}'", table.columns()[data[k]].name); }

    /// From one to another of the data; what the table leaves out is left out of a range.
    void add_range(std::size_t from, std::size_t to, std::vector<std::size_t>& chosen) const {
        for (std::size_t k = from; k <= to; ++k)
            if (from == to || table.columns()[data[k]].left_out.empty()) chosen.push_back(data[k]);
    }

    /// "fx-fz", "'Channel 4'-'Channel 7'"; false if it is none.
    bool add_named_range(std::string_view wanted, std::vector<std::size_t>& chosen) const {
        for (auto dash = wanted.find('-'); dash != wanted.npos; dash = wanted.find('-', dash + 1)) {
            const auto from = named(without_quotes(wanted.substr(0, dash))), to = named(without_quotes(wanted.substr(dash + 1)));
            if (from && to && *from <= *to) return add_range(*from, *to, chosen), true;
        }
        return false;
    }

    Result<void> add(std::string_view wanted, std::vector<std::size_t>& chosen, std::vector<std::string>* remarks) const {
        for (const auto name : {wanted, without_quotes(wanted)})
            if (const auto k = named(name)) return chosen.push_back(data[*k]), Result<void>{};
        if (add_named_range(wanted, chosen)) return {};
        const auto dash = wanted.find('-');
        const auto from = whole_number(wanted.substr(0, dash)),
                   to = dash == std::string_view::npos ? from : whole_number(wanted.substr(dash + 1));
        if (!from || !to || *from < 1 || *to > data.size() || *from > *to) return unknown(wanted);
        add_range(*from - 1, *to - 1, chosen);
        if (remarks)
            remarks->push_back(*from == *to ? fmt::format("--channel {} is {}", wanted, name_of(*from - 1))
                                            : fmt::format("--channel {} is {} to {}", wanted, name_of(*from - 1), name_of(*to - 1)));
        return {};
    }

    /// All that may hold force: beside a column in newtons or another unit of force, none in a known unit that is none.
    Result<std::vector<std::size_t>> usual(std::vector<std::string>* remarks) const {
        const auto in_force = [&](std::size_t c) { return table.columns()[c].left_out.empty() && is_force(table.columns()[c].unit); };
        const bool some_in_force = std::any_of(data.begin(), data.end(), in_force);
        const auto is_other = [&](const Column& c) {
            return is_never_force(c.unit) || (some_in_force && !c.unit.empty() && is_unit(c.unit) && !is_force(c.unit));
        };
        std::vector<std::size_t> chosen, other;  // other: of a unit that is no force
        for (const auto c : data)
            if (table.columns()[c].left_out.empty()) (is_other(table.columns()[c]) ? other : chosen).push_back(c);
        if (chosen.empty() && other.empty()) {
            const auto known = std::find_if(data.begin(), data.end(), [&](std::size_t c) { return !table.columns()[c].evidence.empty(); });
            const auto& column = table.columns()[known == data.end() ? data[0] : *known];
            return bad_input(fmt::format("no column holds readings: '{}' {}{}{}", column.name, column.left_out,
                                         column.evidence.empty() ? "" : "; ", column.evidence),
                             {path});
        }
        if (chosen.empty()) return other;
        constexpr std::size_t most_told = 16;
        std::size_t left_out = 0;
        for (std::size_t k = 0; remarks && k < data.size(); ++k) {
            const auto& c = table.columns()[data[k]];
            if (c.left_out.empty() && !is_other(c)) continue;
            if (++left_out > most_told) continue;
            if (c.left_out.empty())
                remarks->push_back(
                    fmt::format("{} is in {}, which is no force: left out (if the header is wrong, --channel {} --unit N takes it)",
                                name_of(k), c.unit, option_of(k)));
            else if (c.left_out.starts_with("counts") || c.left_out.starts_with("tells"))
                remarks->push_back(fmt::format("{} {}: left out (--channel {} takes it)", name_of(k), c.left_out, option_of(k)));
            else
                remarks->push_back(fmt::format("{} {}: left out", name_of(k), c.left_out));
        }
        if (left_out > most_told)
            remarks->push_back(fmt::format("{} more columns hold no force: left out (--channel NAME takes one)", left_out - most_told));
        return chosen;
    }

    Result<std::vector<std::size_t>> choose(const std::vector<std::string>& wanted, std::vector<std::string>* remarks) const {
        std::vector<std::size_t> chosen;
        if (data.empty()) return bad_input("there is no channel besides the time", {path});
        if (wanted.empty()) return usual(remarks);
        for (const auto& list : wanted) {
            if (const auto whole = named(list)) {  // a name may hold commas
                chosen.push_back(data[*whole]);
                continue;
            }
            for (std::size_t at = 0; at <= list.size();) {
                const auto end = std::min(list.find(',', at), list.size());
                if (auto ok = add(std::string_view(list).substr(at, end - at), chosen, remarks); !ok) return ok.error();
                at = end + 1;
            }
        }
        std::vector<std::size_t> once;
        for (const auto c : chosen)
            if (std::find(once.begin(), once.end(), c) == once.end()) once.push_back(c);
        if (once.empty()) return bad_input(fmt::format("--channel {} takes only columns that hold no readings", wanted[0]), {path});
        return once;
    }
};

}  // namespace

Result<std::vector<std::size_t>> choose_columns(const Table& table, std::optional<std::size_t> time, const std::vector<std::string>& wanted,
                                                const std::string& path, std::vector<std::string>* remarks) {
    return Chooser(table, time, path).choose(wanted, remarks);
}

Result<std::optional<std::size_t>> choose_time(const Table& table, const std::optional<std::string>& wanted, const std::string& path) {
    if (!wanted) return table.time_column();
    if (*wanted == "none") return std::optional<std::size_t>();
    const auto& columns = table.columns();
    const auto named = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return called(c, *wanted); });
    if (named != columns.end()) return std::optional(static_cast<std::size_t>(named - columns.begin()));
    if (const auto number = whole_number(*wanted); number && *number >= 1 && *number <= columns.size()) return std::optional(*number - 1);
    std::vector<std::string_view> names;
    for (const auto& c : columns) names.push_back(c.name);
    const auto shown = std::span(names).first(std::min<std::size_t>(names.size(), 12));
    return bad_input(fmt::format("no column '{}' to take as time{}; give its name, its number or 'none'; there are {}{}", *wanted,
                                 did_you_mean(*wanted, names), fmt::join(shown, ", "), shown.size() < names.size() ? " ..." : ""),
                     {path});
}

Result<double> newtons_per_unit(const Column& column, const RecordingOptions& options, const std::string& path) {
    if (options.scale) return *options.scale;
    const std::string& unit = options.unit ? *options.unit : column.unit;
    if (unit.empty()) return 1.0;
    if (is_newtons(unit)) return 1.0;
    const auto known = unit == "raw" ? Result<Unit>(bad_input("")) : parse_unit(unit);
    if (known && known->same_kind(*parse_unit("N"))) return known->factor;
    const auto what = options.unit ? fmt::format("'{}' is read as {}", column.name, unit) : fmt::format("'{}' is in {}", column.name, unit);
    const auto why = known           ? "which is no force"
                     : unit == "raw" ? "which needs a scale"
                                     : "which is no unit of force known here (N, mN, gf, kgf, lbf ...)";
    const auto else_ = options.unit ? "" : ", --unit N if the header is wrong, or --channel if it is another column that holds the force";
    if (unit == "g" || unit == "kg")  // of a load cell the weight, far more often than a mass
        return bad_input(fmt::format("{}, which is a mass; --unit {}f takes it as the weight of that mass, --scale S takes what is read "
                                     "times S as newtons{}",
                                     what, unit, options.unit ? "" : ", --channel another column"),
                         {path});
    return bad_input(fmt::format("{}, {}; say --scale S, so that what is read times S is newtons{}", what, why, else_), {path});
}

Result<double> seconds_per_unit(const Column& column, const RecordingOptions& options, const std::string& path) {
    const std::string& unit = options.time_unit ? *options.time_unit : column.unit;
    if (unit.empty()) return 1.0;
    if (column.stamps && options.time_unit)
        return bad_usage(
            fmt::format("--time-unit {}: '{}' holds dates or times of day, which have no unit; leave it out", unit, column.name));
    if (const auto seconds = seconds_in(unit)) return *seconds;
    if (options.time_unit) return bad_usage(fmt::format("--time-unit {}: no unit of time; say s, ms, us, ns or min", unit));
    return bad_input(
        fmt::format(
            "the time column '{}' is in '{}', which is no time; --time-unit says what it is in, --time names another column, or none",
            column.name, unit),
        {path});
}

}  // namespace corpuscle
