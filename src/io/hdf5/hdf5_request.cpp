#include "io/hdf5/hdf5_request.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include "core/text/input_files.hpp"
#include "io/table/archive.hpp"

namespace corpuscle {

Result<std::string> hdf5_response(const std::string& path, const std::string& protocol, const std::string& request) {
    const auto program = find_helper_program("corpuscle-hdf5");
    if (!program) return bad_input(program.error().message, {path});
    const auto bytes = TRY(open_bytes(path));  // for its clear messages
    if (bytes->size() == 0) return bad_input("this file is empty", {path});
    const auto file = open_input(path);
    if (!file) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    auto helper = HelperProcess::start(*program, fileno(file.get()), protocol);
    if (!helper) return bad_input(helper.error().message, {path});
    helper->send(request);
    return helper->receive(path, "the HDF5 library");
}

}  // namespace corpuscle
