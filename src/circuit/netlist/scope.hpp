#pragma once
// A scope of the elaboration: the top level, or an instance of a subcircuit (X), with its parameters evaluated. Used inside
// circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"
#include "circuit/netlist/random_values.hpp"
#include "circuit/similar_names.hpp"

namespace corpuscle::circuit {

class CircuitBuilder;

struct Scope {
    const SubcktDef* definition = nullptr;  ///< the subcircuit, or the top level
    const Scope* caller = nullptr;          ///< the scope of the X line; as in ngspice, names that are unknown here are looked up there
    Scope* enclosing = nullptr;  ///< the scope that contains the subcircuit's definition; its models and subcircuits are visible here
    std::string path = {};       ///< prefix of its names in the circuit: "x1.x2."; "" for the top level
    ByName<int> ports = {};      ///< indices in the circuit of the nodes that the ports are connected to
    ByName<int> models = {};     ///< indices in the circuit of the models of this scope that were used so far
    Values parameters = {};      ///< values of .param and of the .subckt line
    double m = 1;                ///< number of parallel instances; the product of m= of this X line and of all around it
    int depth = 0;               ///< 0 for the top level
    std::vector<bool> conditions = {};  ///< for each of definition->conditions: the branch holds
    RandomValues* random = nullptr;     ///< gives the values of random functions

    /// The scope that defines the model of this name: this one or one that encloses it; null if there is none.
    Scope* definer_of_model(std::string_view name) {
        Scope* f = this;
        while (f && f->own_model(name) == nullptr) f = f->enclosing;
        return f;
    }
    /// The model of this name that holds in this scope itself; null if there is none.
    const Statement* own_model(std::string_view name) const;
    /// True if the statement is in no branch of .if, or in one that holds. The statement must be of this definition.
    bool holds(const Statement& s) const { return s.condition < 0 || conditions[static_cast<std::size_t>(s.condition)]; }
    /// Evaluates the branches of .if, which count as statements. Two models of one name that both hold are an error. Call it after
    /// define().
    Result<void> evaluate_conditions(CircuitBuilder&);
    /// The level of the model of this name, 1 if its line does not give it; nullopt if there is no such model or the level is not a number.
    std::optional<double> model_level(std::string_view name);
    /// Look up a name in this scope, then in its callers.
    std::optional<double> parameter(std::string_view name) const;
    const ExpressionScope::Function* function(std::string_view name) const;

    /// Evaluates all parameters, except that those in `given` take the given values. Parameters may be in any order, but a cycle is an
    /// error.
    Result<void> define(const Values& given);

    /// The value of a number or an expression of parameters. A value that is not finite is an error.
    Result<double> evaluate(const WordRef&) const;
    /// The same for a tolerance, which may be in percent.
    Result<double> evaluate_tolerance(const WordRef&) const;
    /// Parses an expression, which may also use voltages and currents if the ExpressionScope allows inputs.
    Result<Expression> parse_expression(const WordRef&, ExpressionScope) const;
    /// The parameters and functions of this scope, for parse_expression().
    ExpressionScope expression_scope() const;

private:
    std::vector<std::string> known_names() const;
    Result<void> define(const std::string& first, ByName<WordRef>& pending);
    Result<void> check_alternative_models(CircuitBuilder&) const;
};

/// A name that an element uses. It may be defined later in the netlist, but must exist when the circuit is complete.
struct ForwardRef {
    std::string name;  ///< full path
    SourceLocation location;
    std::string user;  ///< the element that uses the name, for the error message
    /// The name must be that of a node (of v(...)), of an element whose current is an unknown (of F, H, W and i(...)), or of an inductor
    /// (of K).
    enum class Target { node, current, inductor } target;
};

class CircuitBuilder {
    const ParsedNetlist& parsed_;
    std::size_t statement_count_ = 0, name_bytes_ = 0;  // elaborated statements; estimated memory of all names
    bool is_limit_exceeded_ = false;
    std::set<std::string> warned_;  // texts of the warnings of warn_once()
    Suggestions similar_models_;

public:
    Circuit circuit;
    std::vector<ForwardRef> forward_refs;
    RandomValues random;
    Refusals refusals;
    const ResolvedOverrides& overrides;
    Values stepped;                                       ///< values by full path of the element, from .step
    std::set<std::string, std::less<>> stepped_elements;  ///< those of them that were found

    CircuitBuilder(const ParsedNetlist& parsed, const ResolvedOverrides& resolved, std::optional<RandomDraws> draws)
        : parsed_(parsed), random(draws), overrides(resolved) {}

    /// The name in the circuit of a node that the scope calls `name`; ground is "0".
    std::string node_name(const Scope&, std::string_view name) const;
    /// The index of this node in the circuit; a new node is added.
    int find_or_add_node(const Scope&, std::string_view name);
    /// The index in the circuit of the model that the scope calls `name`. The model is evaluated and added at its first use. `user` is the
    /// element that uses it. The model must have one of these types.
    Result<int> find_or_add_model(Scope&, const WordRef& name, std::string_view user, std::span<const std::string_view> types);
    Result<void> add_element(Element);
    /// The index of a new node that no line names, such as "x1.c1#rser".
    int add_inner_node(const std::string& name);

    /// Counts an elaborated statement and the memory of its name. Exceeding the limit of either is an error.
    Result<void> count_statement(const Scope&, const Statement&);
    /// Adds a warning, unless one with the same text is there: a statement of a subcircuit is elaborated for each instance.
    void warn_once(Error warning) {
        if (warned_.insert(warning.text()).second) circuit.warnings.push_back(std::move(warning));
    }
    bool is_limit_exceeded() const { return is_limit_exceeded_; }
};

/// True if a value in the statement is the name, or an expression that contains it.
bool uses_name(const Statement&, std::string_view name);
/// True if the elements, models or parameters of a definition use the name.
bool uses_name(const SubcktDef&, std::string_view name);

/// Reads the element of a line, except of an X line, and adds it to the circuit.
Result<void> read_element(CircuitBuilder&, Scope&, const Statement&);

}  // namespace corpuscle::circuit
