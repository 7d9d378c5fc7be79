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
    bool ends_netlist = false;    ///< .end followed instead of .endc
    std::vector<Error> warnings;  ///< for commands without effect, and where the reading ended
};

/// Reads the lines after .control, up to and including .endc; `from` is the line .control. Analyses, measurements, prints and the vectors
/// of let are taken as directives. Any other command gives a warning with its line. A command that changes the circuit ends the reading,
/// since the commands after it would mean something else.
Result<ControlScript> read_control_script(LogicalLineReader&, const LogicalLine& from);

}  // namespace corpuscle::circuit
