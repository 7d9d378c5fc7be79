#pragma once
// The script between .control and .endc of ngspice. Used inside circuit/netlist only.

#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {

/// A script as directives: its analyses, measurements and prints.
struct ControlScript {
    static constexpr int any_analysis = -1;
    struct Command {
        LogicalLine line;  ///< in the form of a directive, ".print tran v(a)"
        bool is_analysis;
        int analysis = any_analysis;  ///< of a print or meas: the index in `commands` of the analysis to which it applies
    };
    std::vector<Command> commands;
    bool ends_netlist = false;  ///< .end followed instead of .endc
    bool is_stopped = false;    ///< the script ended early, so no later script of the netlist is run
    /// One for each kind of command without effect, each command that is left out, and the command that stops the script.
    std::vector<Error> warnings;
};

/// Reads the lines after .control, up to and including .endc; `from` is the line .control. Analyses, measurements, prints and the vectors
/// of let are taken as directives. Any other command gives a warning with its line. A command that changes the circuit ends the reading,
/// since the commands after it would mean something else. If an earlier script was stopped, none of the commands is taken.
Result<ControlScript> read_control_script(LogicalLineReader&, const LogicalLine& from, bool is_stopped);

}  // namespace corpuscle::circuit
