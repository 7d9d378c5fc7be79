#include "circuit/netlist/scope.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/expression/spice_number.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_name_bytes = std::size_t{512} << 20;  // for all names together

/// The short name of a model type: "r" for "res".
std::string_view short_type(std::string_view type) {
    if (type == "res") return "r";
    if (type == "cap") return "c";
    return type == "ind" ? "l" : type;
}

/// "nmos or pmos"
std::string alternatives(std::span<const std::string_view> words) {
    std::string out;
    for (const auto w : words) out += fmt::format("{}{}", out.empty() ? "" : " or ", w);
    return out;
}

Error unknown_model(const Scope& scope, const WordRef& name, std::string_view user) {
    std::vector<std::string_view> known;
    for (const Scope* f = &scope; f; f = f->enclosing)
        for (const auto n : keys_of(f->definition->models)) known.push_back(n);
    constexpr std::string_view units[] = {"f",   "h",  "v",  "a",  "pf", "nf", "uf", "ohm", "k", "kohm",
                                          "meg", "mh", "uh", "nh", "fF", "p",  "n",  "u",   "m"};
    const bool is_unit = std::find(std::begin(units), std::end(units), name.view()) != std::end(units);
    const auto hint = is_unit ? "; write a unit directly after its number, without a blank" : did_you_mean(name.view(), known);
    return error_at(name.location(), "{}: unknown model '{}'{}", user, name.view(), hint);
}

}  // namespace

std::string CircuitBuilder::node_name(const Scope& scope, std::string_view name) const {
    if (is_ground(name)) return "0";
    if (const auto port = scope.ports.find(name); port != scope.ports.end()) return circuit.nodes[static_cast<std::size_t>(port->second)];
    if (parsed_.globals.contains(name)) return std::string(name);
    return scope.path + std::string(name);
}

int CircuitBuilder::find_or_add_node(const Scope& scope, std::string_view name) {
    if (is_ground(name)) return 0;
    if (const auto port = scope.ports.find(name); port != scope.ports.end()) return port->second;
    auto [at, is_new] = circuit.node_numbers.try_emplace(node_name(scope, name), static_cast<int>(circuit.nodes.size()));
    if (is_new) {
        circuit.nodes.push_back(at->first);
        name_bytes_ += 2 * at->first.size();  // stored in `nodes` and in `node_numbers`
    }
    return at->second;
}

bool CircuitBuilder::has_model(const Scope& scope, std::string_view name) const {
    for (const Scope* f = &scope; f; f = f->enclosing)
        if (f->definition->models.contains(name)) return true;
    return false;
}

Result<int> CircuitBuilder::find_or_add_model(Scope& scope, const WordRef& name, std::string_view user,
                                              std::span<const std::string_view> types) {
    Scope* f = &scope;  // the scope that defines the model
    while (f && !f->definition->models.contains(name.view())) f = f->enclosing;
    if (!f) return unknown_model(scope, name, user);
    const Statement& s = *f->definition->models.find(name.view())->second;
    const auto type = short_type(s.text(2));
    if (std::find(types.begin(), types.end(), type) == types.end())
        return error_at(name.location(), "{}: model '{}' has type {}; expected {}", user, name.view(), s.text(2), alternatives(types));
    if (const auto existing = f->models.find(name.view()); existing != f->models.end()) return existing->second;
    Model model{f->path + std::string(name.view()), std::string(type), s.line.location(), {}, {}};
    for (const auto& pair : s.pairs) {
        if (pair.value.kind == Word::Kind::quoted || (s.text(pair.name) == "version" && !parse_number(s.text(pair.value)))) {
            model.texts.emplace(s.text(pair.name), s.text(pair.value));
            continue;
        }
        const auto value = TRY(f->evaluate({&s, pair.value}));
        model.values.emplace(s.text(pair.name), value);
    }
    if (const auto tnom = circuit.options.find("tnom"); tnom != circuit.options.end()) model.values.try_emplace("tnom", tnom->second);
    const int k = static_cast<int>(circuit.models.size());
    circuit.models.push_back(std::move(model));
    f->models.emplace(name.view(), k);
    return k;
}

Result<void> CircuitBuilder::add_element(Element e) {
    const auto [at, is_new] = circuit.element_numbers.try_emplace(e.name, static_cast<int>(circuit.elements.size()));
    if (!is_new) {
        const SourceLocation& first = circuit.elements[static_cast<std::size_t>(at->second)].location;
        return error_at(e.location, "element '{}' is already defined at {}:{}", e.name, first.file, first.line);
    }
    circuit.elements.push_back(std::move(e));
    return {};
}

Result<void> CircuitBuilder::count_statement(const Scope& scope, const Statement& s) {
    if (++statement_count_ > max_elements)
        return error_at(s.line.location(), "the circuit has more elements than the limit of {}", max_elements);
    name_bytes_ += 2 * (scope.path.size() + s.text(std::size_t{0}).size()) + s.line.file->size();
    if (name_bytes_ > max_name_bytes)
        return error_at(s.line.location(), "the names of all elements and nodes exceed the limit of {} MB", max_name_bytes >> 20);
    return {};
}

}  // namespace corpuscle::circuit
