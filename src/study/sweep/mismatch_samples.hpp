#pragma once
// The mismatch samples of a sweep's chips, described so that they can be recomputed from the results file. They are not stored for each
// chip.

#include <cstdint>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

namespace circuit {
struct Circuit;
}

/// A transistor with its own threshold and current mismatch.
struct MismatchDevice {
    std::string name;          ///< with its path, in lower case
    std::uint32_t number = 0;  ///< index among the transistors with mismatch in its netlist
    bool pmos = false;
    double W = 0, L = 0, m = 1, stack = 1;  ///< size of one element, m; number of elements in parallel and in series
    double sigma_VT = 0, sigma_IS = 0;      ///< standard deviations: of V_T in V, and of the logarithm of I_SQ

    double area() const { return W * L * m * stack; }
};

/// The transistors that differ from chip to chip. (Process parameters, which all transistors of a chip share, are axes.) The deviates of
/// device `number` on chip c are normals(seed, number, ..., c), see sample_mismatch() in circuit/device/uicm_card.hpp.
struct MismatchSamples {
    std::uint64_t seed = 0;
    std::int64_t chips = 0;  ///< item k is chip k % chips; if 0, chip k
    struct Subject {
        std::string name;  ///< its measures are called NAME.MEASURE, unless it is the only subject
        std::vector<MismatchDevice> devices;
    };
    std::vector<Subject> subjects;

    std::uint64_t chip(std::int64_t item) const { return static_cast<std::uint64_t>(chips > 0 ? item % chips : item); }
};

/// The transistors of a netlist in the order in which they are sampled.
std::vector<MismatchDevice> mismatch_devices(const circuit::Circuit&);

/// Name of the sweep's metadata entry with the samples.
inline constexpr const char* mismatch_metadata_name = "drawn";
/// Converts to and from the text of this metadata entry.
std::string format_mismatch_samples(const MismatchSamples&);
Result<MismatchSamples> parse_mismatch_samples(const std::string& text);

/// Standard normal deviates of a device's threshold and current, one for each chip.
struct DeviceDeviates {
    std::vector<double> V_T, I_S;
};
DeviceDeviates deviates_of(const MismatchDevice&, std::uint64_t seed, const std::vector<std::uint64_t>& chips);

}  // namespace corpuscle
