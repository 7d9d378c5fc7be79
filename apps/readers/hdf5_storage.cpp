#include "hdf5_storage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <set>

#include "io/foreign_format.hpp"

namespace corpuscle::hdf5 {
namespace {

constexpr hsize_t largest_chunk = hsize_t{1} << 30;  // bytes, unpacked

std::string name_in(auto&& get) {
    const auto size = get(nullptr, 0);
    if (size <= 0) return "";
    std::string name(static_cast<std::size_t>(size) + 1, '\0');
    (void)get(name.data(), name.size());
    name.resize(std::min(name.find('\0'), name.size()));
    return name;
}

/// A dataset of other files is copied by the user, who sees then what is taken.
Error elsewhere(const ArrayFacts& facts, const std::set<std::string>& files, const std::string& path) {
    return bad_input(fmt::format("{}: its data lie in '{}', and no other file is read; copy it into a file of its own, in Python: "
                                 "h5py.File('own.h5', 'w')['force'] = h5py.File('{}')['{}'][:]",
                                 described(facts), fmt::join(files, "', '"), path, facts.name),
                     {path});
}

std::set<std::string> external_files(hid_t how) {
    std::set<std::string> files;
    const int count = H5Pget_external_count(how);
    for (int k = 0; k < count && k < 8; ++k) {
        char name[1024] = {};
        off_t offset = 0;
        hsize_t size = 0;
        if (H5Pget_external(how, static_cast<unsigned>(k), sizeof name - 1, name, &offset, &size) >= 0) files.insert(name);
    }
    if (count > 0 && files.empty()) files.insert("?");
    return files;
}

std::set<std::string> virtual_sources(hid_t how, const ArrayFacts& facts) {
    std::set<std::string> files;
    size_t count = 0;
    (void)H5Pget_virtual_count(how, &count);
    for (size_t k = 0; k < std::min<size_t>(count, 8); ++k) {
        const auto file = name_in([&](char* to, size_t size) { return H5Pget_virtual_filename(how, k, to, size); });
        const auto dataset = name_in([&](char* to, size_t size) { return H5Pget_virtual_dsetname(how, k, to, size); });
        files.insert(file == "." ? dataset : file);
    }
    if (files.empty()) files.insert("nothing that " + facts.name + " names");
    return files;
}

Result<void> check_filters(hid_t how, const ArrayFacts& facts, const std::string& path) {
    const int count = H5Pget_nfilters(how);
    for (int k = 0; k < count; ++k) {
        unsigned flags = 0, settings = 0;
        size_t values = 0;
        char name[64] = {};
        const auto id = H5Pget_filter2(how, static_cast<unsigned>(k), &flags, &values, nullptr, sizeof name - 1, name, &settings);
        if (id < 0 || (flags & H5Z_FLAG_OPTIONAL) || H5Zfilter_avail(id) > 0) continue;
        return bad_input(fmt::format("{}: packed by the filter {}{}, which is not here; where it is, repack the file: "
                                     "h5repack -f GZIP=4 {} repacked.h5",
                                     described(facts), id, *name ? fmt::format(" ({})", name) : "", shell_word(path)),
                         {path});
    }
    return {};
}

Error never_written(const ArrayFacts& facts, const std::string& path) {
    return bad_input(fmt::format("{}: no data were ever written into it", described(facts)), {path});
}

/// Elements times the bytes of each; the largest number if that overflows.
hsize_t bytes_of(std::span<const hsize_t> counts, size_t element) {
    hsize_t bytes = element;
    for (const auto n : counts)
        if (__builtin_mul_overflow(bytes, n, &bytes)) return ~hsize_t{0};
    return bytes;
}

Result<void> check_chunks(hid_t dataset, hid_t how, const ArrayFacts& facts, const std::string& path, Storage& storage) {
    const Id space(H5Dget_space(dataset), H5Sclose), type(H5Dget_type(dataset), H5Tclose);
    storage.chunk.resize(facts.shape.size());
    if (H5Pget_chunk(how, static_cast<int>(storage.chunk.size()), storage.chunk.data()) < 0 ||
        std::any_of(storage.chunk.begin(), storage.chunk.end(), [](auto n) { return n == 0; }))
        return bad_input(fmt::format("{} cannot be read: damaged?", facts.name), {path});
    if (bytes_of(storage.chunk, H5Tget_size(type)) > largest_chunk)
        return bad_input(fmt::format("{}: chunks of {} take more than 1 GB of memory each; repack the file: h5repack -l {} {} "
                                     "repacked.h5",
                                     described(facts), fmt::join(storage.chunk, " x "),
                                     shell_word(fmt::format("{}:CHUNK={}", facts.name, facts.shape.size() == 1 ? "65536" : "4096x64")),
                                     shell_word(path)),
                         {path});
    std::vector<hsize_t> across;
    for (std::size_t d = 0; d < storage.chunk.size(); ++d) across.push_back((facts.shape[d] - 1) / storage.chunk[d] + 1);
    const auto expected = bytes_of(across, 1);
    hsize_t stored = 0;
    if (H5Dget_num_chunks(dataset, space, &stored) < 0) return bad_input(fmt::format("{} cannot be read: damaged?", facts.name), {path});
    if (stored == 0) return never_written(facts, path);
    if (stored >= expected) return {};
    if (stored < expected - stored)
        return bad_input(fmt::format("{}: only {} of its {} chunks were ever written; if the recording ended early, keep its beginning, in "
                                     "Python: h5py.File('{}', 'r+')['{}'].resize(ROWS, axis=0)",
                                     described(facts), stored, expected, path, facts.name),
                         {path});
    H5D_fill_value_t fill = H5D_FILL_VALUE_UNDEFINED;
    (void)H5Pfill_value_defined(how, &fill);
    storage.has_gaps = fill != H5D_FILL_VALUE_USER_DEFINED;
    storage.remarks.push_back(fmt::format("{}: {} of its {} chunks were never written; {}", facts.name, expected - stored, expected,
                                          storage.has_gaps ? "their readings are bad fields" : "they read as the file's fill value"));
    return {};
}

}  // namespace

Result<Storage> storage_of(hid_t dataset, const ArrayFacts& facts, const std::string& path) {
    Storage storage;
    const Id how(H5Dget_create_plist(dataset), H5Pclose), type(H5Dget_type(dataset), H5Tclose);
    const auto layout = H5Pget_layout(how);
    if (auto files = external_files(how); !files.empty()) return elsewhere(facts, files, path);
    if (layout == H5D_VIRTUAL) return elsewhere(facts, virtual_sources(how, facts), path);
    if (auto ok = check_filters(how, facts, path); !ok) return ok.error();
    if (layout == H5D_CHUNKED) {
        if (auto ok = check_chunks(dataset, how, facts, path, storage); !ok) return ok.error();
        return storage;
    }
    const auto stored = H5Dget_storage_size(dataset);
    const std::vector<hsize_t> shape(facts.shape.begin(), facts.shape.end());
    if (stored == 0) return never_written(facts, path);
    if (stored < bytes_of(shape, H5Tget_size(type)))
        return bad_input(fmt::format("{}: only {} bytes of it are stored: damaged, or cut short?", described(facts), stored), {path});
    return storage;
}

bool is_written(hid_t dataset, std::span<const hsize_t> offset) {
    hsize_t bytes = 0;
    return H5Dget_chunk_storage_size(dataset, offset.data(), &bytes) >= 0 && bytes > 0;
}

}  // namespace corpuscle::hdf5
