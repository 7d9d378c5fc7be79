#pragma once
// The corner that a netlist is read for: its libraries' section of this name in place of the one that stands there. Inside circuit/netlist.

#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle::circuit {

class Corner {
    std::string wanted_;                  // "": none is asked for
    bool found_ = false;                  // some library has it
    std::vector<std::string> libraries_;  // those that have it not: "'card.lib' has tt, ss"

public:
    explicit Corner(std::string wanted) : wanted_(std::move(wanted)) {}

    /// The section to read of a library, by its name and its text, where the netlist asks for `section`.
    std::string in_place_of(const std::string& section, std::string_view library, std::string_view text);
    /// Once all is read: whether some library had it.
    Result<void> found(const std::string& netlist) const;
};

}  // namespace corpuscle::circuit
