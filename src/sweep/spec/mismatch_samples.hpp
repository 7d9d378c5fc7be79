#pragma once
// The description of the mismatch in a sweep's chips, which is a metadata entry of the results. The mismatch of each transistor of each
// chip can be computed again from it, and is not stored itself.

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

namespace circuit {
struct Circuit;
}

/// A transistor whose threshold V_T and specific current I_SQ differ from chip to chip.
struct MismatchDevice {
    std::string name;                       ///< with the path of its subcircuits, in lower case: "summer.n3b"
    std::uint32_t number = 0;               ///< index among the transistors with mismatch in its netlist
    bool pmos = false;                      ///< true: P-channel, false: N-channel
    double W = 0, L = 0, m = 1, stack = 1;  ///< W, L: size of one element, m; m, stack: number of elements in parallel, in series
    double sigma_VT = 0, sigma_IS = 0;      ///< standard deviations: of V_T in V, and of the logarithm of I_SQ

    /// Total gate area, m^2.
    double area() const { return W * L * m * stack; }
};

/// The transistors that differ from chip to chip, without the process parameters, which all transistors of a chip share and which are axes.
/// deviates_of() computes their deviates.
struct MismatchSamples {
    std::uint64_t seed = 0;
    std::int64_t chips = 0;  ///< number of chips: item k is chip k % chips; 0: item k is chip k
    struct Subject {
        std::string name;  ///< of the afferent or netlist; if there are several subjects, their measures are called NAME.MEASURE
        std::vector<MismatchDevice> devices;
    };
    std::vector<Subject> subjects;

    /// Number of the chip of an item.
    std::uint64_t chip(std::int64_t item) const { return static_cast<std::uint64_t>(chips > 0 ? item % chips : item); }
};

/// The transistors of a netlist in the order in which they are sampled.
std::vector<MismatchDevice> mismatch_devices(const circuit::Circuit&);

/// Name of the metadata entry that contains a MismatchSamples.
inline constexpr const char* mismatch_metadata_name = "drawn";
/// Converts to and from the text of this metadata entry.
std::string format_mismatch_samples(const MismatchSamples&);
Result<MismatchSamples> parse_mismatch_samples(const std::string& text);

/// Standard normal deviates of one device, one for each chip: of its threshold, and of the logarithm of its specific current.
struct DeviceDeviates {
    std::vector<double> V_T, I_S;
};
/// `chips`: numbers of the chips.
DeviceDeviates deviates_of(const MismatchDevice&, std::uint64_t seed, const std::vector<std::uint64_t>& chips);

}  // namespace corpuscle
