#pragma once
// The commands of ngspice's scripts that are not run here. Used inside circuit/netlist only.

#include <map>
#include <string_view>
#include <vector>

#include "circuit/error_at.hpp"

namespace corpuscle::circuit {

struct ScriptCommand {
    enum class Effect {
        none,          ///< it changes no result
        selects_plot,  ///< the vectors after it are those of a plot that does not exist here
        block,         ///< its commands, up to `end`, depend on a condition or are repeated
        changes,       ///< it changes the circuit or the order of commands, so the rest of the script is not run
        ends           ///< it ends the script
    };
    std::string_view name;
    Effect effect;
    std::string_view remedy;
};

/// The row of a command; null for one that is unknown.
const ScriptCommand* find_script_command(std::string_view name);
/// The names of all commands, for suggestions.
std::vector<std::string_view> script_command_names();
/// True for a variable of `set` that is an option of the circuit, such as temp.
bool is_circuit_variable(std::string_view name);

/// The commands of a script that have no effect. There is one warning for all commands of a name, located at the first of them.
class IgnoredCommands {
    struct Ignored {
        SourceLocation location;
        std::string name, remedy;
        int count;
    };
    std::vector<Ignored> commands_;
    std::map<std::string, std::size_t, std::less<>> numbers_;  // by name, index in commands_

public:
    void add(const std::string& name, SourceLocation, std::string_view remedy);
    void add_warnings(std::vector<Error>&) const;
};

}  // namespace corpuscle::circuit
