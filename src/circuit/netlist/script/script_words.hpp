#pragma once
// The words of the commands in a script of ngspice. Used inside circuit/netlist only.

#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {

/// A part of a command that blanks and commas outside parentheses separate.
struct ScriptWord {
    std::string text;
    std::size_t at;  ///< its offset in the command
};

/// The words of a command from an offset on.
std::vector<ScriptWord> split_script_words(std::string_view text, std::size_t from);
/// Joins the words of an expression with blanks around its operators: "v(a)", "-", "v(b)".
std::vector<ScriptWord> joined_expressions(std::vector<ScriptWord>);
/// The name of a command or directive; the text begins with a dot.
inline std::string_view command_name(std::string_view text) { return text.substr(1, text.find_first_of(" \t(") - 1); }

/// True for the names v and i, and for the same with the part of a complex curve: vm, vdb, vp, vr, vi, im ...
bool is_curve_function(std::string_view name);
/// True for a curve that a print names directly: v(a), vdb(a), i(v1), all, v1#branch, or a name.
bool is_plain_curve(std::string_view text);

/// A directive that replaces a command. Its words keep the locations that they have in the command.
class DirectiveText {
    LogicalLine line_;
    const LogicalLine& command_;

public:
    DirectiveText(const LogicalLine& command, std::string_view name);
    void add(std::string_view word, std::size_t at);
    LogicalLine take() { return std::move(line_); }

private:
    void locate(std::size_t offset, std::size_t at);
};

}  // namespace corpuscle::circuit
