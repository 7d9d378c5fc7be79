#pragma once
// The NumPy format NPY: a header with a Python dictionary, then the elements of the array as NumPy has them in memory. And NPZ: a zip
// archive of named NPY arrays.

#include <string_view>

#include "io/table/archive.hpp"

namespace corpuscle {

/// A field of the elements. The elements of an array that is not structured have one field without a name.
struct NpyField {
    std::string name = {};
    char kind = 'V';                   ///< NumPy's type letter: b i u f are read as numbers; c U S O V M m are not
    std::size_t size = 0, offset = 0;  ///< bytes; the offset is from the beginning of the element
    bool big_endian = false;
    bool is_numeric() const;  ///< true if decoder() can read the field
    /// A function that reads the field at the given address as a double. Only for a numeric field.
    double (*decoder() const)(const std::byte*);
};

struct NpyHeader {
    std::string type = {};  ///< type of the elements as written in the file, at most 60 bytes of it, for messages
    std::vector<NpyField> fields = {};
    std::size_t element_size = 0;  ///< bytes
    bool is_column_major = false;  ///< Fortran order
    std::vector<std::uint64_t> shape = {};
    std::uint64_t data_offset = 0;  ///< position of the first element in the file, bytes

    std::uint64_t element_count() const;
};

/// Reads the header at the beginning of an NPY file of version 1, 2 or 3. Returns an error if the type is unknown or the file is shorter
/// than the array.
Result<NpyHeader> read_npy_header(SeekableBytes&);

/// The bytes of the header of a one-dimensional array of `count` elements of a type such as "<f8".
std::string npy_header(std::string_view type, std::size_t count);

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
