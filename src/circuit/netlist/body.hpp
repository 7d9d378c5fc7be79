#pragma once
// A parsed netlist before any parameter has a value. Used inside circuit/netlist only.

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/netlist/formula.hpp"
#include "circuit/netlist/netlist.hpp"
#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {

inline constexpr std::size_t most_elements = 2000000;  // and statements
inline constexpr std::size_t most_text = std::size_t{256} << 20;  // bytes

/// A word of a statement whose value is not yet evaluated.
struct Text {
    const Statement* in = nullptr;
    Word word;
    std::string_view view() const { return in->text(word); }
    SourceLocation place() const { return in->place(word); }
};

template <class T>
using ByName = std::map<std::string, T, std::less<>>;

/// The top level of a netlist, or a subcircuit.
struct Body {
    std::string name;
    const Statement* head = nullptr;  ///< its .subckt line; null for the top level
    Body* outer = nullptr;            ///< the definition that contains this one
    std::vector<std::string> ports;
    ByName<Text> defaults;  ///< of the .subckt line
    ByName<Text> parameters;
    ByName<FormulaScope::Function> functions;
    ByName<const Statement*> models;
    ByName<std::unique_ptr<Body>> subcircuits;
    std::vector<const Statement*> elements, ics;  ///< ics: .ic and .nodeset
};

struct ParsedNetlist {
    std::string title, file;
    std::deque<Statement> statements;
    Body top;
    std::vector<const Statement*> commands, options, temperatures;
    std::set<std::string, std::less<>> globals;
    std::set<std::string, std::less<>> libraries;  ///< files whose sections were read by .lib
    std::vector<Error> remarks;
};

/// Reads the text and all files that it includes; `corner` as in Netlist::parse.
Result<void> read_netlist(const std::string& text, const std::string& file, const Netlist::Opener&, const std::string& corner,
                          ParsedNetlist&);

/// Warns about numbers whose meaning in SPICE differs from their appearance: 1F, 5M.
void remark_on_units(const Statement& element, std::vector<Error>& warnings);

inline bool is_ground(std::string_view node) { return node == "0" || node == "gnd"; }

/// The keys, for suggestions.
template <class Map>
std::vector<std::string_view> names_in(const Map& map) {
    std::vector<std::string_view> names;
    for (const auto& entry : map) names.push_back(entry.first);
    return names;
}

}  // namespace corpuscle::circuit
