#pragma once
// The script between .control and .endc of ngspice. Used inside circuit/netlist only.

#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {

/// A script as directives: its analyses, measurements and prints.
struct ControlScript {
    struct Command {
        LogicalLine line;  ///< in the form of a directive, ".print tran v(a)"
        bool is_analysis;
    };
    std::vector<Command> commands;
    std::vector<Error> warnings;  ///< for commands without effect, and where the reading ended
};

/// Reads the lines after .control, up to and including .endc; `from` is the line .control. Its analyses, measurements and prints are taken as
/// directives; commands that only show results have no effect. A command that changes the circuit or repeats others ends the reading, since
/// the commands after it would mean something else.
Result<ControlScript> read_control_script(LogicalLineReader&, const LogicalLine& from);

}  // namespace corpuscle::circuit
