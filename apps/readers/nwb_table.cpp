#include "nwb_table.hpp"

#include <fmt/format.h>
#include <array>

#include "core/text/utf8.hpp"
#include "nwb_series.hpp"

namespace corpuscle {
namespace {

using hdf5::Handle;

/// The names of the members of an enumeration in a dataset of `count` elements; empty on failure.
std::vector<std::string> member_names_in(hid_t dataset, hid_t type, std::size_t count) {
    const Handle native(H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose);
    const auto size = native ? H5Tget_size(native) : 0;
    if (size == 0 || size > sizeof(std::uint64_t) || count == 0) return {};
    std::vector<char> values(count * size);
    if (H5Dread(dataset, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) return {};
    std::vector<std::string> out;
    for (std::size_t k = 0; k < count; ++k) {
        std::array<char, 256> name{};
        if (H5Tenum_nameof(native, values.data() + k * size, name.data(), name.size() - 1) < 0) return {};
        out.emplace_back(name.data());
    }
    return out;
}

}  // namespace

NwbTable::NwbTable(const Handle& file, const std::string& group, const std::string& path) : file_(file), group_(group + "/"), path_(path) {
    constexpr std::size_t max_columns = 10'000;
    columns_ = hdf5::datasets_below(file, group, 1, max_columns);
}

Error NwbTable::damaged(const std::string& column) const {
    return bad(fmt::format("cannot read {}; the file may be damaged", group_ + column));
}

const ArrayInfo* NwbTable::find(const std::string& column) const {
    for (const auto& c : columns_)
        if (c.name == group_ + column) return &c;
    return nullptr;
}

std::vector<std::string> NwbTable::column_names() const {
    std::vector<std::string> out;
    for (const auto& c : columns_)
        if (!c.name.ends_with("_index")) out.push_back(c.name.substr(group_.size()));
    return out;
}

bool NwbTable::has_one_value_per_row(const std::string& column) const {
    const auto* info = find(column);
    return info && info->shape.size() == 1 && !find(column + "_index");
}

Result<Handle> NwbTable::open(const std::string& column, std::uint64_t limit) const {
    const auto* info = find(column);
    if (!info) return bad(fmt::format("{} has no column '{}'", group_.substr(0, group_.size() - 1), column));
    if (info->shape.size() != 1) return bad(fmt::format("{} must have one dimension", describe(*info)));
    if (info->shape[0] > limit) return bad(fmt::format("{}: more than {} elements", describe(*info), limit));
    auto dataset = hdf5::open_dataset(file_, info->name);
    if (!dataset) return damaged(column);
    if (info->shape[0] > 0) TRY(hdf5::check_storage(dataset, *info, path_));
    return dataset;
}

template <class T>
Result<std::vector<T>> NwbTable::numbers(const std::string& column, hid_t memory, std::uint64_t limit) const {
    const auto dataset = TRY(open(column, limit));
    if (!find(column)->is_numeric) return bad(fmt::format("{}: numbers are expected", describe(*find(column))));
    std::vector<T> out(find(column)->shape[0]);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    if (!hdf5::is_number(type) || (!out.empty() && H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0))
        return damaged(column);
    return out;
}

Result<std::vector<double>> NwbTable::reals(const std::string& column, std::uint64_t limit) const {
    return numbers<double>(column, H5T_NATIVE_DOUBLE, limit);
}

Result<std::vector<std::int64_t>> NwbTable::integers(const std::string& column, std::uint64_t limit) const {
    return numbers<std::int64_t>(column, H5T_NATIVE_INT64, limit);
}

Result<std::vector<std::string>> NwbTable::texts(const std::string& column, std::uint64_t limit) const {
    std::vector<std::string> out;
    if (find(column) && find(column)->is_numeric) {
        for (const double x : TRY(reals(column, limit))) out.push_back(fmt::format("{}", x));
        return out;
    }
    const auto dataset = TRY(open(column, limit));
    const auto count = find(column)->shape[0];
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const bool is_enumeration = H5Tget_class(type) == H5T_ENUM;
    if (!is_enumeration && H5Tget_class(type) != H5T_STRING)
        return bad(fmt::format("{}: texts or numbers are expected", describe(*find(column))));
    out = is_enumeration ? member_names_in(dataset, type, count) : hdf5::strings_in(dataset);
    if (out.size() != count) return damaged(column);
    for (auto& text : out) text = to_utf8(text);
    return out;
}

Result<void> check_is_nwb(const Handle& file, const std::string& contents, const std::string& path) {
    if (is_nwb(file)) return {};
    return bad_input(fmt::format("this HDF5 file is not an NWB file, the only HDF5 format with {} that is read: its root has no attribute "
                                 "neurodata_type = NWBFile",
                                 contents),
                     {path});
}

}  // namespace corpuscle
