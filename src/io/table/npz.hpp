#pragma once
// NumPy's NPZ format: a zip archive of named NPY arrays.

#include "io/table/npy.hpp"

namespace corpuscle {

/// Collects one-dimensional arrays for an NPZ file.
class NpzWriter {
    std::vector<ArchiveEntry> arrays_;

public:
    /// Adds an array with the elements of a list.
    void add(const std::string& name, std::span<const std::int64_t>);
    void add(const std::string& name, std::span<const double>);
    /// Adds an array of strings, which are given in UTF-8. Invalid bytes become U+FFFD.
    void add(const std::string& name, std::span<const std::string>);
    /// The bytes of the file. The same arrays in the same order give the same bytes.
    Result<std::string> bytes() const { return make_archive(arrays_); }
};

/// Reads the header of an NPY file that is a member of an archive. The member must end with the array: its checksum is verified only when
/// its last byte is read.
Result<NpyHeader> read_member_header(SeekableBytes&);

/// An open NPZ file. `name` is the name of an array.
class NpzReader {
    Archive archive_;

public:
    explicit NpzReader(Archive archive) : archive_(std::move(archive)) {}
    static Result<NpzReader> open(const std::string& path);

    const std::string& path() const { return archive_.path(); }
    std::vector<std::string> names() const;  ///< of all arrays, without .npy
    bool has(const std::string& name) const;
    /// The bytes of an array, including its header.
    Result<std::unique_ptr<SeekableBytes>> bytes(const std::string& name) const;
    // The elements of an array of any shape, in the order of the file. An unknown name, or elements of another type, are errors.
    Result<std::vector<std::int64_t>> integers(const std::string& name) const;
    Result<std::vector<double>> numbers(const std::string& name) const;
    Result<std::vector<std::string>> strings(const std::string& name) const;
};

}  // namespace corpuscle
