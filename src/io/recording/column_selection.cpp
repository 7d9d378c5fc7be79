#include "io/recording/column_selection.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/table/heading.hpp"

namespace corpuscle {
namespace {

/// True if `name` is the column's name, its name and unit, or its heading as written, such as "Zeit [s]".
bool matches_name(const Column& column, std::string_view name) {
    if (column.name == name || (!column.unit.empty() && column.name + "_" + column.unit == name)) return true;
    const auto heading = parse_heading(name);
    return !heading.unit.empty() && column.name == heading.name && column.unit == heading.unit;
}

/// True for the word "newton" in its spellings. parse_unit() reads symbols such as N and mN.
bool is_newton_word(std::string_view unit) {
    constexpr std::string_view spellings[] = {"Newton", "newton", "Newtons", "newtons"};
    return std::find(std::begin(spellings), std::end(spellings), unit) != std::end(spellings);
}

/// True for a unit of force.
bool is_force(std::string_view unit) {
    if (is_newton_word(unit)) return true;
    const auto parsed = unit.empty() || unit == "raw" ? Result<Unit>(bad_input("")) : parse_unit(unit);
    return parsed && parsed->has_same_dimension(*parse_unit("N"));
}

/// The text without blanks around it, and without single or double quotes around the rest.
std::string_view without_quotes(std::string_view s) {
    s = trimmed(s);
    return s.size() > 2 && (s.front() == '\'' || s.front() == '"') && s.back() == s.front() ? s.substr(1, s.size() - 2) : s;
}

/// Selects the channels of a table. k is an index in `data`; as a number of --channel it is k + 1.
struct ChannelSelector {
    const Table& table;
    std::optional<std::size_t> time;
    std::string path;
    std::vector<std::size_t> data;  // the columns other than the time, as indices in the table

    ChannelSelector(const Table& t, std::optional<std::size_t> time_column, std::string p)
        : table(t), time(time_column), path(std::move(p)) {
        for (std::size_t c = 0; c < table.columns().size(); ++c)
            if (c != time) data.push_back(c);
    }

    /// The error for a channel that does not exist. Lists the first of those that do.
    Error unknown(std::string_view wanted) const {
        std::vector<std::string_view> names;
        for (const auto c : data) names.push_back(table.columns()[c].name);
        const auto shown = std::span(names).first(std::min<std::size_t>(names.size(), 24));
        return bad_input(fmt::format("no channel '{}'{}; there are {}: {}{}", wanted, did_you_mean(wanted, names), names.size(),
                                     joined(shown), shown.size() < names.size() ? " ..." : ""),
                         {path});
    }

    /// The index in `data` of the column of this name.
    std::optional<std::size_t> named(std::string_view wanted) const {
        for (std::size_t k = 0; k < data.size(); ++k)
            if (matches_name(table.columns()[data[k]], wanted)) return k;
        return {};
    }

    /// The argument of --channel that selects column k: its number, or its name if that number is the name of another column.
    std::string option_of(std::size_t k) const {
        auto number = std::to_string(k + 1);
        const auto other = named(number);
        return other && *other != k ? table.columns()[data[k]].name : number;
    }

    std::string name_of(std::size_t k) const { return fmt::format("'{}'", table.columns()[data[k]].name); }

    /// Adds the columns `from` to `to` of `data` (both included) to `chosen`. A range of several columns leaves out those that the table
    /// excludes; a single column is always added.
    void add_range(std::size_t from, std::size_t to, std::vector<std::size_t>& chosen) const {
        for (std::size_t k = from; k <= to; ++k)
            if (from == to || table.columns()[data[k]].exclusion_reason.empty()) chosen.push_back(data[k]);
    }

    /// Adds a range such as "fx-fz" or "'Channel 4'-'Channel 7'". Returns false if the text is not a range of names.
    bool add_named_range(std::string_view wanted, std::vector<std::size_t>& chosen) const {
        for (auto dash = wanted.find('-'); dash != wanted.npos; dash = wanted.find('-', dash + 1)) {
            const auto from = named(without_quotes(wanted.substr(0, dash))), to = named(without_quotes(wanted.substr(dash + 1)));
            if (from && to && *from <= *to) return add_range(*from, *to, chosen), true;
        }
        return false;
    }

    /// Adds the columns that one part of the argument of --channel selects: a name, a range of names, a number, or a range of numbers.
    Result<void> add(std::string_view wanted, std::vector<std::size_t>& chosen, std::vector<std::string>* notes) const {
        for (const auto name : {wanted, without_quotes(wanted)})
            if (const auto k = named(name)) return chosen.push_back(data[*k]), Result<void>{};
        if (add_named_range(wanted, chosen)) return {};
        const auto dash = wanted.find('-');
        const auto from = parse_bare_number<std::size_t>(wanted.substr(0, dash)),
                   to = dash == std::string_view::npos ? from : parse_bare_number<std::size_t>(wanted.substr(dash + 1));
        if (!from || !to || *from < 1 || *to > data.size() || *from > *to) return unknown(wanted);
        add_range(*from - 1, *to - 1, chosen);
        if (notes)
            notes->push_back(*from == *to ? fmt::format("--channel {} is {}", wanted, name_of(*from - 1))
                                          : fmt::format("--channel {} is {} to {}", wanted, name_of(*from - 1), name_of(*to - 1)));
        return {};
    }

    /// The default selection: all columns that may be forces. If at least one column has a unit of force, columns in other known units are
    /// left out. If all columns would be left out because of their units, all are selected.
    Result<std::vector<std::size_t>> default_selection(std::vector<std::string>* notes) const {
        const auto has_force_unit = [&](std::size_t c) {
            return table.columns()[c].exclusion_reason.empty() && is_force(table.columns()[c].unit);
        };
        const bool any_force_unit = std::any_of(data.begin(), data.end(), has_force_unit);
        const auto is_other = [&](const Column& c) {
            return is_never_force(c.unit) || (any_force_unit && !c.unit.empty() && is_unit(c.unit) && !is_force(c.unit));
        };
        std::vector<std::size_t> chosen, other;  // other: columns with a unit that is not a force
        for (const auto c : data)
            if (table.columns()[c].exclusion_reason.empty()) (is_other(table.columns()[c]) ? other : chosen).push_back(c);
        if (chosen.empty() && other.empty()) {
            const auto with_evidence =
                std::find_if(data.begin(), data.end(), [&](std::size_t c) { return !table.columns()[c].exclusion_evidence.empty(); });
            const auto& column = table.columns()[with_evidence == data.end() ? data[0] : *with_evidence];
            return bad_input(fmt::format("no column holds force values: '{}' {}{}{}", column.name, column.exclusion_reason,
                                         column.exclusion_evidence.empty() ? "" : "; ", column.exclusion_evidence),
                             {path});
        }
        if (chosen.empty()) return other;
        constexpr std::size_t max_notes = 16;
        std::size_t left_out = 0;
        for (std::size_t k = 0; notes && k < data.size(); ++k) {
            const auto& c = table.columns()[data[k]];
            if (c.exclusion_reason.empty() && !is_other(c)) continue;
            if (++left_out > max_notes) continue;
            if (c.exclusion_reason.empty())
                notes->push_back(
                    fmt::format("{} was ignored: {} is not a unit of force (if the header is wrong, use --channel {} --unit N)", name_of(k),
                                c.unit, option_of(k)));
            else if (c.exclusion_reason.starts_with("counts") || c.exclusion_reason.starts_with("identifies"))
                notes->push_back(
                    fmt::format("{} was ignored: it {} (use --channel {} to include it)", name_of(k), c.exclusion_reason, option_of(k)));
            else
                notes->push_back(fmt::format("{} was ignored: it {}", name_of(k), c.exclusion_reason));
        }
        if (left_out > max_notes)
            notes->push_back(fmt::format("{} more columns were ignored because they hold no force (use --channel NAME to include one)",
                                         left_out - max_notes));
        return chosen;
    }

    /// The columns that the arguments of --channel select, each once, in the order of the arguments.
    Result<std::vector<std::size_t>> choose(const std::vector<std::string>& wanted, std::vector<std::string>* notes) const {
        std::vector<std::size_t> chosen;
        if (data.empty()) return bad_input("there is no channel, only the time column", {path});
        if (wanted.empty()) return default_selection(notes);
        for (const auto& list : wanted) {
            if (const auto k = named(list)) {  // a name may contain commas
                chosen.push_back(data[*k]);
                continue;
            }
            for (const auto part : split(list, ',')) TRY(add(part, chosen, notes));
        }
        std::vector<std::size_t> unique;
        for (const auto c : chosen)
            if (std::find(unique.begin(), unique.end(), c) == unique.end()) unique.push_back(c);
        if (unique.empty()) return bad_input(fmt::format("--channel {} selects only columns without force values", wanted[0]), {path});
        return unique;
    }
};

}  // namespace

Result<std::vector<std::size_t>> select_columns(const Table& table, std::optional<std::size_t> time, const std::vector<std::string>& wanted,
                                                const std::string& path, std::vector<std::string>* notes) {
    return ChannelSelector(table, time, path).choose(wanted, notes);
}

Result<std::optional<std::size_t>> select_time_column(const Table& table, const std::optional<std::string>& wanted,
                                                      const std::string& path) {
    if (!wanted) return table.info().time_column;
    if (*wanted == "none") return std::optional<std::size_t>();
    const auto& columns = table.columns();
    const auto named = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return matches_name(c, *wanted); });
    if (named != columns.end()) return std::optional(static_cast<std::size_t>(named - columns.begin()));
    if (const auto number = parse_bare_number<std::size_t>(*wanted); number && *number >= 1 && *number <= columns.size())
        return std::optional(*number - 1);
    std::vector<std::string_view> names;
    for (const auto& c : columns) names.push_back(c.name);
    const auto shown = std::span(names).first(std::min<std::size_t>(names.size(), 12));
    return bad_input(fmt::format("no time column '{}'{}; give a name, a number or 'none' (columns: {}{})", *wanted,
                                 did_you_mean(*wanted, names), joined(shown), shown.size() < names.size() ? " ..." : ""),
                     {path});
}

Result<void> check_unit_options(const RecordingOptions& options) {
    if (options.unit && options.scale && *options.unit != "raw")
        return bad_usage("--unit and --scale exclude each other: both convert the values to newtons");
    return {};
}

bool lacks_unit(const Column& column, const RecordingOptions& options) { return column.unit.empty() && !options.unit && !options.scale; }

std::string unitless_note(std::vector<std::string> names) {
    if (names.empty()) return "";
    for (auto& name : names) name = fmt::format("'{}'", name);
    if (names.size() > 6) names.resize(6), names.push_back("...");
    return fmt::format("no unit for {}: assuming newtons", joined(names));
}

/// Newtons per unit of a column, if the unit is one of force.
std::optional<double> force_of_unit(const std::string& unit) {
    if (is_newton_word(unit)) return 1.0;
    const auto parsed = parse_unit(unit);
    return parsed && parsed->has_same_dimension(*parse_unit("N")) ? std::optional(parsed->factor) : std::nullopt;
}

std::string overridden_unit_note(const Column& column, const RecordingOptions& options) {
    if (options.scale && !options.unit) {
        const auto force = force_of_unit(column.unit);
        if (!force || *force == std::abs(*options.scale)) return "";  // --scale -1 changes the sign of newtons
        return fmt::format("--scale {} overrides the unit of '{}' in the header, {}", *options.scale, column.name, column.unit);
    }
    if (column.unit.empty() || !options.unit || *options.unit == column.unit || options.scale) return "";
    return fmt::format("--unit {} overrides the unit of '{}' in the header, {}", *options.unit, column.name, column.unit);
}

Result<double> newtons_per_unit(const Column& column, const RecordingOptions& options, const std::string& path,
                                std::string_view selection) {
    if (options.scale) return *options.scale;
    const std::string& unit = options.unit ? *options.unit : column.unit;
    if (unit.empty()) return 1.0;
    if (const auto force = force_of_unit(unit)) return *force;
    const auto parsed = unit == "raw" ? Result<Unit>(bad_input("")) : parse_unit(unit);
    const auto subject =
        options.unit ? fmt::format("'{}' is read as {}", column.name, unit) : fmt::format("'{}' is in {}", column.name, unit);
    const auto problem = parsed          ? "which is not a force"
                         : unit == "raw" ? "which needs a scale"
                                         : "which is not a known unit of force (N, mN, gf, kgf, lbf ...)";
    const auto alternatives = options.unit ? "" : fmt::format(", --unit N if the header is wrong, or {}", selection);
    if (unit == "g" || unit == "kg")  // for a load cell, usually a weight and not a mass
        return bad_input(fmt::format("{}, which is a mass; use --unit {}f if it is the weight of that mass, or --scale S for S newtons "
                                     "per {}{}",
                                     subject, unit, unit, options.unit ? "" : fmt::format(", or {}", selection)),
                         {path});
    return bad_input(
        fmt::format("{}, {}; use --scale S for S newtons per {}{}", subject, problem, unit == "raw" ? "count" : unit, alternatives),
        {path});
}

Result<double> seconds_per_unit(const Column& column, const RecordingOptions& options, const std::string& path) {
    const std::string& unit = options.time_unit ? *options.time_unit : column.unit;
    if (unit.empty()) return 1.0;
    if (column.holds_time_stamps && options.time_unit)
        return bad_usage(
            fmt::format("--time-unit {}: '{}' holds dates or times of day, which have no unit; omit the option", unit, column.name));
    if (const auto seconds = seconds_per_time_unit(unit)) return *seconds;
    if (options.time_unit) return bad_usage(fmt::format("--time-unit {}: not a unit of time; use s, ms, us, ns or min", unit));
    return bad_input(
        fmt::format(
            "the time column '{}' is in '{}', which is not a unit of time; give its unit with --time-unit, or another column or 'none' "
            "with --time",
            column.name, unit),
        {path});
}

}  // namespace corpuscle
