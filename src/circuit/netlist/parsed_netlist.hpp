#pragma once
// A parsed netlist before any parameter has a value. Used inside circuit/netlist only.

#include <deque>
#include <set>

#include "circuit/netlist/netlist.hpp"
#include "circuit/netlist/statement.hpp"
#include "circuit/refusals.hpp"

namespace corpuscle::circuit {

inline constexpr std::size_t max_elements = 2000000;                   // limit for elements, for statements and for included files
inline constexpr std::size_t max_text_bytes = std::size_t{256} << 20;  // limit for all files together

/// A word of a statement, kept for later evaluation.
struct WordRef {
    const Statement* statement = nullptr;
    Word word;
    std::string_view view() const { return statement->text(word); }
    SourceLocation location() const { return statement->location(word); }
};

template <class T>
using ByName = std::map<std::string, T, std::less<>>;

/// A branch of .if, .elseif or .else.
struct Condition {
    int outer = -1;                    ///< index of the branch that contains it; -1: none
    int previous = -1;                 ///< index of the branch before it in the same .if; -1: none
    const Statement* line = nullptr;   ///< the line that begins it
    std::optional<WordRef> text = {};  ///< its expression; none for .else
};

/// The definition of a subcircuit, or the top level of a netlist. Statements are pointers into ParsedNetlist::statements.
struct SubcktDef {
    std::string name;                 ///< "" for the top level
    const Statement* head = nullptr;  ///< its .subckt line; null for the top level
    SubcktDef* outer = nullptr;       ///< the definition that contains this one
    std::vector<std::string> ports;
    ByName<WordRef> defaults;                                              ///< default values of the parameters in the .subckt line
    ByName<WordRef> parameters;                                            ///< values of the .param lines
    ByName<ExpressionScope::Function> functions;                           ///< .func f(x)=... and .param f(x)=...
    ByName<std::vector<const Statement*>> models;                          ///< several of one name only in different branches of .if
    std::vector<const std::vector<const Statement*>*> alternative_models;  ///< those of `models` that have several lines
    std::vector<Condition> conditions;                                     ///< each after those that it refers to
    std::map<int, Refusals> branch_refusals;  ///< errors of the lines in a branch of .if, by its index; they matter only if it holds
    ByName<std::unique_ptr<SubcktDef>> subcircuits;
    std::vector<const Statement*> elements, ics;  ///< element lines, X lines included; .ic and .nodeset lines
};

struct ParsedNetlist {
    std::string title, file;
    std::deque<Statement> statements;  ///< a deque, since it does not move its elements when it grows
    SubcktDef top;
    std::vector<const Statement*> directives, options, temperatures;  ///< Circuit::directives; .options lines; .temp lines
    std::vector<const Statement*> set_lines;                          ///< .set lines
    std::set<std::string, std::less<>> globals;                       ///< nodes of .global
    std::set<std::string, std::less<>> libraries;                     ///< files from which .lib read a section
    std::set<std::string, std::less<>> marks;                         ///< directives that show for which simulator the netlist is written
    std::vector<Error> warnings;
};

struct Netlist::Impl : ParsedNetlist {};

/// Selects a process corner: from each library the section with the name of the corner is read, instead of the section that the netlist
/// names.
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

/// Reads the text and all files that it includes. For `corner`, see Netlist::parse(). Errors in single statements are added to the
/// refusals; an error after which nothing more can be read is returned.
Result<void> read_netlist(const std::string& text, const std::string& file, const Netlist::FileOpener&, const std::string& corner,
                          ParsedNetlist&, Refusals&);

/// The errors of the elements of a netlist whose other statements have errors.
Refusals find_refused_elements(const ParsedNetlist&);

/// Appends a warning for each number of an element line that users often take for another one: 1F is 1 femtofarad, 5M is 5 milli.
void warn_about_units(const Statement& element, std::vector<Error>& warnings);

bool is_option(std::string_view name);                ///< true for an option that has an effect here
bool is_small_element_option(std::string_view name);  ///< true for rshunt, cshunt ... which add small elements in other simulators
/// True for a name that is not an option of ours or of ngspice, and does not resemble one, so that it is not a typing error.
bool is_foreign_option(std::string_view name);

/// The first word of Xyce's .options, which says to what they belong.
enum class XycePackage { none, devices, other };
XycePackage xyce_package(std::string_view word);

struct RenamedDirective {
    std::string_view old_name, new_name;
};
inline constexpr RenamedDirective renamed_directives[] = {{".within", ".assert"}};

}  // namespace corpuscle::circuit
