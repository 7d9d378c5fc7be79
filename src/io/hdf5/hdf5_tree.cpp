#include "io/hdf5/hdf5_tree.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include "core/bytes.hpp"
#include "io/output/descriptor.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"

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

std::string encode(const TreeRequest& request) {
    ByteWriter out;
    out.put(request);
    return out.take();
}

bool decode(const std::string& m, TreeRequest& request) { return ByteReader(m).get(request); }

std::string encode(const std::vector<Hdf5Array>& arrays) {
    ByteWriter out;
    out.put(std::uint64_t{0}, arrays);  // 0: not an error
    return out.take();
}

Result<std::vector<Hdf5Array>> decode_tree(const std::string& m, const std::string& path) {
    TRY(decode_status(m, path));
    ByteReader in(m);
    std::uint64_t status = 0;
    std::vector<Hdf5Array> arrays;
    bool ok = in.get(status, arrays);
    for (const auto& array : arrays) ok = ok && has_elements_of_shape(array);
    if (ok) return arrays;
    return bad_input("invalid response of the helper process that reads this file", {path});
}

Result<std::vector<Hdf5Array>> read_hdf5_tree(const std::string& path) {
    const auto program = find_helper_program("corpuscle-hdf5");
    if (!program) return bad_input(program.error().message, {path});
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
    if (!file) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    auto helper = HelperProcess::start(*program, file.get(), HelperProcess::tree_protocol);
    if (!helper) return bad_input(helper.error().message, {path});
    helper->send(encode(TreeRequest{path}));
    return decode_tree(TRY(helper->receive(path, "the HDF5 library")), path);
}

}  // namespace corpuscle
