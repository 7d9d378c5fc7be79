#pragma once
// Selects a process corner: libraries are read with the section of this name instead of the section that the netlist names. Used inside
// circuit/netlist only.

#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle::circuit {

class CornerSelector {
    std::string corner_;                  // "" if no corner is requested
    bool is_found_ = false;               // at least one library has the corner
    std::vector<std::string> libraries_;  // libraries without the corner: "'card.lib' has tt, ss"

public:
    explicit CornerSelector(std::string corner) : corner_(std::move(corner)) {}

    /// The section to read from a library, given by name and text, where the netlist requests `section`.
    std::string select_section(const std::string& section, std::string_view library, std::string_view text);
    /// Call this after all files are read. Fails if no library had the requested corner.
    Result<void> check_found(const std::string& netlist) const;
};

}  // namespace corpuscle::circuit
