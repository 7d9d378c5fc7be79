#pragma once
// The columns of a table of an NWB file: a group whose datasets have one element for each row, such as /units and /intervals/trials.

#include "hdf5_file.hpp"

namespace corpuscle {

class NwbTable {
    const hdf5::Handle& file_;
    std::string group_;  // with a '/' at its end
    const std::string& path_;
    std::vector<ArrayInfo> columns_;  // the datasets in the group, with their complete paths

    /// A column of one dimension with at most `limit` elements, whose data exist.
    Result<hdf5::Handle> open(const std::string& column, std::uint64_t limit) const;
    template <class T>
    Result<std::vector<T>> numbers(const std::string& column, hid_t memory, std::uint64_t limit) const;

public:
    /// `group`: its path, such as "/units". `path`: of the file, for messages.
    NwbTable(const hdf5::Handle& file, const std::string& group, const std::string& path);

    bool is_empty() const { return columns_.empty(); }
    /// The column of this name; null if there is none.
    const ArrayInfo* find(const std::string& column) const;
    /// The names of all columns in order, without indexes, which belong to another column.
    std::vector<std::string> column_names() const;
    /// True if the table has one value of this column for each row: the column has one dimension and no index.
    bool has_one_value_per_row(const std::string& column) const;

    Result<std::vector<double>> reals(const std::string& column, std::uint64_t limit) const;
    Result<std::vector<std::int64_t>> integers(const std::string& column, std::uint64_t limit) const;
    /// The texts of a column of texts, numbers, or members of an enumeration, such as TRUE.
    Result<std::vector<std::string>> texts(const std::string& column, std::uint64_t limit) const;

    Error bad(std::string message) const { return bad_input(std::move(message), {path_}); }
    Error damaged(const std::string& column) const;
};

/// Returns an error unless the file is an NWB file. `contents`: what is read, such as "spikes".
Result<void> check_is_nwb(const hdf5::Handle& file, const std::string& contents, const std::string& path);

}  // namespace corpuscle
