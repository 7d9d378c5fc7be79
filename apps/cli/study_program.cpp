#include "cli/study_program.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/output/terminal.hpp"

namespace corpuscle {

int start_study_program(const std::vector<std::string>& arguments) {
    std::error_code unknown;
    const auto path = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / "corpuscle-study";
    std::vector<std::string> all = {"corpuscle"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& argument : all) argv.push_back(argument.data());
    argv.push_back(nullptr);
    ::execv(path.c_str(), argv.data());
    if (errno != ENOENT) return report_error(bad_input(fmt::format("cannot start {}: {}", path.string(), std::strerror(errno))));
    return report_error(bad_input(fmt::format("study: the program corpuscle-study is not in {}; 'make reproduction' in the clone builds it",
                                              path.parent_path().string())));
}

}  // namespace corpuscle
