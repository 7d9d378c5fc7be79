#pragma once
// Writes files for tests of the readers: NPY by hand, audio with libsndfile, HDF5 with its library.

#include <fmt/format.h>
#include <cmath>

#include <hdf5.h>
#include <sndfile.h>

#include "support/support.hpp"

namespace corpuscle::test {

/// Bytes of an NPY file as NumPy writes it. `type` and `shape` are Python literals, such as "'<f8'" and "(2, 3)"; `data` are the bytes of
/// the elements. `by_columns`: the data are column-major.
inline std::string npy_bytes(const std::string& type, const std::string& shape, const std::string& data, bool by_columns = false,
                             int version = 1) {
    auto header = fmt::format("{{'descr': {}, 'fortran_order': {}, 'shape': {}, }}", type, by_columns ? "True" : "False", shape);
    // Blanks extend the file up to the data to a multiple of 64 bytes: 10 bytes before the header (in version 1), the header, and a
    // newline.
    header.resize((header.size() + 11 + 63) / 64 * 64 - 11, ' ');
    header += '\n';
    std::string out = "\x93NUMPY";
    out += {static_cast<char>(version), '\0', static_cast<char>(header.size() & 255), static_cast<char>(header.size() >> 8)};
    return out + (version > 1 ? std::string(2, '\0') : "") + header + data;
}

/// Writes an audio file of channels with equal numbers of samples (fractions of full scale). `format`: of libsndfile; `rate`: Hz. Integer
/// formats round to steps of 2^-31, or to larger ones if the format has fewer bits.
inline void write_audio(const std::string& path, int format, int rate, const std::vector<std::vector<double>>& channels) {
    SF_INFO info{};
    info.channels = static_cast<int>(channels.size()), info.samplerate = rate, info.format = format;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    if (!file) throw std::runtime_error(sf_strerror(nullptr));
    const int kind = format & SF_FORMAT_SUBMASK;
    for (std::size_t k = 0; k < channels[0].size(); ++k) {
        std::vector<double> frame;
        std::vector<int> integers;
        for (const auto& c : channels) {
            frame.push_back(c[k]);
            integers.push_back(std::isnan(c[k]) ? 0 : static_cast<int>(std::clamp(c[k] * 0x1p31, -0x1p31, 0x1p31 - 1)));
        }
        const bool is_float = kind == SF_FORMAT_FLOAT || kind == SF_FORMAT_DOUBLE;
        is_float ? sf_writef_double(file, frame.data(), 1) : sf_writef_int(file, integers.data(), 1);
    }
    sf_close(file);
}

/// An HDF5 file to write. Names of datasets are paths in the file; missing groups are created.
class Hdf5File {
    hid_t file_, link_properties_;

    hid_t open_object(const std::string& name) const { return H5Oopen(file_, name.c_str(), H5P_DEFAULT); }
    void write_attribute(const std::string& of, const std::string& name, hid_t type, hid_t space, const void* value) {
        const hid_t where = open_object(of), a = H5Acreate2(where, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(a, type, value);
        H5Aclose(a), H5Oclose(where), H5Sclose(space);
    }

public:
    explicit Hdf5File(const std::string& path)
        : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)), link_properties_(H5Pcreate(H5P_LINK_CREATE)) {
        H5Pset_create_intermediate_group(link_properties_, 1);
    }
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;
    ~Hdf5File() { H5Pclose(link_properties_), H5Fclose(file_); }

    /// Writes a dataset. `type`: of its elements in the file; `memory`: of `values`, which may be null to write no data; `shape`: {} for a
    /// scalar; `chunk`: shape of the compressed chunks, {} for a dataset without chunks.
    void write_raw(const std::string& name, hid_t type, hid_t memory, const std::vector<hsize_t>& shape, const void* values,
                   const std::vector<hsize_t>& chunk = {}) {
        const hid_t space = shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
        const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
        if (!chunk.empty()) H5Pset_chunk(how, static_cast<int>(chunk.size()), chunk.data()), H5Pset_deflate(how, 4);
        const hid_t d = H5Dcreate2(file_, name.c_str(), type, space, link_properties_, how, H5P_DEFAULT);
        if (values) H5Dwrite(d, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
        H5Dclose(d), H5Pclose(how), H5Sclose(space);
    }
    void write_numbers(const std::string& name, const std::vector<hsize_t>& shape, const std::vector<double>& values,
                       hid_t type = H5T_NATIVE_DOUBLE, const std::vector<hsize_t>& chunk = {}) {
        write_raw(name, type, H5T_NATIVE_DOUBLE, shape, values.data(), chunk);
    }
    // Attribute `name` of the object `of`.
    void write_attribute(const std::string& of, const std::string& name, double value) {
        write_attribute(of, name, H5T_NATIVE_DOUBLE, H5Screate(H5S_SCALAR), &value);
    }
    void write_attribute(const std::string& of, const std::string& name, const std::string& value) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, value.size() + 1);
        write_attribute(of, name, type, H5Screate(H5S_SCALAR), value.c_str());
        H5Tclose(type);
    }
    void write_string_array_attribute(const std::string& of, const std::string& name, const std::vector<const char*>& words) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, H5T_VARIABLE), H5Tset_cset(type, H5T_CSET_UTF8);
        const hsize_t count = words.size();
        write_attribute(of, name, type, H5Screate_simple(1, &count, nullptr), words.data());
        H5Tclose(type);
    }
};

}  // namespace corpuscle::test
