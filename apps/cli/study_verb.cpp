// corpuscle study: starts corpuscle-study, the program of the reproduction (reproduction/program), with the same arguments.

#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"

namespace corpuscle {
namespace {

/// Replaces this process by corpuscle-study. Returns only if this fails.
Error start_study_program(const std::vector<std::string>& words) {
    std::error_code unknown;
    const auto path = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / "corpuscle-study";
    std::vector<std::string> all = {"corpuscle"};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (auto& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(path.c_str(), argv.data());
    if (errno != ENOENT) return bad_input(fmt::format("cannot start {}: {}", path.string(), std::strerror(errno)));
    return bad_input(fmt::format("study: the program corpuscle-study is not in {}; 'make reproduction' in the clone builds it",
                                 path.parent_path().string()));
}

}  // namespace

Verb make_study_verb() {
    return {.name = "study",
            .description = "reproduce published results and compare them with the published numbers",
            .run = [](const CommonArguments& common) { return report_error(start_study_program(common.words)); },
            .is_program = true};
}

}  // namespace corpuscle
