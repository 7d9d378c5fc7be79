#pragma once
// Named lists of numbers and words as NumPy keeps them: an NPZ is a zip archive of NPY arrays.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/archive.hpp"
#include "io/npy.hpp"

namespace corpuscle {

class NpzWriter {
    std::vector<Packed> arrays_;

public:
    void add(const std::string& name, std::span<const std::int64_t>);
    void add(const std::string& name, std::span<const double>);
    /// Words of UTF-8; bytes that are none become U+FFFD.
    void add(const std::string& name, std::span<const std::string>);
    /// The file, without a date: the same lists in the same order give the same bytes.
    Result<std::string> bytes() const { return make_archive(arrays_); }
};

/// The header of an array of an archive, which holds that array and nothing else: else the checksum would not be reached.
Result<NpyHeader> read_member_header(Bytes&);

class NpzReader {
    Archive archive_;

public:
    explicit NpzReader(Archive archive) : archive_(std::move(archive)) {}
    static Result<NpzReader> open(const std::string& path);

    const std::string& path() const { return archive_.path(); }
    std::vector<std::string> names() const;
    bool has(const std::string& name) const;
    /// The array's bytes, from the beginning of its header.
    Result<std::unique_ptr<Bytes>> bytes(const std::string& name) const;
    // A whole array as a list, whatever its shape. Refuses a name that is not there and elements of another kind.
    Result<std::vector<std::int64_t>> integers(const std::string& name) const;
    Result<std::vector<double>> numbers(const std::string& name) const;
    Result<std::vector<std::string>> words(const std::string& name) const;
};

}  // namespace corpuscle
