#include "force_words.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "signal/stimuli.hpp"

namespace corpuscle {

Result<std::unique_ptr<Source>> open_force(const std::string& force, const RecordingOptions& options, std::span<const Wish> wishes,
                                           double rate, std::uint64_t seed) {
    if (is_stimulus(force)) return make_stimulus(force, wishes, options.rate.value_or(rate), seed);
    std::error_code status;
    if (!std::filesystem::exists(force, status) && force.find_first_of("./") == std::string::npos && force != "-") {
        auto error = make_stimulus(force, wishes, rate, seed).error();
        error.sentence += fmt::format(" (and there is no file '{}')", force.substr(0, 64));
        return error;
    }
    return open_recording(force == "-" ? "/dev/stdin" : force, options);
}

}  // namespace corpuscle
