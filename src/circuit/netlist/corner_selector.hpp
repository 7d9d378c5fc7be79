#pragma once
// Selects a process corner: from each library the section with the name of the corner is read, instead of the section that the netlist
// names. Used inside circuit/netlist only.

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::circuit {

class CornerSelector {
    std::string corner_;                  // "" if no corner is requested
    bool is_found_ = false;               // at least one library has the corner
    std::vector<std::string> libraries_;  // libraries without the corner, for the error: "'card.lib' has tt, ss"

public:
    explicit CornerSelector(std::string corner) : corner_(std::move(corner)) {}

    /// The section to read from a library where the netlist names `section`. `library` is the file's name and `text` its contents. A
    /// library that does not have the corner keeps `section`.
    std::string select_section(const std::string& section, std::string_view library, std::string_view text);
    /// Call this after all files are read. Returns an error if a corner was requested and no library had it.
    Result<void> check_found(const std::string& netlist) const;
};

}  // namespace corpuscle::circuit
