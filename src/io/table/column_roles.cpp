#include "io/table/heading.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

constexpr std::size_t min_index_rows = 8;  // rows needed to recognise a row number by its values alone

/// Implements assign_roles(). c is the index of a column.
struct Roles {
    std::vector<Column>& columns;
    const std::vector<FirstFields>& first;  // for each column
    ColumnRoles out = {};

    /// True if the inspected fields are numbers or empty, and at least one is a number.
    bool holds_numbers(std::size_t c) const { return first[c].value_count > 0 && first[c].word_count == 0 && first[c].stamp_count == 0; }

    /// True if the numbers of the column never decrease and are not all equal.
    bool rises(std::size_t c) const {
        double last = -std::numeric_limits<double>::infinity(), begin = last;
        for (const double x : first[c].numbers) {
            if (std::isnan(x)) continue;
            if (x < last) return false;
            if (std::isinf(begin)) begin = x;
            last = x;
        }
        return last > begin && !std::isinf(begin);
    }

    /// True if all fields are integers, the second is greater than the first, and `step` is true for each difference to the row before.
    template <class Step>
    bool is_counter(std::size_t c, const Step& step) const {
        const auto& x = first[c].numbers;
        if (x.size() < 2 || first[c].value_count != x.size()) return false;
        for (std::size_t k = 0; k < x.size(); ++k)
            if (std::floor(x[k]) != x[k] || (k > 0 && !step(x[k] - x[k - 1]))) return false;
        return x[1] > x[0];
    }
    static bool is_one(double step) { return step == 1; }
    static bool is_positive(double step) { return step > 0; }
    static bool is_one_or_restart(double step) { return step == 1 || step < 0; }  // an index that restarts at each trial
    static bool is_positive_or_restart(double step) { return step != 0; }         // packets may be missing, and their number may restart

    /// True if the numbers increase, and each step is between 50 % and 150 % of the mean step.
    bool evenly_rises(std::size_t c) const {
        const auto& x = first[c].numbers;
        if (x.size() < 3 || first[c].value_count != x.size()) return false;
        const double mean = (x.back() - x[0]) / static_cast<double>(x.size() - 1);
        bool even = mean > 0;
        for (std::size_t k = 1; k < x.size(); ++k) even = even && x[k] > x[k - 1] && std::abs(x[k] - x[k - 1] - mean) < 0.5 * mean;
        return even;
    }

    /// Marks the columns of dates or times of day, and those that are not channels because they hold words or nothing.
    void mark_stamps_and_words() {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const auto& f = first[c];
            const auto rows = f.numbers.size();
            if (f.stamp_count > 0 && f.value_count == 0 && f.word_count == 0) columns[c].holds_time_stamps = true;
            if (f.word_count > 0 && f.value_count == 0 && f.stamp_count == 0) columns[c].exclusion_reason = "holds words, not numbers";
            // With fewer rows, the fields may be empty by chance.
            if (rows >= 3 && f.empty_count == rows) columns[c].exclusion_reason = "is empty";
        }
    }

    /// Makes the first column that satisfies `matches` the time column. Returns false if there is none.
    template <class Matches>
    bool use_as_time(const Matches& matches) {
        for (std::size_t c = 0; c < columns.size(); ++c)
            if (matches(c)) return out.time_column = c, true;
        return false;
    }

    /// Finds the time column of a table with headings. A name that is certainly the time comes first. Then follow, in this order: a name
    /// that may be the time with a unit of time, such a name without a unit, time stamps, a unit of time, and a first column without a
    /// name.
    void find_named_time() {
        const auto may_be_time = [&](std::size_t c) {
            return columns[c].holds_time_stamps || (holds_numbers(c) && (first[c].numbers.size() < 2 || rises(c)));
        };
        const auto has_time_unit = [&](std::size_t c) {
            return columns[c].holds_time_stamps || seconds_per_time_unit(columns[c].unit).has_value();
        };
        if (use_as_time([&](std::size_t c) { return is_time_name(columns[c].name); })) return;
        const bool found =
            use_as_time([&](std::size_t c) { return may_be_time_name(columns[c].name) && has_time_unit(c) && may_be_time(c); }) ||
            use_as_time([&](std::size_t c) {
                return columns[c].unit.empty() && may_be_time_name(columns[c].name) && may_be_time(c) && rises(c);
            }) ||
            use_as_time([&](std::size_t c) { return columns[c].holds_time_stamps; }) ||
            use_as_time([&](std::size_t c) { return has_time_unit(c) && holds_numbers(c) && rises(c); });
        if (found) {
            const auto& name = columns[*out.time_column].name;
            out.notes.push_back(
                fmt::format("{} is taken as the time (use --time none if it is not)",
                            name.empty() ? fmt::format("column {}, which has no name,", *out.time_column + 1) : "'" + name + "'"));
        } else if (columns.size() > 1 && columns[0].name.empty() && evenly_rises(0) && !is_counter(0, is_positive)) {
            out.time_column = 0, out.is_time_guessed = true;
            out.notes.emplace_back(
                "the first column has no name, increases evenly and is taken as the time (use --time none if it is a channel)");
        }
    }

    /// True if the column holds row, sample or packet numbers.
    bool is_index(std::size_t c) const {
        const auto& column = columns[c];
        if (!column.unit.empty() || !holds_numbers(c)) return false;
        if (c == 0 && column.name.empty()) return is_counter(c, is_positive);
        if (is_sequence_name(column.name) && is_counter(c, is_positive_or_restart)) return true;
        if (is_index_name(column.name)) return is_counter(c, is_one_or_restart);
        return first[c].numbers.size() >= min_index_rows && is_counter(c, is_one);
    }

    bool holds_integers(std::size_t c) const {
        return holds_numbers(c) &&
               std::all_of(first[c].numbers.begin(), first[c].numbers.end(), [](double x) { return std::floor(x) == x; });
    }

    /// Excludes columns of times, row numbers and trial numbers, and second clocks. If no other column remains, only columns of time stamps
    /// are excluded.
    void exclude_non_measurements() {
        std::vector<std::pair<std::size_t, std::string>> excluded;
        std::size_t remaining = 0;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (c == out.time_column || !columns[c].exclusion_reason.empty()) continue;
            if (columns[c].holds_time_stamps)
                columns[c].exclusion_reason = "holds times";
            else if (is_index(c))
                excluded.emplace_back(c, "counts the rows");
            else if (is_trial_name(columns[c].name) && columns[c].unit.empty() && holds_integers(c))
                excluded.emplace_back(c, "identifies trials");
            else if (out.time_column && rises(c) && (is_time_name(columns[c].name) || columns[c].name.ends_with("stamp")))
                excluded.emplace_back(c, "is a second clock");
            else
                ++remaining;
        }
        if (remaining == 0) return;
        for (auto& [c, why] : excluded) columns[c].exclusion_reason = std::move(why);
    }
};

}  // namespace

bool has_named_columns(const std::vector<Column>& columns) {
    return std::any_of(columns.begin(), columns.end(), [](const Column& c) {
        return !c.name.starts_with("ch") || c.name.find_first_not_of("0123456789", 2) != c.name.npos;
    });
}

ColumnRoles assign_roles(std::vector<Column>& columns, const std::vector<FirstFields>& first, bool named, std::optional<std::size_t> time) {
    Roles roles{columns, first, {.time_column = time}};
    roles.mark_stamps_and_words();
    if (time)
        columns[*time].exclusion_reason.clear();  // the file states the time column, so its content does not matter
    else if (named)
        roles.find_named_time();
    else if (roles.use_as_time([&](std::size_t c) { return columns[c].holds_time_stamps; }))
        roles.out.is_time_guessed = true;
    if (named) roles.exclude_non_measurements();
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].holds_time_stamps && columns[c].unit.empty()) columns[c].unit = "s";
    return std::move(roles.out);
}

}  // namespace corpuscle
