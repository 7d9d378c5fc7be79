#include "hdf5_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <set>

#include "io/table/foreign_format.hpp"

namespace corpuscle::hdf5 {
namespace {

constexpr hsize_t max_chunk = hsize_t{1} << 30;  // bytes, decompressed

/// The name that an HDF5 function writes, called as get(buffer, size). Without a buffer, get returns the length of the name.
std::string name_in(auto&& get) {
    const auto size = get(nullptr, 0);
    if (size <= 0) return "";
    std::string name(static_cast<std::size_t>(size) + 1, '\0');
    (void)get(name.data(), name.size());
    name.resize(std::min(name.find('\0'), name.size()));
    return name;
}

/// The error for a dataset whose data are in other files, which are never read.
Error data_in_other_files(const ArrayInfo& array, const std::set<std::string>& files, const std::string& path) {
    return bad_input(fmt::format("{}: its data are in '{}', and other files are not read. Copy the data into one file, in Python: "
                                 "h5py.File('own.h5', 'w')['force'] = h5py.File('{}')['{}'][:]",
                                 describe(array), fmt::join(files, "', '"), path, array.name),
                     {path});
}

// The files, of the first 8 entries at most, in which an external or a virtual dataset has its data. The first function returns an empty
// set if the dataset is not external.
std::set<std::string> external_files(hid_t properties) {
    std::set<std::string> files;
    const int count = H5Pget_external_count(properties);
    for (int k = 0; k < count && k < 8; ++k) {
        char name[1024] = {};
        off_t offset = 0;
        hsize_t size = 0;
        if (H5Pget_external(properties, static_cast<unsigned>(k), sizeof name - 1, name, &offset, &size) >= 0) files.insert(name);
    }
    if (count > 0 && files.empty()) files.insert("?");
    return files;
}

std::set<std::string> virtual_sources(hid_t properties) {
    std::set<std::string> files;
    size_t count = 0;
    (void)H5Pget_virtual_count(properties, &count);
    for (size_t k = 0; k < std::min<size_t>(count, 8); ++k) {
        const auto file = name_in([&](char* to, size_t size) { return H5Pget_virtual_filename(properties, k, to, size); });
        const auto dataset = name_in([&](char* to, size_t size) { return H5Pget_virtual_dsetname(properties, k, to, size); });
        files.insert(file == "." ? dataset : file);  // ".": a dataset of this file
    }
    if (files.empty()) files.insert("unknown file");
    return files;
}

/// Fails if a filter of the dataset is not available. Filters that are optional for a writer have been used nevertheless, as a rule.
Result<void> check_filters(hid_t properties, const ArrayInfo& array, const std::string& path) {
    const int count = H5Pget_nfilters(properties);
    for (int k = 0; k < count; ++k) {
        unsigned flags = 0, settings = 0;
        size_t values = 0;
        char name[64] = {};
        const auto id = H5Pget_filter2(properties, static_cast<unsigned>(k), &flags, &values, nullptr, sizeof name - 1, name, &settings);
        if (id < 0 || H5Zfilter_avail(id) > 0) continue;
        return bad_input(
            fmt::format("{}: compressed by filter {}{}, which is not available here. Repack the file where the filter is available: "
                        "h5repack -f GZIP=4 {} repacked.h5",
                        describe(array), id, *name ? fmt::format(" ({})", name) : "", quote_shell_word(path)),
            {path});
    }
    return {};
}

Error never_written(const ArrayInfo& array, const std::string& path) {
    return bad_input(fmt::format("{}: no data were written into it", describe(array)), {path});
}

/// The product of the counts and of the size of an element, bytes; the maximum value on overflow.
hsize_t bytes_of(std::span<const hsize_t> counts, size_t element) {
    hsize_t bytes = element;
    for (const auto n : counts)
        if (__builtin_mul_overflow(bytes, n, &bytes)) return ~hsize_t{0};
    return bytes;
}

/// Checks a chunked dataset: the size of its chunks, and how many of them were written. Fills `storage`.
Result<void> check_chunks(hid_t dataset, hid_t properties, const ArrayInfo& array, const std::string& path, StorageInfo& storage) {
    const Handle space(H5Dget_space(dataset), H5Sclose), type(H5Dget_type(dataset), H5Tclose);
    storage.chunk.resize(array.shape.size());
    if (H5Pget_chunk(properties, static_cast<int>(storage.chunk.size()), storage.chunk.data()) < 0 ||
        std::any_of(storage.chunk.begin(), storage.chunk.end(), [](auto n) { return n == 0; }))
        return bad_input(fmt::format("cannot read {}; the file may be damaged", array.name), {path});
    if (bytes_of(storage.chunk, H5Tget_size(type)) > max_chunk)
        return bad_input(
            fmt::format("{}: chunks of {} need more than 1 GB of memory each. Repack the file: h5repack -l {} {} "
                        "repacked.h5",
                        describe(array), fmt::join(storage.chunk, " x "),
                        quote_shell_word(fmt::format("{}:CHUNK={}", array.name, array.shape.size() == 1 ? "65536" : "4096x64")),
                        quote_shell_word(path)),
            {path});
    std::vector<hsize_t> chunk_counts;
    for (std::size_t d = 0; d < storage.chunk.size(); ++d) chunk_counts.push_back((array.shape[d] - 1) / storage.chunk[d] + 1);
    const auto expected = bytes_of(chunk_counts, 1);
    hsize_t stored = 0;
    if (H5Dget_num_chunks(dataset, space, &stored) < 0)
        return bad_input(fmt::format("cannot read {}; the file may be damaged", array.name), {path});
    if (stored == 0) return never_written(array, path);
    if (stored >= expected) return {};
    if (stored < expected - stored)  // less than half
        return bad_input(fmt::format("{}: only {} of its {} chunks were written. If the recording ended early, keep its beginning, in "
                                     "Python: h5py.File('{}', 'r+')['{}'].resize(ROWS, axis=0)",
                                     describe(array), stored, expected, path, array.name),
                         {path});
    // Missing chunks read as the fill value. Only a fill value that the file's author defined counts as data.
    H5D_fill_value_t fill = H5D_FILL_VALUE_UNDEFINED;
    (void)H5Pfill_value_defined(properties, &fill);
    storage.has_gaps = fill != H5D_FILL_VALUE_USER_DEFINED;
    storage.notes.push_back(
        fmt::format("{}: {} of its {} chunks were never written; {}", array.name, expected - stored, expected,
                    storage.has_gaps ? "their readings are treated as bad" : "their readings are the fill value of the file"));
    return {};
}

}  // namespace

Result<StorageInfo> check_storage(hid_t dataset, const ArrayInfo& array, const std::string& path) {
    StorageInfo storage;
    const Handle properties(H5Dget_create_plist(dataset), H5Pclose), type(H5Dget_type(dataset), H5Tclose);
    const auto layout = H5Pget_layout(properties);
    if (auto files = external_files(properties); !files.empty()) return data_in_other_files(array, files, path);
    if (layout == H5D_VIRTUAL) return data_in_other_files(array, virtual_sources(properties), path);
    TRY(check_filters(properties, array, path));
    if (layout == H5D_CHUNKED) {
        TRY(check_chunks(dataset, properties, array, path, storage));
        return storage;
    }
    const auto stored = H5Dget_storage_size(dataset);
    const std::vector<hsize_t> shape(array.shape.begin(), array.shape.end());
    if (stored == 0) return never_written(array, path);
    if (stored < bytes_of(shape, H5Tget_size(type)))
        return bad_input(fmt::format("{}: only {} bytes of it are stored; the file may be damaged or truncated", describe(array), stored),
                         {path});
    return storage;
}

bool is_chunk_written(hid_t dataset, std::span<const hsize_t> offset) {
    hsize_t bytes = 0;
    return H5Dget_chunk_storage_size(dataset, offset.data(), &bytes) >= 0 && bytes > 0;
}

}  // namespace corpuscle::hdf5
