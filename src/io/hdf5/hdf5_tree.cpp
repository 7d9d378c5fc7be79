#include "io/hdf5/hdf5_tree.hpp"

#include "io/hdf5/hdf5_request.hpp"
#include "io/sandbox/helper_messages.hpp"

namespace corpuscle {
namespace {

bool has_elements_of_shape(const Hdf5Array& array) {
    std::uint64_t count = 1;
    for (const auto n : array.shape) {
        if (n > 0 && count > array.element_count() / n) return false;
        count *= n;
    }
    return count == array.element_count();
}

}  // namespace

Result<std::vector<Hdf5Array>> decode_tree(const std::string& m, const std::string& path) {
    auto arrays = TRY(decode_response<std::vector<Hdf5Array>>(m, path));
    for (const auto& array : arrays)
        if (!array.is_other && !has_elements_of_shape(array)) return broken_response(path);
    return arrays;
}

Result<std::vector<Hdf5Array>> read_hdf5_tree(const std::string& path, const std::string& skipped) {
    return decode_tree(TRY(hdf5_response(path, HelperProcess::tree_protocol, encode_request(TreeRequest{path, skipped}))), path);
}

}  // namespace corpuscle
