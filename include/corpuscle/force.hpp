#pragma once
// Force over time: of a stimulus, of a recording, or of the caller.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// How a force was read or computed: metadata, phases, quality. A response to the force has it in its summary, warnings and report.
struct ForceOrigin;

/// Force on one or more channels, evenly sampled.
struct Force {
    std::string name = "force";
    double rate = 10e3;                              ///< Hz
    double start = 0;                                ///< s, time of the first sample
    std::vector<std::string> channels = {};          ///< their names
    std::vector<std::vector<double>> samples = {};   ///< N, [channel][sample]; all channels have equally many
    std::vector<std::string> notes = {};             ///< about how a recording was read
    std::vector<std::string> warnings = {};          ///< about faults that make responses doubtful
    std::shared_ptr<const ForceOrigin> origin = {};  ///< null: a force of the caller
};

/// Force in memory of the caller, which it must not change meanwhile. Nothing is copied.
struct ForceView {
    std::string name = "force";
    double rate = 10e3;                              ///< Hz
    double start = 0;                                ///< s, time of the first sample
    std::vector<std::string> channels = {};          ///< their names; empty: ch1, ch2 ...
    std::vector<const double*> samples = {};         ///< for each channel, its first sample, N
    std::size_t count = 0;                           ///< number of samples of each channel
    std::ptrdiff_t stride = 1;                       ///< distance from one sample of a channel to the next, in doubles
    std::shared_ptr<const ForceOrigin> origin = {};  ///< of the force; null: none

    ForceView() = default;
    CORPUSCLE_API ForceView(const Force&);
    CORPUSCLE_API ForceView(double rate, std::span<const double> force);
};

/// Computes a stimulus by name, or a sum of stimuli ("press+noise"), with settings such as "press.F_max=2N". `rate` is the sample rate in
/// Hz; `seed` is for random stimuli such as noise. Throws InputError.
CORPUSCLE_API Force stimulus(const std::string& name, const std::vector<std::string>& settings = {}, double rate = 10e3,
                             std::uint64_t seed = 0);

/// An origin as text, and back. Throws InputError for another text.
CORPUSCLE_API std::string save_origin(const ForceOrigin&);
CORPUSCLE_API std::shared_ptr<const ForceOrigin> load_origin(const std::string& text);

/// An option by its name on the command line without dashes, and its value: {"unit", "mN"}. The value of a flag is "true" or "false".
using Options = std::vector<std::pair<std::string, std::string>>;

/// Reads a recording. The options are those for recordings of `corpuscle respond --help-all`, and "rate". Throws InputError.
CORPUSCLE_API Force read_recording(const std::string& path, const Options& = {});

}  // namespace corpuscle
