#include "circuit/netlist/script/script_commands.hpp"

#include <algorithm>

namespace corpuscle::circuit {
namespace {

using Effect = ScriptCommand::Effect;
constexpr std::string_view shows_curves = "-o x.csv or -o x.raw writes the curves, and print shows columns";
constexpr std::string_view writes_no_file = "a script writes no file; -o x.csv or -o x.raw writes the curves";
constexpr std::string_view shows_text = "it only shows text";
constexpr std::string_view of_ngspice = "it only concerns ngspice itself";
constexpr std::string_view edits_vectors = "measure with meas, or compute with let";
constexpr std::string_view alters = "set the value with --set, or write .param and .step param";
constexpr std::string_view is_branch = "write those of one branch directly";
constexpr std::string_view is_loop = "write those of one pass directly, with .step for values that change";
constexpr std::string_view is_jump = "write the commands in the order in which they are run";
constexpr std::string_view runs_no_program = "a netlist starts no program";

constexpr ScriptCommand script_commands[] = {
    {"plot", Effect::none, shows_curves},
    {"iplot", Effect::none, shows_curves},
    {"asciiplot", Effect::none, shows_curves},
    {"gnuplot", Effect::none, shows_curves},
    {"hardcopy", Effect::none, shows_curves},
    {"write", Effect::none, writes_no_file},
    {"wrdata", Effect::none, writes_no_file},
    {"wrs2p", Effect::none, writes_no_file},
    {"snsave", Effect::none, writes_no_file},
    {"save", Effect::none, "all curves are kept; .save outside of the script selects those of -o"},
    {"iprobe", Effect::none, "all curves are kept"},
    {"trace", Effect::none, shows_text},
    {"echo", Effect::none, shows_text},
    {"display", Effect::none, shows_text},
    {"listing", Effect::none, shows_text},
    {"show", Effect::none, ".op prints a table of the devices"},
    {"showmod", Effect::none, shows_text},
    {"rusage", Effect::none, shows_text},
    {"status", Effect::none, shows_text},
    {"inventory", Effect::none, shows_text},
    {"version", Effect::none, shows_text},
    {"help", Effect::none, shows_text},
    {"history", Effect::none, shows_text},
    {"set", Effect::none, "its variables are known to the script only"},
    {"unset", Effect::none, ""},
    {"setseed", Effect::none, "--mismatch SEED selects the random values"},
    {"setcirc", Effect::none, "there is one circuit"},
    {"settype", Effect::none, of_ngspice},
    {"setscale", Effect::none, of_ngspice},
    {"alias", Effect::none, of_ngspice},
    {"define", Effect::none, "write the function where it is used; .func defines one for the circuit"},
    {"undefine", Effect::none, of_ngspice},
    {"destroy", Effect::none, of_ngspice},
    {"remzerovec", Effect::none, of_ngspice},
    {"unlet", Effect::none, ""},
    {"reset", Effect::none, "each analysis begins with the circuit as it is written"},
    {"compose", Effect::none, edits_vectors},
    {"reshape", Effect::none, edits_vectors},
    {"transpose", Effect::none, edits_vectors},
    {"cross", Effect::none, edits_vectors},
    {"diff", Effect::none, edits_vectors},
    {"strcmp", Effect::none, edits_vectors},
    {"bug", Effect::none, of_ngspice},
    {"label", Effect::none, of_ngspice},
    {"linearize", Effect::none, "print has rows at every STEP of .tran"},
    {"fft", Effect::selects_plot, ".four gives the harmonics"},
    {"psd", Effect::selects_plot, ".four gives the harmonics"},
    {"spec", Effect::selects_plot, ".four gives the harmonics"},
    {"cutout", Effect::selects_plot, "meas with from= and to= takes a part of a curve"},
    {"sp", Effect::selects_plot, "there is no analysis of scattering parameters; use ac"},
    {"pss", Effect::selects_plot, "there is no periodic steady state; use tran"},
    {"disto", Effect::selects_plot, "there is no .disto; use tran and fourier"},
    {"if", Effect::block, is_branch},
    {"while", Effect::block, is_loop},
    {"dowhile", Effect::block, is_loop},
    {"repeat", Effect::block, is_loop},
    {"foreach", Effect::block, is_loop},
    {"alter", Effect::changes, alters},
    {"altermod", Effect::changes, "give the model another name and value in the netlist"},
    {"alterparam", Effect::changes, "set the parameter with --set, or write .step param"},
    {"option", Effect::changes, "write .options outside of the script"},
    {"optran", Effect::changes, "remove it: the operating point is found without it"},
    {"mc_source", Effect::changes, ".mc COUNT or --mismatch SEED draws random values"},
    {"source", Effect::changes, "read the file with .include"},
    {"edit", Effect::changes, "change the netlist itself"},
    {"load", Effect::changes, "compare files outside of the netlist"},
    {"snload", Effect::changes, "compare files outside of the netlist"},
    {"remcirc", Effect::changes, "write one netlist for each circuit"},
    {"stop", Effect::changes, "end the transient with its STOP time"},
    {"step", Effect::changes, "end the transient with its STOP time"},
    {"resume", Effect::changes, "end the transient with its STOP time"},
    {"goto", Effect::changes, is_jump},
    {"break", Effect::changes, is_jump},
    {"continue", Effect::changes, is_jump},
    {"shell", Effect::none, runs_no_program},
    {"cd", Effect::none, runs_no_program},
    {"codemodel", Effect::none, "there are no code models"},
    {"osdi", Effect::none, "there are no compiled models"},
    {"pre_osdi", Effect::none, "there are no compiled models"},
    {"quit", Effect::ends, ""},
    {"exit", Effect::ends, ""},
};

}  // namespace

const ScriptCommand* find_script_command(std::string_view name) {
    const auto* found = std::ranges::find(script_commands, name, &ScriptCommand::name);
    return found == std::end(script_commands) ? nullptr : found;
}

std::vector<std::string_view> script_command_names() {
    std::vector<std::string_view> out;
    for (const auto& row : script_commands) out.push_back(row.name);
    return out;
}

bool is_circuit_variable(std::string_view name) {
    constexpr std::string_view names[] = {"temp",  "tnom", "reltol", "abstol", "vntol", "chgtol",
                                          "trtol", "gmin", "method", "maxord", "rshunt"};
    return std::ranges::find(names, name) != std::end(names);
}

void IgnoredCommands::add(const std::string& name, SourceLocation location, std::string_view remedy) {
    const auto [known, is_new] = numbers_.try_emplace(name, commands_.size());
    if (!is_new) return void(++commands_[known->second].count);
    commands_.push_back({std::move(location), name, std::string(remedy), 1});
}

void IgnoredCommands::add_warnings(std::vector<Error>& out) const {
    for (const auto& command : commands_) {
        const auto others = command.count == 1 ? std::string() : fmt::format(" (and {} more)", command.count - 1);
        const auto* row = find_script_command(command.name);
        if (row != nullptr && row->effect == Effect::block)
            out.push_back(error_at(command.location, ".control: the commands of this '{}' up to 'end' are skipped{}; {}", command.name,
                                   others, command.remedy));
        else
            out.push_back(error_at(command.location, ".control: '{}' has no effect here{}: {}", command.name, others, command.remedy));
    }
}

}  // namespace corpuscle::circuit
