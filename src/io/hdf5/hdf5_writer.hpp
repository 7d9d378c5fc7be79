#pragma once
// Writes an HDF5 file through a helper program, so that the library and its users need not link HDF5, whose shared libraries triple the
// start-up time of a program.

#include <span>

#include "io/hdf5/hdf5_step.hpp"
#include "io/output/output_file.hpp"
#include "io/sandbox/helper_process.hpp"

namespace corpuscle {

class Hdf5Writer {
    std::string path_;
    HelperProcess helper_;

    void send(const Hdf5Step& step);

public:
    /// Starts the helper program, which writes into the open file. The file must be empty, and not a device or pipe.
    static Result<Hdf5Writer> start(OutputFile&);
    /// The same for a descriptor; `path` is for messages.
    static Result<Hdf5Writer> start(int descriptor, const std::string& path);

    // An error of these functions is returned by finish(), because the helper program does not answer each step.
    void add_group(const std::string& path, std::vector<Hdf5Attribute> attributes = {});
    void add_attributes(const std::string& path, std::vector<Hdf5Attribute> attributes);
    /// A dataset of texts: a list, or a scalar if `is_scalar`.
    void add_texts(const std::string& path, std::vector<std::string> texts, bool is_scalar, std::vector<Hdf5Attribute> attributes = {});
    /// A dataset of texts in row-major order.
    void add_texts(const std::string& path, std::vector<std::string> texts, std::vector<std::uint64_t> shape,
                   std::vector<Hdf5Attribute> attributes = {});
    /// A dataset of numbers. The number type must be that of the elements; an empty shape is a scalar.
    template <class T>
    void add_numbers(const std::string& path, Hdf5Type type, std::span<const T> values, std::vector<std::uint64_t> shape,
                     std::vector<Hdf5Attribute> attributes = {}) {
        const auto* at = reinterpret_cast<const char*>(values.data());
        send({.kind = Hdf5Step::Kind::dataset,
              .path = path,
              .type = type,
              .shape = std::move(shape),
              .attributes = std::move(attributes),
              .bytes = {at, at + values.size_bytes()}});
    }
    /// A dataset of real numbers to which rows are appended; `columns`: the length of a row, 0 for a dataset of one dimension.
    void add_growing(const std::string& path, std::uint64_t columns, std::vector<Hdf5Attribute> attributes = {});
    void append(const std::string& path, std::span<const double> values);
    /// Completes the file, or returns the first error.
    Result<void> finish();
};

// Attributes.
inline Hdf5Attribute text_value(std::string name, std::string text) { return {std::move(name), Hdf5Type::text, false, {std::move(text)}}; }
inline Hdf5Attribute text_list(std::string name, std::vector<std::string> texts) {
    return {std::move(name), Hdf5Type::text, true, std::move(texts)};
}
inline Hdf5Attribute real_value(std::string name, double x) { return {.name = std::move(name), .type = Hdf5Type::real, .number = x}; }
inline Hdf5Attribute int_value(std::string name, int x) {
    return {.name = std::move(name), .type = Hdf5Type::int32, .number = static_cast<double>(x)};
}
inline Hdf5Attribute reference_to(std::string name, std::string path) {
    return {std::move(name), Hdf5Type::reference, false, {std::move(path)}};
}

}  // namespace corpuscle
