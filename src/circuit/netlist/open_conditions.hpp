#pragma once
// The lines .if, .elseif, .else and .endif. Used inside circuit/netlist only.

#include <deque>
#include <utility>
#include <vector>

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// The .if lines that are not yet closed at the line that is being read.
class OpenConditions {
    struct OpenIf {
        int outer, branch;  // indices in SubcktDef::conditions; -1: none
        bool has_else;
        SourceLocation location;
    };
    std::vector<OpenIf> open_;    // outermost first
    std::size_t file_begin_ = 0;  // number of those that were open when the present file began; its lines must not close them

public:
    bool is_open() const { return !open_.empty(); }
    /// Index in SubcktDef::conditions of the branch that contains the line; -1: none.
    int branch() const { return is_open() ? open_.back().branch : -1; }

    /// Begins a file; returns the value for leave_file().
    std::size_t enter_file() { return std::exchange(file_begin_, open_.size()); }
    void leave_file(std::size_t outer) { file_begin_ = outer; }
    /// Returns an error if the present file leaves an .if open.
    Result<void> check_closed() const;

    /// Reads a line of .if, .elseif or .else, and adds its branch to the definition.
    Result<void> begin_branch(LogicalLine, SubcktDef&, std::deque<Statement>&);
    /// Reads .endif, which closes the innermost .if.
    Result<void> close(SourceLocation);
};

}  // namespace corpuscle::circuit
