#pragma once
// How a foundry's kit spells transistors in ngspice: a text file in TOML. doc/kits.md has the list of its keys.

#include <array>
#include <map>
#include <optional>

#include "core/text/config_file.hpp"

namespace corpuscle::circuit {

/// The four transistors of a netlist with UICM cards. hv: the higher threshold.
enum class KitDevice { nch, pch, hv_nch, hv_pch };
inline constexpr std::string_view kit_device_names[] = {"nch", "pch", "hv_nch", "hv_pch"};

struct KitMap {
    std::string name;                        ///< of the map, for messages
    bool is_subcircuit = false;              ///< true: an instance is X, false: M
    double length_unit = 1;                  ///< m: unit of w and l
    std::vector<std::string> multipliers;    ///< parameters of an instance that get the number of columns
    bool has_areas = true;                   ///< true: an instance takes ad, as, pd, ps
    bool has_temperature = true;             ///< true: an instance takes temp and dtemp
    std::string threshold;                   ///< parameter that is added to the threshold; "": a voltage source at the gate does it
    bool pmos_threshold_is_negative = true;  ///< true: a PMOS with a higher threshold has a negative value of `threshold`
    std::optional<double> hv_shift;          ///< V: higher threshold minus the standard one, if the netlist's models do not tell
    std::string mobility;                    ///< parameter that multiplies the mobility; "": none
    std::vector<std::string> lines, mismatch_lines, last_lines;  ///< in the deck before the transistors, the same with mismatch, after them
    std::array<std::string, 4> devices;                          ///< by KitDevice; "": the kit has none
    std::map<std::string, KitDevice, std::less<>> models;        ///< by the name of a netlist's model, in small letters
    std::map<std::string, std::string, std::less<>> corners;     ///< the kit's section by the name of a corner, in small letters

    const std::string& device(KitDevice d) const { return devices[static_cast<std::size_t>(d)]; }
};

/// Reads a map. `name` is its name for messages.
Result<KitMap> parse_kit_map(std::string_view text, const std::string& name);

/// The built-in map of this name, or that in the file at this path.
Result<KitMap> read_kit_map(const std::string& name_or_path);

/// The names of the built-in maps.
std::vector<std::string> kit_map_names();

/// Returns an error if a text is not a name that ngspice reads as one word. `label` begins the message: "--nch".
Result<void> check_kit_name(std::string_view label, std::string_view name);

/// A line of a map with {card}, {folder} and {corner} replaced.
struct KitPlaceholders {
    std::string card, folder, corner;
};
Result<std::string> fill_kit_line(const std::string& line, const KitPlaceholders&);

}  // namespace corpuscle::circuit
