#pragma once
// The NumPy format NPY: a header with a Python dictionary, then the elements of the array as NumPy has them in memory.

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

}  // namespace corpuscle
