#pragma once
// The NumPy format NPY: a header that is a Python literal, then the elements as in memory.

#include <string>
#include <string_view>
#include <vector>

#include "io/seekable_bytes.hpp"

namespace corpuscle {

/// A field of an element type.
struct NpyField {
    std::string name = {};             ///< "" if the type is not structured
    char kind = 'V';                   ///< NumPy's type letter: b i u f are numbers; c U S O V M m are not
    std::size_t size = 0, offset = 0;  ///< bytes; the offset is from the beginning of the element
    bool big_endian = false;
    bool is_numeric() const;
    /// A function that reads the number. Only for a numeric field.
    double (*decoder() const)(const std::byte*);
};

struct NpyHeader {
    std::string type = {};  ///< as written in the file
    std::vector<NpyField> fields = {};
    std::size_t element_size = 0;  ///< bytes
    bool is_column_major = false;  ///< Fortran order
    std::vector<std::uint64_t> shape = {};
    std::uint64_t data_offset = 0;

    std::uint64_t element_count() const;  ///< number of elements
};

/// Reads versions 1, 2 and 3. Returns an error if the type is unknown or the file is shorter than the array.
Result<NpyHeader> read_npy_header(SeekableBytes&);

/// The header of a one-dimensional array of `count` elements.
std::string npy_header(std::string_view type, std::size_t count);

}  // namespace corpuscle
