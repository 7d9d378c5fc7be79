// Finds the helper programs. This is a separate file because only its compile options define the names of the libexec directory:
// CORPUSCLE_LIBEXEC_DIRECTORY (complete path), CORPUSCLE_LIBEXEC_NAME (relative to the install prefix) and CORPUSCLE_LIBEXEC_FROM_LIBRARY
// (relative to the directory of the installed shared library).

#include <dlfcn.h>
#include <fmt/format.h>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "io/sandbox/helper_process.hpp"

namespace corpuscle {
namespace {

/// The directory of the shared object that contains this code: the shared library, or the extension module of the Python package. Empty if
/// it is not known.
std::filesystem::path object_directory() {
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&find_helper_program), &info) == 0 || !info.dli_fname) return {};
    const std::filesystem::path file = info.dli_fname;
    return file.is_absolute() ? file.parent_path() : std::filesystem::path();
}

/// The directories to search, in this order.
std::vector<std::filesystem::path> directories() {
    if (const char* set = ::secure_getenv("CORPUSCLE_LIBEXEC"); set && *set) return {set};
    std::vector<std::filesystem::path> out;
    if (const auto object = object_directory(); !object.empty())
        out.push_back(object), out.push_back((object / CORPUSCLE_LIBEXEC_FROM_LIBRARY).lexically_normal());
    std::error_code unknown;  // set if the path of the running program is not known; `self` is then empty
    if (const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path(); !self.empty()) {
        out.push_back(self);
        out.push_back(self.parent_path() / CORPUSCLE_LIBEXEC_NAME / "corpuscle");
    }
    out.emplace_back(CORPUSCLE_LIBEXEC_DIRECTORY);
    return out;
}

}  // namespace

Result<std::string> find_helper_program(const std::string& name) {
    const auto all = directories();
    std::string tried;
    for (const auto& directory : all) {
        const auto path = directory / name;
        if (::access(path.c_str(), X_OK) == 0) return path.string();
        tried += (tried.empty() ? "" : ", ") + directory.string();
    }
    return bad_input(
        fmt::format("the program '{}', which reads this format, was not found in {}; set CORPUSCLE_LIBEXEC to its directory", name, tried));
}

}  // namespace corpuscle
