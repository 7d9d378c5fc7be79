// Reads all datasets of an HDF5 file that is small enough.

#include "io/hdf5/hdf5_tree.hpp"

#include <fmt/format.h>

#include "hdf5_file.hpp"
#include "helper_main.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {
namespace {

using hdf5::Handle;

constexpr std::uint64_t max_elements = std::uint64_t{1} << 25;  // of all datasets: 256 MB of numbers
constexpr std::size_t max_datasets = 1'000'001;
constexpr int max_depth = 64;  // of groups within groups, because a group may contain itself

/// Number of elements of a dataset, but at most `limit` + 1.
std::uint64_t element_count(const ArrayInfo& info, std::uint64_t limit) {
    std::uint64_t count = 1;
    for (const auto n : info.shape) {
        if (n == 0) return 0;
        count = count > limit / n ? limit + 1 : count * n;
    }
    return count;
}

Result<Hdf5Array> read_array(const Handle& file, const ArrayInfo& info, std::uint64_t count, const std::string& path) {
    Hdf5Array array{.path = info.name, .shape = {info.shape.begin(), info.shape.end()}};
    const auto damaged = [&] { return bad_input(fmt::format("cannot read {}; the file may be damaged", info.name), {path}); };
    const auto dataset = hdf5::open_dataset(file, info.name);
    if (!dataset) return damaged();
    const Handle type(H5Dget_type(dataset), H5Tclose);
    array.is_text = H5Tget_class(type) == H5T_STRING;
    array.is_other = !array.is_text && !hdf5::is_number(type);
    if (array.is_other) return array;
    if (count > 0) TRY(hdf5::check_storage(dataset, info, path));
    if (array.is_text) {
        array.texts = hdf5::strings_in(dataset);
        if (array.texts.size() != count) return damaged();
        return array;
    }
    array.numbers.resize(count);
    if (count > 0 && H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.numbers.data()) < 0) return damaged();
    return array;
}

}  // namespace

Result<std::vector<Hdf5Array>> hdf5_tree(int descriptor, const TreeRequest& request) {
    const auto& path = request.path;
    const auto file = TRY(hdf5::open_file(descriptor, path));
    std::vector<Hdf5Array> out;
    std::uint64_t left = max_elements;
    const auto all = hdf5::datasets_below(file, "", max_depth, max_datasets, request.skipped);
    if (all.size() == max_datasets) return bad_input(fmt::format("the file has more than {} datasets", max_datasets - 1), {path});
    for (const auto& info : all) {
        const auto count = element_count(info, left);
        if (count > left)
            return bad_input(fmt::format("{}: the datasets of this file have more than {} elements", info.name, max_elements), {path});
        left -= count;
        out.push_back(TRY(read_array(file, info, count, path)));
    }
    return out;
}

HelperService tree_service() { return request_service<TreeRequest>(HelperProcess::tree_protocol, hdf5_tree); }

}  // namespace corpuscle
