#include "hdf5_file.hpp"

#include <unistd.h>
#include <algorithm>
#include <array>

namespace corpuscle::hdf5 {
namespace {

constexpr std::size_t max_datasets = 10000;  // in a file; further datasets are ignored
constexpr std::size_t max_text = 1 << 20;    // limit of the number of characters, and of the number of strings, in one attribute

Handle space_of(hid_t dataset) { return {H5Dget_space(dataset), H5Sclose}; }

/// An open attribute; an empty handle if the object has none of that name.
Handle attribute_of(hid_t object, const std::string& name) {
    return H5Aexists(object, name.c_str()) > 0 ? Handle(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose) : Handle();
}

/// The text before its first zero byte; if it is padded with spaces, without those at its end.
std::string without_padding(std::string s, hid_t type) {
    s.resize(std::min(s.find('\0'), s.size()));
    return H5Tget_strpad(type) == H5T_STR_SPACEPAD ? s.substr(0, s.find_last_not_of(' ') + 1) : s;
}

/// Reads all elements of an attribute or a dataset; false on failure.
bool read_attribute(hid_t attribute, hid_t type, void* to) { return H5Aread(attribute, type, to) >= 0; }
bool read_dataset(hid_t dataset, hid_t type, void* to) { return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0; }
using ReadAll = bool (*)(hid_t object, hid_t type, void* to);

// The `count` strings of an object, by the kind of its string type; empty on failure.
std::vector<std::string> variable_length_strings(hid_t object, ReadAll read, hid_t type, hid_t space, std::size_t count) {
    std::vector<char*> texts(count);
    if (!read(object, type, texts.data())) return {};
    std::vector<std::string> out;
    for (const char* text : texts) out.emplace_back(text ? text : "");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
    return out;
}

std::vector<std::string> fixed_length_strings(hid_t object, ReadAll read, hid_t type, std::size_t count, std::size_t limit) {
    const std::size_t length = H5Tget_size(type);
    if (length == 0 || length > limit / count) return {};
    std::string all(count * length, '\0');
    if (!read(object, type, all.data())) return {};
    std::vector<std::string> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(without_padding(all.substr(k * length, length), type));
    return out;
}

/// The strings of an object that has this type and space; `limit`: of their number, and of the characters of strings of a fixed length.
std::vector<std::string> strings_of(hid_t object, ReadAll read, const Handle& type, const Handle& space, std::size_t limit) {
    const auto count = H5Sget_simple_extent_npoints(space);
    if (H5Tget_class(type) != H5T_STRING || count < 1 || static_cast<std::size_t>(count) > limit) return {};
    const auto n = static_cast<std::size_t>(count);
    return H5Tis_variable_str(type) > 0 ? variable_length_strings(object, read, type, space, n)
                                        : fixed_length_strings(object, read, type, n, limit);
}

/// True if the HDF5 signature is at byte 0 or, after a user block, at byte 512, 1024, 2048 ...
bool has_signature(int descriptor) {
    constexpr std::array<char, 8> signature{'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
    std::array<char, 8> found{};
    for (off_t at = 0; ::pread(descriptor, found.data(), found.size(), at) == static_cast<ssize_t>(found.size()); at = at ? 2 * at : 512)
        if (found == signature) return true;
    return false;
}

/// Appends the name of a link to the vector `to`.
herr_t add_link_name(hid_t, const char* name, const H5L_info_t*, void* to) {
    static_cast<std::vector<std::string>*>(to)->push_back(name);
    return 0;
}

/// Callback of H5Ovisit: appends the name of a dataset to the vector `to`. Returns 1 to end the visit at max_datasets.
herr_t add_dataset_name(hid_t, const char* name, const H5O_info_t* info, void* to) {
    auto& names = *static_cast<std::vector<std::string>*>(to);
    if (info->type == H5O_TYPE_DATASET) names.push_back("/" + std::string(name));
    return names.size() >= max_datasets ? 1 : 0;
}

}  // namespace

Result<Handle> open_file(int descriptor, const std::string& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // no messages of the library on stderr
    H5PLset_loading_state(0);                     // no filter plugins, which would run code from other files
    const Handle access(descriptor_access(descriptor), H5Pclose);
    if (!access) return bad_input("cannot set up the HDF5 library", {path});
    if (!has_signature(descriptor)) return bad_input("not an HDF5 file (in MATLAB use save -v7.3)", {path});
    Handle file(H5Fopen(only_file_name, H5F_ACC_RDONLY, access), H5Fclose);
    if (!file) return bad_input("cannot open this HDF5 file; it may be damaged or truncated", {path});
    return file;
}

Handle open_dataset(hid_t file, const std::string& name) {
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_chunk_cache(access, 1, 0, 0.75);  // a cache of 0 bytes
    return {H5Dopen2(file, name.c_str(), access), H5Dclose};
}

bool is_number(hid_t type) {
    const auto kind = H5Tget_class(type);
    return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

std::vector<CompoundMember> numeric_members(hid_t type) {
    std::vector<CompoundMember> out;
    const int count = H5Tget_class(type) == H5T_COMPOUND ? H5Tget_nmembers(type) : 0;
    for (int k = 0; k < count; ++k) {
        const auto index = static_cast<unsigned>(k);
        const Handle member(H5Tget_member_type(type, index), H5Tclose);
        const std::unique_ptr<char, herr_t (*)(void*)> name(H5Tget_member_name(type, index), H5free_memory);
        if (member && name && is_number(member)) out.push_back({name.get(), index});
    }
    if (out.size() == 2 && count == 2 && out[0].name == "r" && out[1].name == "i")
        return {};  // a complex number, as h5py writes it, has no numeric members here
    return out;
}

ArrayInfo array_info(hid_t dataset, std::string name) {
    ArrayInfo info{std::move(name), {}, false};
    const Handle type(H5Dget_type(dataset), H5Tclose), space = space_of(dataset);
    const int rank = space ? H5Sget_simple_extent_ndims(space) : -1;
    if (!type || rank < 0 || H5Sget_simple_extent_type(space) == H5S_NULL) return info;
    std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
    if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    info.shape.assign(shape.begin(), shape.end());
    info.is_numeric = is_number(type) || !numeric_members(type).empty();
    return info;
}

std::vector<ArrayInfo> datasets_in(hid_t file) {
    std::vector<std::string> names;
    (void)H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add_dataset_name, &names, H5O_INFO_BASIC);
    std::vector<ArrayInfo> out;
    for (const auto& name : names)
        if (const auto dataset = open_dataset(file, name)) out.push_back(array_info(dataset, name));
    return out;
}

std::vector<ArrayInfo> datasets_below(hid_t file, const std::string& group, int depth, std::size_t limit, const std::string& skipped) {
    std::vector<ArrayInfo> out;
    std::vector<std::string> links;
    const Handle at(H5Gopen2(file, group.empty() ? "/" : group.c_str(), H5P_DEFAULT), H5Gclose);
    if (at) (void)H5Literate(at, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_link_name, &links);
    for (const auto& link : links) {
        const auto name = group + "/" + link;
        H5L_info_t about{};
        if (out.size() >= limit || link == skipped || H5Lget_info(at, link.c_str(), &about, H5P_DEFAULT) < 0 ||
            (about.type != H5L_TYPE_HARD && about.type != H5L_TYPE_SOFT))
            continue;
        const Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
        if (object && H5Iget_type(object) == H5I_DATASET) out.push_back(array_info(object, name));
        if (!object || H5Iget_type(object) != H5I_GROUP || depth <= 1) continue;
        for (auto& inner : datasets_below(file, name, depth - 1, limit - out.size(), skipped)) out.push_back(std::move(inner));
    }
    return out;
}

std::optional<double> number_attribute(hid_t object, const std::string& name) {
    const auto attribute = attribute_of(object, name);
    if (!attribute) return {};
    const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
    double value = 0;
    if (!is_number(type) || H5Sget_simple_extent_npoints(space) != 1 || H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) return {};
    return value;
}

std::vector<std::string> string_attributes(hid_t object, const std::string& name) {
    const auto attribute = attribute_of(object, name);
    if (!attribute) return {};
    const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
    return strings_of(attribute, read_attribute, type, space, max_text);
}

std::vector<std::string> strings_in(hid_t dataset) {
    constexpr std::size_t limit = std::size_t{1} << 28;
    const Handle type(H5Dget_type(dataset), H5Tclose), space = space_of(dataset);
    return strings_of(dataset, read_dataset, type, space, limit);
}

std::optional<std::string> text_attribute(hid_t object, const std::string& name) {
    auto texts = string_attributes(object, name);
    return texts.size() == 1 ? std::optional(std::move(texts[0])) : std::nullopt;
}

std::vector<std::string> attribute_names(hid_t object) {
    std::vector<std::string> names;
    (void)H5Aiterate2(
        object, H5_INDEX_NAME, H5_ITER_INC, nullptr,
        [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
            static_cast<std::vector<std::string>*>(to)->push_back(name);
            return 0;
        },
        &names);
    return names;
}

std::optional<double> single_number(hid_t dataset) {
    const Handle type(H5Dget_type(dataset), H5Tclose), space = space_of(dataset);
    double value = 0;
    if (!is_number(type) || H5Sget_simple_extent_npoints(space) != 1 ||
        H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) < 0)
        return {};
    return value;
}

}  // namespace corpuscle::hdf5
