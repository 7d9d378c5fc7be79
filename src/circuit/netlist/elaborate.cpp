// Elaborates a parsed netlist into the flat circuit: expands subcircuits and evaluates directives.

#include "circuit/devices.hpp"
#include "circuit/netlist/parasitic/voltage_loops.hpp"
#include "circuit/netlist/scope.hpp"
#include "circuit/netlist/settings/directive_words.hpp"
#include "circuit/netlist/settings/node_voltages.hpp"
#include "circuit/netlist/settings/option_lines.hpp"
#include "circuit/netlist/settings/set_lines.hpp"

namespace corpuscle::circuit {
namespace {

constexpr int max_subcircuit_depth = 200;

class CircuitElaborator {
    const ParsedNetlist& parsed_;
    CircuitBuilder builder_;
    bool changes_values_;
    std::vector<SubcircuitInstance>* instances_;
    Scope top_;
    Statement definition_line_;  // the X line of run_definition()
    NodeVoltages node_voltages_;
    /// Whether a subcircuit uses a name that an X line gives and its .subckt line does not.
    std::map<std::pair<const SubcktDef*, std::string>, std::optional<bool>> used_names_;
    Suggestions similar_subcircuits_;

public:
    /// `overrides`: with the values of the .set lines. `changes_values`: true if values differ from those of the netlist as written.
    /// `instances`: receives the instances of subcircuits, whose ports are then nodes of their own; may be null.
    CircuitElaborator(const ParsedNetlist& parsed, const ResolvedOverrides& overrides, bool changes_values,
                      std::optional<RandomDraws> draws, std::vector<SubcircuitInstance>* instances = nullptr)
        : parsed_(parsed), builder_(parsed, overrides, draws), changes_values_(changes_values), instances_(instances) {
        top_.definition = &parsed.top, top_.random = &builder_.random;
    }

    /// Makes the flat circuit. `given` has values for .param lines of the top level.
    Result<Circuit> run(const Values& given) {
        Circuit& c = builder_.circuit;
        c.title = parsed_.title, c.file = parsed_.file, c.warnings = parsed_.warnings;
        c.node_numbers.emplace("0", 0);
        TRY(define_top(given));
        c.parameters = top_.parameters;
        TRY(read_settings(parsed_, top_, builder_.overrides, c));
        node_voltages_.find_paths(parsed_.top.ics);
        const auto count = parsed_.top.elements.size();
        c.elements.reserve(count), c.element_numbers.reserve(count), c.node_numbers.reserve(count);
        TRY(elaborate_contents(top_));
        if (!builder_.refusals.empty()) return builder_.refusals.combined();
        TRY(check_stepped());
        TRY(check_set_lines(parsed_, c));
        TRY(check_references());
        TRY(node_voltages_.resolve(c));
        if (instances_ == nullptr) add_resistance_in_loops(c);
        for (const auto* s : parsed_.directives)
            if (top_.holds(*s)) c.directives.push_back(make_directive(top_, *s));
        apply_directive_overrides(builder_.overrides, changes_values_, c);
        c.has_random_values = builder_.random.is_used();
        warn_of_means(c);
        return std::move(c);
    }

    /// Makes the circuit of one subcircuit alone.
    Result<Circuit> run_definition(std::string_view name) {
        Circuit& c = builder_.circuit;
        c.title = parsed_.title, c.file = parsed_.file;
        c.node_numbers.emplace("0", 0);
        TRY(define_top({}));
        TRY(read_settings(parsed_, top_, builder_.overrides, c));
        TRY(elaborate_definition(name));
        if (!builder_.refusals.empty()) return builder_.refusals.combined();
        TRY(check_references());
        return std::move(c);
    }

    /// The errors of a run.
    const Refusals& refusals() const { return builder_.refusals; }

private:
    /// Warns if the netlist has random values, but nothing draws them.
    void warn_of_means(Circuit& c) const {
        const auto is_mc = [](const Directive& directive) { return directive.name == "mc"; };
        if (c.has_random_values && !builder_.random.draws() && std::ranges::none_of(c.directives, is_mc))
            c.warnings.push_back(
                error_at({c.file}, "random values and tolerances are at their means; .mc COUNT or --mismatch SEED draws them"));
    }

    /// Evaluates the parameters of the top level.
    Result<void> define_top(const Values& given) {
        auto all = given;
        all.insert(builder_.overrides.parameters.begin(), builder_.overrides.parameters.end());  // does not replace given values
        for (auto at = all.begin(); at != all.end();) {
            const auto& [name, value] = *at;
            if (parsed_.top.parameters.contains(name)) {
                ++at;
                continue;
            }
            const auto location = location_of_step(name);
            if (location.line == 0 || step_names_parameter(name)) return no_parameter(name, location);
            builder_.stepped.emplace(name, value);
            at = all.erase(at);
        }
        TRY(top_.define(all));
        return top_.evaluate_conditions(builder_);
    }

    Error no_parameter(std::string_view name, SourceLocation location) const {
        const bool is_element = std::ranges::any_of(parsed_.top.elements, [&](const Statement* s) { return s->text(0) == name; });
        return error_at(
            std::move(location), "there is no .param {}{}", name,
            is_element ? "; leave out the word param to step the element" : did_you_mean(name, std::views::keys(parsed_.top.parameters)));
    }
    /// True if the .step of this name says that it is a parameter.
    bool step_names_parameter(std::string_view name) const {
        return std::ranges::any_of(parsed_.directives, [&](const Statement* s) {
            for (std::size_t k = 2; s->text(0) == ".step" && k < s->words.size(); ++k)
                if (s->text(k) == name && s->text(k - 1) == "param") return true;
            return false;
        });
    }
    /// Every value of .step must have an element.
    Result<void> check_stepped() const {
        for (const auto& [name, value] : builder_.stepped)
            if (!builder_.stepped_elements.contains(name)) {
                std::vector<std::string_view> known;
                for (const auto& [parameter, text] : parsed_.top.parameters) known.push_back(parameter);
                for (const auto& e : builder_.circuit.elements) known.push_back(e.name);
                return error_at(location_of_step(name), ".step: there is no parameter or element '{}'{}", name, did_you_mean(name, known));
            }
        return {};
    }

    /// The location of the .step of a parameter; that of the netlist if there is none.
    SourceLocation location_of_step(std::string_view name) const {
        for (const auto* s : parsed_.directives)
            for (std::size_t k = 1; s->text(0) == ".step" && k < s->words.size(); ++k)
                if (s->text(k) == name) return s->location(k);
        return {parsed_.file};
    }

    // ---- subcircuits ----

    /// Adds the elements of a scope, and of all subcircuits that it contains, to the circuit.
    Result<void> elaborate_contents(Scope& scope) {
        for (const auto& [branch, refusals] : scope.definition->branch_refusals)
            if (scope.conditions[static_cast<std::size_t>(branch)]) builder_.refusals.add_all_of(refusals);
        for (const auto* s : scope.definition->elements) {
            if (!scope.holds(*s)) continue;
            TRY(builder_.count_statement(scope, *s));
            const auto ok = s->line.text[0] == 'x' ? elaborate_instance(scope, *s) : read_element(builder_, scope, *s);
            if (!ok && builder_.is_limit_exceeded()) return ok;
            if (!ok) builder_.refusals.add(ok.error());
            if (builder_.refusals.is_full()) return {};
        }
        for (const auto* s : scope.definition->ics) {
            if (!scope.holds(*s)) continue;
            TRY(builder_.count_statement(scope, *s));
            TRY(node_voltages_.read(builder_, scope, *s));
        }
        return {};
    }

    /// Elaborates an X line.
    Result<void> elaborate_instance(Scope& scope, const Statement& s) {
        const auto name = s.text(0);
        auto words = instance_words(s);
        if (words.size() < 1) return error_at(s.location(1), "{}: expected nodes and the name of a subcircuit", name);
        const Word subcircuit_name = words.back();
        words.pop_back();
        Scope inner;
        inner.path = fmt::format("{}{}.", scope.path, name);
        TRY(find_body(scope, s, subcircuit_name, inner));
        TRY(connect(scope, s, words, inner));
        inner.caller = &scope, inner.random = scope.random, inner.depth = scope.depth + 1;
        if (instances_ != nullptr) add_instance(scope, s, words, inner);
        if (inner.depth > max_subcircuit_depth)
            return error_at(s.line.location(), "{}: subcircuits are nested deeper than the limit of {}", name, max_subcircuit_depth);
        TRY(check_recursion(inner, s));
        Values given;
        TRY(read_instance_parameters(scope, s, inner, given));
        TRY(inner.define(given));
        TRY(inner.evaluate_conditions(builder_));
        return elaborate_contents(inner);
    }

    /// Elaborates a subcircuit of the top level as if an X line of the same name connected its ports to nodes of their names.
    Result<void> elaborate_definition(std::string_view name) {
        const auto definition = parsed_.top.subcircuits.find(name);
        if (definition == parsed_.top.subcircuits.end())
            return error_at({parsed_.file}, "there is no subcircuit '{}'{}", name,
                            did_you_mean(name, std::views::keys(parsed_.top.subcircuits)));
        LogicalLine line;
        line.text = std::string(name);
        for (const auto& port : definition->second->ports) line.text += ' ' + port;
        line.text += fmt::format(" {}", name);
        definition_line_ = TRY(split_element(std::move(line), nullptr));
        return elaborate_instance(top_, definition_line_);
    }

    /// The words of an X line after its name: the nodes, then the name of the subcircuit, before which CDL has a slash.
    static std::vector<Word> instance_words(const Statement& s) {
        std::vector<Word> words;
        for (std::size_t k = 1; k < s.words.size(); ++k)
            if (s.text(k) != "params:" && s.text(k) != "/") words.push_back(s.words[k]);
        if (!words.empty() && s.text(words.back()).starts_with('/')) ++words.back().at, --words.back().size;
        return words;
    }

    /// Finds the definition of the subcircuit of this name, in the scope or in one that encloses it.
    Result<void> find_body(Scope& scope, const Statement& s, const Word& name, Scope& inner) {
        for (Scope* f = &scope; f; f = f->enclosing) {
            if (const auto at = f->definition->subcircuits.find(s.text(name)); at != f->definition->subcircuits.end()) {
                inner.definition = at->second.get(), inner.enclosing = f;
                return {};
            }
        }
        return error_at(s.location(name), "{}: unknown subcircuit '{}'{}", s.text(0), s.text(name),
                        similar_subcircuit(scope, s.text(name)));
    }
    std::string similar_subcircuit(const Scope& scope, std::string_view name) {
        return similar_subcircuits_.for_name(scope.definition, name, [&] {
            std::vector<std::string_view> known;
            for (const Scope* f = &scope; f; f = f->enclosing)
                for (const auto& [subcircuit, body] : f->definition->subcircuits) known.push_back(subcircuit);
            return known;
        });
    }

    /// Connects the ports of the subcircuit to the nodes that the X line names.
    Result<void> connect(Scope& scope, const Statement& s, const std::vector<Word>& words, Scope& inner) {
        const auto& ports = inner.definition->ports;
        if (words.size() != ports.size()) {
            std::string expected;
            for (const auto& port : ports) expected += expected.size() < 100 ? ' ' + port : std::string();
            return error_at(s.line.location(), "{}: {} node{}, but subcircuit '{}' has {}:{}", s.text(0), words.size(),
                            words.size() == 1 ? "" : "s", inner.definition->name, ports.size(), expected);
        }
        for (std::size_t k = 0; k < words.size(); ++k) {
            const auto outside = s.text(words[k]);
            // A port that is named as ground is ground, as in ngspice and Xyce; the node that the line gives for it has no effect.
            if (is_ground(ports[k]) && !is_ground(outside))
                builder_.warn_once(error_at(s.location(words[k]), "{}: port {} of subcircuit '{}' is ground, so it is not connected to {}",
                                            s.text(0), ports[k], inner.definition->name, outside));
            const int node = builder_.find_or_add_node(scope, outside);
            inner.ports.emplace(ports[k], instances_ == nullptr ? node : add_port_node(inner.path, ports[k]));
            node_voltages_.connect_port(inner.path, ports[k], node);
        }
        return {};
    }

    int add_port_node(const std::string& path, const std::string& port) {
        return is_ground(port) ? 0 : builder_.add_inner_node(path + port);
    }
    void add_instance(const Scope& scope, const Statement& s, const std::vector<Word>& words, const Scope& inner) {
        SubcircuitInstance instance{inner.path.substr(0, inner.path.size() - 1), inner.definition->name, inner.definition->ports, {}, {}};
        for (std::size_t k = 0; k < words.size(); ++k) {
            instance.inside.push_back(inner.ports.find(instance.ports[k])->second);
            instance.outside.push_back(builder_.find_or_add_node(scope, s.text(words[k])));
        }
        instances_->push_back(std::move(instance));
    }

    /// Returns an error if the subcircuit contains an instance of itself.
    static Result<void> check_recursion(const Scope& inner, const Statement& s) {
        for (const Scope* f = inner.caller; f; f = f->caller) {
            if (f->definition != inner.definition) continue;
            std::string chain = inner.definition->name;
            for (const Scope* g = inner.caller; g != f->caller; g = g->caller) chain = fmt::format("{} -> {}", g->definition->name, chain);
            return error_at(s.line.location(), "subcircuit '{}' contains itself: {}", inner.definition->name, chain);
        }
        return {};
    }

    /// Evaluates the parameters of an X line in the scope that contains the line. m= multiplies inner.m, all others go to `given`.
    Result<void> read_instance_parameters(const Scope& scope, const Statement& s, Scope& inner, Values& given) {
        inner.m = scope.m;
        for (const auto& pair : s.pairs) {
            auto name = s.text(pair.name);
            if (name.starts_with("params:")) name.remove_prefix(7);
            const auto value = TRY(evaluate_argument(scope, {&s, pair.value}, given));
            if (inner.definition->defaults.contains(name) || inner.definition->parameters.contains(name))  // .param too, as in ngspice
                given.insert_or_assign(std::string(name), value);
            else if (name != "m")
                TRY(unknown_parameter(s, pair, name, value, *inner.definition, given));
            else if (!(value > 0))
                return error_at(s.location(pair.value), "{}: m = {:g} must be positive", s.text(0), value);
            else
                inner.m *= value;
        }
        return {};
    }
    /// The value of a parameter of an X line. It may use names of the scope that contains the line, else parameters to its left in the
    /// line.
    static Result<double> evaluate_argument(const Scope& scope, const WordRef& text, const Values& given) {
        auto value = scope.evaluate(text);
        if (value || given.empty()) return value;
        Scope with_given{
            .definition = scope.definition, .caller = &scope, .enclosing = scope.enclosing, .parameters = given, .random = scope.random};
        const auto other = with_given.evaluate(text);
        return other ? other : value;
    }
    /// A name that the subcircuit uses is one of its parameters, as in LTspice. One that resembles a parameter is a typing error. Any other
    /// one is a warning, as in ngspice.
    Result<void> unknown_parameter(const Statement& s, const NameValue& pair, std::string_view name, double value, const SubcktDef& body,
                                   Values& given) {
        auto& is_used = used_names_[{&body, std::string(name)}];
        if (!is_used) is_used = uses_name(body, name);
        if (*is_used) return given.insert_or_assign(std::string(name), value), Result<void>();
        auto suggestion = did_you_mean(name, std::views::keys(body.defaults));
        if (suggestion.empty()) suggestion = did_you_mean(name, std::views::keys(body.parameters));
        auto error = error_at(s.location(pair.name), "{}: subcircuit '{}' has no parameter '{}'{}", s.text(0), body.name, name,
                              suggestion.empty() ? ", so it has no effect" : suggestion);
        if (!suggestion.empty()) return error;
        builder_.warn_once(std::move(error));
        return {};
    }

    /// Checks that all nodes and elements that expressions, F, H and K lines name exist.
    Result<void> check_references() const {
        const Circuit& c = builder_.circuit;
        for (const auto& p : builder_.forward_refs) {
            if (p.target == ForwardRef::Target::node) {
                if (c.node_numbers.contains(p.name)) continue;
                return error_at(p.location, "{}: unknown node '{}'{}", p.user, p.name, did_you_mean(p.name, c.nodes | std::views::drop(1)));
            }
            const int k = c.find_element(p.name);
            const bool is_coupled = p.target == ForwardRef::Target::inductor;
            if (k < 0)
                return error_at(p.location, "{}: unknown element '{}'{}", p.user, p.name,
                                did_you_mean(p.name, elements_with(is_coupled ? Role::inductor : Role::voltage_source)));
            const Element& e = c.elements[static_cast<std::size_t>(k)];
            if (is_coupled) {
                if (has_role(e, Role::inductor)) continue;
                return error_at(p.location, "{}: '{}' is not an inductor", p.user, p.name);
            }
            if (!has_branch_current(e))
                return error_at(p.location, "{}: '{}' is not a voltage source; put a 0 V source in series to measure its current", p.user,
                                p.name);
        }
        return {};
    }
    std::vector<std::string_view> elements_with(Role role) const {
        std::vector<std::string_view> names;
        for (const auto& e : builder_.circuit.elements)
            if (has_role(e, role)) names.push_back(e.name);
        return names;
    }
};

}  // namespace

Refusals find_refused_elements(const ParsedNetlist& parsed) {
    const ResolvedOverrides none;
    CircuitElaborator elaborator(parsed, none, false, {});
    static_cast<void>(elaborator.run({}));
    return elaborator.refusals();
}

Result<Circuit> Netlist::elaborate(const Values& parameters, std::optional<RandomDraws> draws) const {
    if (!impl_) return Circuit{};
    if (!draws && overrides().mismatch_seed) draws = RandomDraws{*overrides().mismatch_seed, overrides().chip};
    const auto with_set_lines = TRY(add_set_lines(*impl_, overrides()));
    return CircuitElaborator(*impl_, with_set_lines, overrides().changes_values(), draws).run(parameters);
}

Result<HierarchicalCircuit> Netlist::elaborate_hierarchy() const {
    HierarchicalCircuit out;
    if (!impl_) return out;
    std::optional<RandomDraws> draws;
    if (overrides().mismatch_seed) draws = RandomDraws{*overrides().mismatch_seed, overrides().chip};
    const auto with_set_lines = TRY(add_set_lines(*impl_, overrides()));
    out.circuit = TRY(CircuitElaborator(*impl_, with_set_lines, overrides().changes_values(), draws, &out.instances).run({}));
    return out;
}

Result<HierarchicalCircuit> Netlist::elaborate_definition(std::string_view subcircuit) const {
    HierarchicalCircuit out;
    if (!impl_) return out;
    out.circuit = TRY(CircuitElaborator(*impl_, overrides(), overrides().changes_values(), {}, &out.instances).run_definition(subcircuit));
    return out;
}

}  // namespace corpuscle::circuit
