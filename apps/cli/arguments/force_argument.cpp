#include "cli/arguments/force_argument.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "core/stimulus/stimuli.hpp"
#include "skin/contact/contact.hpp"

namespace corpuscle {

bool is_force(const std::string& argument) {
    const auto touches = named_touches();
    std::error_code status;
    return is_stimulus(argument) || argument == "-" || std::filesystem::exists(argument, status) ||
           std::any_of(touches.begin(), touches.end(), [&](const NamedTouch& t) { return t.name == argument; });
}

Result<Applied<std::unique_ptr<ForceSource>>> open_force(const std::string& force, const RecordingOptions& options,
                                                         std::span<const ParameterOverride> overrides, double rate, std::uint64_t seed) {
    if (is_stimulus(force)) return make_stimulus(force, overrides, options.rate.value_or(rate), seed);
    std::error_code status;
    if (!std::filesystem::exists(force, status) && force.find_first_of("./") == std::string::npos && force != "-") {
        auto error = make_stimulus(force, rate, seed).error();
        error.message += fmt::format(" (and no file '{}' exists)", force.substr(0, 64));
        return error;
    }
    auto recording = TRY(open_recording(force == "-" ? "/dev/stdin" : force, options));
    return Applied<std::unique_ptr<ForceSource>>{std::move(recording), {overrides.begin(), overrides.end()}};
}

}  // namespace corpuscle
