#include "cli/arguments/force_argument.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "core/stimulus/stimuli.hpp"

namespace corpuscle {
namespace {

bool is_file(const std::string& path) {
    std::error_code status;
    return path == "-" || std::filesystem::exists(path, status);
}

}  // namespace

ForceArgument read_force(std::string text) {
    const auto all = named_touches();
    const auto touch = std::find_if(all.begin(), all.end(), [&](const NamedTouch& t) { return t.name == text; });
    const bool is_of_catalog = is_stimulus(text);
    return {std::move(text), is_of_catalog, touch == all.end() ? nullptr : &*touch};
}

bool is_force(const std::string& argument) {
    const auto force = read_force(argument);
    return force.is_stimulus || force.touch || is_file(argument);
}

Result<Applied<std::unique_ptr<ForceSource>>> ForceArgument::open(const RecordingOptions& options,
                                                                  std::span<const ParameterOverride> overrides, double rate,
                                                                  std::uint64_t seed) const {
    if (is_stimulus) return make_stimulus(text, overrides, options.rate.value_or(rate), seed);
    if (!is_file(text) && text.find_first_of("./") == std::string::npos) {
        auto error = make_stimulus(text, rate, seed).error();
        error.message += fmt::format(" (and no file '{}' exists)", text.substr(0, 64));
        return error;
    }
    auto recording = TRY(open_recording(text == "-" ? "/dev/stdin" : text, options));
    return Applied<std::unique_ptr<ForceSource>>{std::move(recording), {overrides.begin(), overrides.end()}};
}

}  // namespace corpuscle
