#pragma once
// What a sweep draws for its chips, told so that whoever has the results can draw it again: nothing of it needs to be stored a unit.

#include <cstdint>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

namespace circuit {
struct Circuit;
}

/// A transistor that draws its own threshold and current.
struct DrawnDevice {
    std::string name;          ///< with its path, small letters
    std::uint32_t number = 0;  ///< among those of its netlist that draw
    bool pmos = false;
    double W = 0, L = 0, m = 1, stack = 1;  ///< of a unit, m; how many side by side and in series
    double sigma_VT = 0, sigma_IS = 0;      ///< deviations: V; of the logarithm of I_SQ

    double area() const { return W * L * m * stack; }
};

/// The transistors that differ from chip to chip (what all of a chip share, the process, has axes of its own). Device `number` of chip c: normals(seed, number, ..., c), as mismatch() in circuit/device/uicm_card.hpp has them.
struct Drawn {
    std::uint64_t seed = 0;
    std::int64_t chips = 0;  ///< unit u is chip u % chips; 0: chip u
    struct Subject {
        std::string name;  ///< its measures are called NAME.MEASURE, unless it is the only one
        std::vector<DrawnDevice> devices;
    };
    std::vector<Subject> subjects;

    std::uint64_t chip(std::int64_t unit) const { return static_cast<std::uint64_t>(chips > 0 ? unit % chips : unit); }
};

/// The transistors of a netlist in the order in which they draw.
std::vector<DrawnDevice> drawn_devices(const circuit::Circuit&);

/// The fact of a sweep under which its draws stand.
inline constexpr const char* drawn_fact = "drawn";
/// As one fact of a sweep's, and back.
std::string text_of(const Drawn&);
Result<Drawn> drawn_of(const std::string& text);

/// Standard normal deviates, one for each chip: of a device's threshold and current.
struct DeviceDeviates {
    std::vector<double> V_T, I_S;
};
DeviceDeviates deviates_of(const DrawnDevice&, std::uint64_t seed, const std::vector<std::uint64_t>& chips);

}  // namespace corpuscle
