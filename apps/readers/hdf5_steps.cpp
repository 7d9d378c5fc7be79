// Writes an HDF5 file step by step (io/hdf5/hdf5_step.hpp). The bytes depend only on the steps and the version of HDF5: no times are
// stored. The data are not compressed, because the bytes would depend on the version of zlib.

#include <fmt/format.h>
#include <cstring>
#include <map>

#include "hdf5_file.hpp"
#include "helper_main.hpp"
#include "io/hdf5/hdf5_step.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/helper_messages.hpp"

namespace corpuscle {
namespace {

using hdf5::Handle;

constexpr std::uint64_t numbers_per_chunk = 8192;  // of a growing dataset: 64 kB

hid_t stored_type(Hdf5Type type) {
    switch (type) {
        case Hdf5Type::int32:
            return H5T_STD_I32LE;
        case Hdf5Type::int64:
            return H5T_STD_I64LE;
        case Hdf5Type::uint64:
            return H5T_STD_U64LE;
        default:
            return H5T_IEEE_F64LE;
    }
}

/// The type of a text of any length, in UTF-8.
Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

Handle space_of(const std::vector<std::uint64_t>& shape) {
    if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
    const std::vector<hsize_t> sizes(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
}

std::vector<const char*> pointers_to(const std::vector<std::string>& texts) {
    std::vector<const char*> out;
    for (const auto& text : texts) out.push_back(text.c_str());
    return out;
}

/// Creation properties of an object without times.
Handle without_times(hid_t kind) {
    Handle properties(H5Pcreate(kind), H5Pclose);
    H5Pset_obj_track_times(properties, false);
    return properties;
}

class FileWriter {
    Handle file_;
    std::map<std::string, Handle> growing_;  // datasets, by their path

    /// Writes an attribute of one value or of a list; false on failure.
    bool write_attribute(hid_t object, const Hdf5Attribute& a) {
        if (a.type == Hdf5Type::reference) {
            hobj_ref_t target = 0;
            return a.texts.size() == 1 && H5Rcreate(&target, file_, a.texts[0].c_str(), H5R_OBJECT, -1) >= 0 &&
                   write_value(object, a.name, H5T_STD_REF_OBJ, H5T_STD_REF_OBJ, {}, &target);
        }
        if (a.type != Hdf5Type::text) return write_value(object, a.name, stored_type(a.type), H5T_NATIVE_DOUBLE, {}, &a.number);
        const auto type = text_type();
        const auto texts = pointers_to(a.texts);
        return (a.is_list || texts.size() == 1) &&
               write_value(object, a.name, type, type, a.is_list ? std::vector<std::uint64_t>{texts.size()} : std::vector<std::uint64_t>{},
                           texts.data());
    }

    static bool write_value(hid_t object, const std::string& name, hid_t stored, hid_t memory, const std::vector<std::uint64_t>& shape,
                            const void* value) {
        const auto space = space_of(shape);
        const Handle attribute(H5Acreate2(object, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        return attribute && H5Awrite(attribute, memory, value) >= 0;
    }

    bool write_attributes(hid_t object, const std::vector<Hdf5Attribute>& attributes) {
        for (const auto& a : attributes)
            if (!write_attribute(object, a)) return false;
        return true;
    }

    bool add_group(const Hdf5Step& s) {
        const auto properties = without_times(H5P_GROUP_CREATE);
        const Handle group(H5Gcreate2(file_, s.path.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
        return group && write_attributes(group, s.attributes);
    }

    bool add_growing(const Hdf5Step& s) {
        auto properties = without_times(H5P_DATASET_CREATE);
        std::vector<hsize_t> sizes(s.shape.begin(), s.shape.end()), chunk = sizes, limit = sizes;
        const auto width = sizes.size() > 1 ? sizes[1] : 1;
        if (sizes.empty() || sizes.size() > 2 || width == 0) return false;
        chunk[0] = std::max<hsize_t>(1, numbers_per_chunk / width), limit[0] = H5S_UNLIMITED;
        H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
        const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), limit.data()), H5Sclose);
        Handle dataset(H5Dcreate2(file_, s.path.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
        const bool ok = dataset && write_attributes(dataset, s.attributes);
        growing_[s.path] = std::move(dataset);
        return ok;
    }

    bool add_dataset(const Hdf5Step& s) {
        if (s.is_growing) return add_growing(s);
        const auto space = space_of(s.shape);
        const bool is_text = s.type == Hdf5Type::text;
        const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
        if (is_text ? s.texts.size() != count : s.bytes.size() != count * H5Tget_size(stored_type(s.type))) return false;
        const auto text = text_type();
        const auto properties = without_times(H5P_DATASET_CREATE);
        const auto type = is_text ? static_cast<hid_t>(text) : stored_type(s.type);
        const Handle dataset(H5Dcreate2(file_, s.path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
        const auto texts = pointers_to(s.texts);
        const void* data = is_text ? static_cast<const void*>(texts.data()) : s.bytes.data();
        return dataset && (count == 0 || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0) &&
               write_attributes(dataset, s.attributes);
    }

    bool append(const Hdf5Step& s) {
        const auto found = growing_.find(s.path);
        if (found == growing_.end()) return false;
        const hid_t dataset = found->second;
        hsize_t sizes[2] = {0, 1};
        int rank = 0;
        {
            const Handle before(H5Dget_space(dataset), H5Sclose);
            rank = H5Sget_simple_extent_dims(before, sizes, nullptr);
        }
        const hsize_t row = sizes[1] * sizeof(double), start[2] = {sizes[0], 0}, count[2] = {s.bytes.size() / row, sizes[1]};
        if (rank < 1 || s.bytes.size() % row != 0) return false;
        if (count[0] == 0) return true;
        sizes[0] += count[0];
        if (H5Dset_extent(dataset, sizes) < 0) return false;
        const Handle space(H5Dget_space(dataset), H5Sclose), memory(H5Screate_simple(rank, count, nullptr), H5Sclose);
        return H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr) >= 0 &&
               H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, s.bytes.data()) >= 0;
    }

    bool add_attributes(const Hdf5Step& s) {
        const Handle object(H5Oopen(file_, s.path.c_str(), H5P_DEFAULT), H5Oclose);
        return object && write_attributes(object, s.attributes);
    }

    bool finish() {
        growing_.clear();
        const bool flushed = H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0;
        const hid_t file = file_;
        file_ = Handle();
        return flushed && H5Iis_valid(file) <= 0 && hdf5::last_write_error() == 0;
    }

public:
    bool open(int descriptor) {
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // no messages of the library on stderr
        const Handle access(hdf5::descriptor_access(descriptor, true), H5Pclose);
        const auto properties = without_times(H5P_FILE_CREATE);
        file_ = Handle(H5Fcreate(hdf5::only_file_name, H5F_ACC_TRUNC, properties, access), H5Fclose);
        return static_cast<bool>(file_);
    }

    bool run(const Hdf5Step& s) {
        switch (s.kind) {
            case Hdf5Step::Kind::group:
                return add_group(s);
            case Hdf5Step::Kind::dataset:
                return add_dataset(s);
            case Hdf5Step::Kind::append:
                return append(s);
            case Hdf5Step::Kind::attributes:
                return add_attributes(s);
            case Hdf5Step::Kind::finish:
                return finish();
        }
        return false;
    }
};

Error failure(const std::string& what) {
    const int error = hdf5::last_write_error();
    return bad_input(fmt::format("could not be written completely: {}", error ? std::strerror(error) : "the HDF5 library refused " + what));
}

/// Runs the steps until the last one or the first error, and sends the result of all.
void serve_writer(int socket, int file) {
    FileWriter writer;
    reply_safely(socket, "", [&]() -> std::string {
        if (!writer.open(file)) return encode(failure("the file"));
        Hdf5Step step;
        for (std::string m; receive_message(socket, m);) {
            step = {};
            if (!decode_request(m, step)) return encode(bad_input("could not be written: a step was damaged"));
            if (!writer.run(step)) return encode(failure(step.path));
            if (step.kind == Hdf5Step::Kind::finish) return encode_response();
        }
        return {};
    });
}

}  // namespace

HelperService writer_service() { return {HelperProcess::writer_protocol, FileAccess::write, serve_writer}; }

}  // namespace corpuscle
