#pragma once
// NumPy's NPY: a header that is a Python literal, then the elements as they lie in memory.

#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.hpp"

namespace corpuscle {

/// A number, or whatever else a type has in it.
struct NpyField {
    std::string name = {};             ///< "" if the elements are no structures
    char kind = 'V';                   ///< NumPy's letter: b i u f are numbers; c U S O V M m are not
    std::size_t size = 0, offset = 0;  ///< bytes, in an element
    bool big_endian = false;
    bool numeric() const;
    /// The number that stands there. Only for a numeric field.
    double (*decoder() const)(const std::byte*);
};

struct NpyHeader {
    std::string type = {};  ///< as the file writes it
    std::vector<NpyField> fields = {};
    std::size_t element = 0;  ///< bytes
    bool by_columns = false;  ///< Fortran's order
    std::vector<std::uint64_t> shape = {};
    std::uint64_t data_at = 0;

    std::uint64_t count() const;  ///< of elements
};

/// Versions 1, 2 and 3. Refuses a type that is not understood, and more elements than there are bytes.
Result<NpyHeader> read_npy_header(Bytes&);

/// The header of a list of `count` elements.
std::string npy_header(std::string_view type, std::size_t count);

}  // namespace corpuscle
