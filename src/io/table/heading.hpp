#pragma once
// Interprets the headings of columns: name, unit, and whether a column is a time, a row number or a trial number. Determines, from the
// headings and the first rows, which column is the time and which columns are not channels (row numbers, words).

#include <limits>
#include <string_view>

#include "io/table/table.hpp"

namespace corpuscle {

/// Splits a header field, as written in the file, into name and unit: "fz_N", "fz [N]", "fz (N)", "fz/N", "fz in N".
Column parse_heading(std::string_view written);

/// True if a column of this name is certainly the time: time, t, timestamp ...
bool is_time_name(std::string_view name);

/// True if a column of this name may be the time, including the names above: unix_time, datetime, header.stamp, Zeit ...
bool may_be_time_name(std::string_view name);

/// True if the name stands for a row number: index, sample, frame, seq ...
bool is_index_name(std::string_view name);

/// True if the name stands for a packet number, which increases by more than 1 where packets are missing: RDTSequence, header.seq ...
bool is_sequence_name(std::string_view name);

/// True if the name stands for a trial number or label: trial, run, subject ...
bool is_trial_name(std::string_view name);

/// True if the word is a unit, as in a row of units below the headings. Single letters that may also be names, such as F, count as units.
bool is_unit(std::string_view word);

/// The length in seconds of a unit of time: s, ms, sec, millis ... nullopt if `unit` is not a unit of time.
std::optional<double> seconds_per_time_unit(std::string_view unit);

/// True for units that a force sensor never has: of time, frequency, temperature, angle, torque, speed or acceleration.
bool is_never_force(std::string_view unit);

/// The number of rows, from the first one on, that are inspected.
inline constexpr std::size_t inspected_rows = 64;

/// The fields of the inspected rows of one column.
struct FirstFields {
    std::vector<double> numbers;  ///< for each row; NaN for a field that is not a number
    /// Numbers of fields that are numbers, words, time stamps (dates or times of day), and empty.
    std::size_t value_count = 0, word_count = 0, stamp_count = 0, empty_count = 0;

    void add_number(double x) { numbers.push_back(x), ++value_count; }
    /// Adds a field that is not a number; `count` is one of the three other counts.
    void add_other(std::size_t& count) { numbers.push_back(std::numeric_limits<double>::quiet_NaN()), ++count; }
};

struct ColumnRoles {
    std::optional<std::size_t> time_column = {};  ///< nullopt: the table has none
    bool is_time_guessed = false;                 ///< true: the time column was recognised by its values, not by its name
    std::vector<std::string> notes = {};          ///< notes for the user about the time column
};

/// Finds the time column, and marks in `columns` those with time stamps and those that are not channels. `first` has one element for each
/// column. `named` is true if the columns have headings; without headings, only a column of time stamps can be the time. `time` is the time
/// column if the file states it.
ColumnRoles assign_roles(std::vector<Column>& columns, const std::vector<FirstFields>& first, bool named,
                         std::optional<std::size_t> time = {});

/// True if any column has a name other than the default names ch1, ch2 ...
bool has_named_columns(const std::vector<Column>& columns);

}  // namespace corpuscle
