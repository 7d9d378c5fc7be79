#pragma once
// A parsed netlist before any parameter has a value. Used inside circuit/netlist only.

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/netlist/expression.hpp"
#include "circuit/netlist/netlist.hpp"
#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {

inline constexpr std::size_t max_elements = 2000000;                   // limits elements, statements and included files
inline constexpr std::size_t max_text_bytes = std::size_t{256} << 20;  // limit for all files together

/// A word of a statement whose value is not yet evaluated.
struct WordRef {
    const Statement* statement = nullptr;
    Word word;
    std::string_view view() const { return statement->text(word); }
    SourceLocation location() const { return statement->location(word); }
};

template <class T>
using ByName = std::map<std::string, T, std::less<>>;

/// The top level of a netlist, or a subcircuit.
struct SubcktDef {
    std::string name;
    const Statement* head = nullptr;  ///< its .subckt line; null for the top level
    SubcktDef* outer = nullptr;       ///< the definition that contains this one
    std::vector<std::string> ports;
    ByName<WordRef> defaults;  ///< default values of the parameters in the .subckt line
    ByName<WordRef> parameters;
    ByName<ExpressionScope::Function> functions;
    ByName<const Statement*> models;
    ByName<std::unique_ptr<SubcktDef>> subcircuits;
    std::vector<const Statement*> elements, ics;  ///< ics: .ic and .nodeset
};

struct ParsedNetlist {
    std::string title, file;
    std::deque<Statement> statements;
    SubcktDef top;
    std::vector<const Statement*> directives, options, temperatures;
    std::set<std::string, std::less<>> globals;
    std::set<std::string, std::less<>> libraries;  ///< files whose sections were read by .lib
    std::vector<Error> warnings;
};

/// Reads the text and all files that it includes; `corner` as in Netlist::parse.
Result<void> read_netlist(const std::string& text, const std::string& file, const Netlist::FileOpener&, const std::string& corner,
                          ParsedNetlist&);

/// Warns about numbers whose meaning in SPICE differs from their appearance: 1F, 5M.
void warn_about_units(const Statement& element, std::vector<Error>& warnings);

inline bool is_ground(std::string_view node) { return node == "0" || node == "gnd"; }

/// The keys, for suggestions.
template <class Map>
std::vector<std::string_view> keys_of(const Map& map) {
    std::vector<std::string_view> names;
    for (const auto& entry : map) names.push_back(entry.first);
    return names;
}

}  // namespace corpuscle::circuit
