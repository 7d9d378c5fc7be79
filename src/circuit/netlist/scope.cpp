#include "circuit/netlist/scope.hpp"

#include <algorithm>
#include <cmath>

#include "circuit/expression/spice_number.hpp"

namespace corpuscle::circuit {
namespace {

/// Calls f(name) for each name in the text of an expression. Letters after digits are a scale, not a name.
template <class F>
void for_each_name(std::string_view text, F&& f) {
    const auto digit = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
    for (std::size_t k = 0; k < text.size();) {
        const auto from = k;
        while (k < text.size() && (letter(text[k]) || digit(text[k]))) ++k;
        if (k == from)
            ++k;
        else if (letter(text[from]))
            f(text.substr(from, k - from));
    }
}

/// The names that an expression uses, including those in the functions that it calls, but not the arguments of functions.
std::vector<std::string> dependencies_of(std::string_view text, const Scope& scope) {
    std::vector<std::string> names;
    std::set<std::string, std::less<>> seen;
    std::vector<const ExpressionScope::Function*> functions;
    const auto collect_names = [&](std::string_view in, const ExpressionScope::Function* of) {
        for_each_name(in, [&](std::string_view name) {
            const bool is_argument = of && std::find(of->arguments.begin(), of->arguments.end(), name) != of->arguments.end();
            if (is_argument || !seen.emplace(name).second) return;
            names.emplace_back(name);
            if (const auto* f = scope.function(name)) functions.push_back(f);
        });
    };
    collect_names(text, nullptr);
    for (std::size_t k = 0; k < functions.size(); ++k) collect_names(functions[k]->text, functions[k]);
    return names;
}

/// The same error, located in the line of the expression. Its present column is counted in the text of the expression, from 1.
Error relocated(const Error& error, const WordRef& text) {
    Error out = error;
    out.location = text.statement->line.location(text.word.at + static_cast<std::size_t>(std::max(1L, error.location.column) - 1));
    return out;
}

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

std::vector<std::string_view> known_models(const Scope& scope) {
    std::vector<std::string_view> known;
    for (const Scope* f = &scope; f; f = f->enclosing)
        for (const auto& [model, statement] : f->definition->models) known.push_back(model);
    return known;
}

Error unknown_model(const Scope& scope, const WordRef& name, std::string_view user, Suggestions& similar_models) {
    constexpr std::string_view units[] = {"f",   "h",  "v",  "a",  "pf", "nf", "uf", "ohm", "k", "kohm",
                                          "meg", "mh", "uh", "nh", "fF", "p",  "n",  "u",   "m"};
    const bool is_unit = std::find(std::begin(units), std::end(units), name.view()) != std::end(units);
    const auto hint = is_unit ? "; write a unit directly after its number, without a blank"
                              : similar_models.for_name(scope.definition, name.view(), [&] { return known_models(scope); });
    return error_at(name.location(), "{}: unknown model '{}'{}", user, name.view(), hint);
}

}  // namespace

std::optional<double> Scope::parameter(std::string_view name) const {
    for (const Scope* f = this; f; f = f->caller)
        if (const auto at = f->parameters.find(name); at != f->parameters.end()) return at->second;
    return {};
}

const ExpressionScope::Function* Scope::function(std::string_view name) const {
    for (const Scope* f = this; f; f = f->caller)
        if (const auto at = f->definition->functions.find(name); at != f->definition->functions.end()) return &at->second;
    return nullptr;
}

ExpressionScope Scope::expression_scope() const {
    ExpressionScope s;
    s.parameter = [this](std::string_view name) { return parameter(name); };
    s.function = [this](std::string_view name) { return function(name); };
    s.random = [this](std::string_view name, std::span<const double> arguments) { return random->function(name, arguments); };
    return s;
}

std::vector<std::string> Scope::known_names() const {
    std::vector<std::string> names;
    for (const Scope* f = this; f; f = f->caller)
        for (const auto* definitions : {&f->definition->parameters, &f->definition->defaults})
            for (const auto& [name, text] : *definitions) names.push_back(name);
    return names;
}

Result<Expression> Scope::parse_expression(const WordRef& text, ExpressionScope scope) const {
    const SourceLocation location{text.statement->line.file ? *text.statement->line.file : "", 1, 1};
    auto parsed = Expression::parse(text.view(), location, scope);
    if (parsed) return parsed;
    // Parsed again for the suggestions, since collecting all names takes too long for every expression.
    scope.suggestions = known_names();
    return relocated(Expression::parse(text.view(), location, scope).error(), text);
}

Result<double> Scope::evaluate(const WordRef& text) const {
    double value = 0;
    if (const auto plain = text.word.kind == Word::Kind::plain ? parse_number(text.view()) : std::nullopt) {
        if (auto why = ambiguity(*plain, text.view())) return bad_input(std::move(*why), text.location());
        value = plain->value;
    } else {
        const auto expression = TRY(parse_expression(text, expression_scope()));
        value = expression.value();
    }
    if (std::isnan(value)) return error_at(text.location(), "'{}' is not a number", text.view().substr(0, 60));
    if (!std::isfinite(value)) return error_at(text.location(), "'{}' is {}, not a finite number", text.view().substr(0, 60), value);
    return value;
}

Result<double> Scope::evaluate_tolerance(const WordRef& text) const {
    auto number = text;
    const bool is_percent = text.view().ends_with('%');
    if (is_percent) --number.word.size;
    const double value = TRY(evaluate(number)) * (is_percent ? 0.01 : 1);
    if (!(value >= 0)) return error_at(text.location(), "a tolerance of {:g} must not be negative", value);
    return value;
}

Result<void> Scope::define(const Values& given) {
    parameters = given;
    ByName<WordRef> pending;
    for (const auto* definitions : {&definition->parameters, &definition->defaults})
        for (const auto& [name, text] : *definitions)
            if (!parameters.contains(name)) pending.emplace(name, text);
    while (!pending.empty()) TRY(define(std::string(pending.begin()->first), pending));
    return {};
}

/// Evaluates the parameter `first` after all parameters that it depends on, and removes them from `pending`. A stack replaces recursion,
/// which a long chain of parameters would make too deep.
Result<void> Scope::define(const std::string& first, ByName<WordRef>& pending) {
    struct Pending {
        std::string name;
        std::vector<std::string> dependencies;
        std::size_t next = 0;  // index of the first dependency that is not yet handled
    };
    std::vector<Pending> stack;
    std::set<std::string, std::less<>> on_stack;
    const auto push = [&](const std::string& name) {
        stack.push_back({name, dependencies_of(pending.find(name)->second.view(), *this)});
        on_stack.insert(name);
    };
    const auto cycle_error = [&](const std::string& name) {
        std::string chain;
        auto at = std::find_if(stack.begin(), stack.end(), [&](const Pending& b) { return b.name == name; });
        for (int shown = 0; at != stack.end() && shown < 20; ++at, ++shown) chain += at->name + " -> ";
        return error_at(pending.find(name)->second.location(), "parameter {} depends on itself: {}{}", name, chain, name);
    };
    for (push(first); !stack.empty();) {
        auto& top = stack.back();
        if (top.next < top.dependencies.size()) {
            const std::string& name = top.dependencies[top.next++];
            if (on_stack.contains(name)) return cycle_error(name);
            if (pending.contains(name)) push(std::string(name));
            continue;
        }
        const auto value = TRY(evaluate(pending.find(top.name)->second));
        parameters.emplace(top.name, value);
        pending.erase(top.name);
        on_stack.erase(top.name);
        stack.pop_back();
    }
    return {};
}

const Statement* Scope::own_model(std::string_view name) const {
    const auto at = definition->models.find(name);
    if (at == definition->models.end()) return nullptr;
    const auto found = std::ranges::find_if(at->second, [this](const Statement* s) { return holds(*s); });
    return found == at->second.end() ? nullptr : *found;
}

Result<void> Scope::evaluate_conditions(CircuitBuilder& builder) {
    const auto& all = definition->conditions;
    std::vector<bool> is_decided(all.size());  // this branch or one before it in the same .if holds
    conditions.assign(all.size(), false);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto& c = all[k];
        TRY(builder.count_statement(*this, *c.line));
        const bool is_reached = c.outer < 0 || conditions[static_cast<std::size_t>(c.outer)];
        is_decided[k] = c.previous >= 0 && is_decided[static_cast<std::size_t>(c.previous)];
        if (!is_reached || is_decided[k]) continue;
        conditions[k] = !c.text || TRY(evaluate(*c.text)) != 0;
        is_decided[k] = conditions[k];
    }
    return check_alternative_models(builder);
}

Result<void> Scope::check_alternative_models(CircuitBuilder& builder) const {
    for (const auto* lines : definition->alternative_models) {
        const Statement* first = nullptr;
        for (const auto* s : *lines) {
            TRY(builder.count_statement(*this, *s));
            if (!holds(*s)) continue;
            if (first != nullptr && first->line.text != s->line.text)
                return error_at(s->location(1), "model '{}' is already defined at {}", s->text(1), location_text(*first));
            first = s;
        }
    }
    return {};
}

std::optional<double> Scope::model_level(std::string_view name) {
    const Scope* definer = definer_of_model(name);
    if (definer == nullptr) return {};
    const Statement& s = *definer->own_model(name);
    const auto* level = s.find("level");
    if (level == nullptr) return 1;
    const auto value = definer->evaluate({&s, level->value});
    return value ? std::optional(*value) : std::nullopt;
}

bool uses_name(const Statement& s, std::string_view name) {
    const auto is_in = [&](const Word& w) {
        bool found = false;
        if (w.kind != Word::Kind::quoted) for_each_name(s.text(w), [&](std::string_view other) { found |= other == name; });
        return found;
    };
    return std::any_of(s.words.begin() + std::min<std::ptrdiff_t>(1, std::ssize(s.words)), s.words.end(), is_in) ||
           std::ranges::any_of(s.pairs, [&](const NameValue& pair) { return is_in(pair.value); });
}

bool uses_name(const SubcktDef& body, std::string_view name) {
    const auto in_statement = [&](const Statement* s) { return uses_name(*s, name); };
    const auto in_text = [&](std::string_view text) {
        bool found = false;
        for_each_name(text, [&](std::string_view other) { found |= other == name; });
        return found;
    };
    if (std::ranges::any_of(body.elements, in_statement) || std::ranges::any_of(body.ics, in_statement)) return true;
    for (const auto& [model, statements] : body.models)
        if (std::ranges::any_of(statements, in_statement)) return true;
    for (const auto* definitions : {&body.parameters, &body.defaults})
        for (const auto& [parameter, text] : *definitions)
            if (in_text(text.view())) return true;
    for (const auto& [function, definition] : body.functions)
        if (in_text(definition.text)) return true;
    for (const auto& condition : body.conditions)
        if (condition.text && in_text(condition.text->view())) return true;
    return std::ranges::any_of(body.subcircuits, [&](const auto& inner) { return uses_name(*inner.second, name); });
}

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

/// True for an entry of LTspice's libraries that says what a part is for, and that no equation has.
static bool is_rating(std::string_view name) {
    constexpr std::string_view ratings[] = {"mfg", "type", "iave", "vpk", "ipk", "vceo", "icrating"};
    return std::ranges::find(ratings, name) != std::end(ratings);
}

Result<int> CircuitBuilder::find_or_add_model(Scope& scope, const WordRef& name, std::string_view user,
                                              std::span<const std::string_view> types) {
    Scope* f = scope.definer_of_model(name.view());
    if (!f) return unknown_model(scope, name, user, similar_models_);
    const Statement& s = *f->own_model(name.view());
    const auto type = short_type(s.text(2));
    if (std::find(types.begin(), types.end(), type) == types.end())
        return error_at(name.location(), "{}: model '{}' has type {}; expected {}", user, name.view(), s.text(2), alternatives(types));
    if (const auto existing = f->models.find(name.view()); existing != f->models.end()) return existing->second;
    Values tolerances;
    for (std::size_t k = 3; k < s.words.size(); k += 2) {  // PSpice writes dev and lot without "="
        if (find_tolerance(s.text(k)) == nullptr || k + 1 == s.words.size())
            return error_at(s.location(k), "expected name=value, not '{}'", s.text(k));
        tolerances.insert_or_assign(std::string(s.text(k)), TRY(f->evaluate_tolerance({&s, s.words[k + 1]})));
    }
    Model model{f->path + std::string(name.view()), std::string(type), s.line.location(), {}, std::move(tolerances), {}};
    for (const auto& pair : s.pairs) {
        if (is_rating(s.text(pair.name))) continue;
        if (pair.value.kind == Word::Kind::quoted || (s.text(pair.name) == "version" && !parse_number(s.text(pair.value)))) {
            model.texts.emplace(s.text(pair.name), s.text(pair.value));
            continue;
        }
        const bool is_tolerance = find_tolerance(s.text(pair.name)) != nullptr;
        const double value = TRY(is_tolerance ? f->evaluate_tolerance({&s, pair.value}) : f->evaluate({&s, pair.value}));
        (is_tolerance ? model.tolerances : model.values).emplace(s.text(pair.name), value);
    }
    if (const auto tnom = circuit.options.find("tnom"); tnom != circuit.options.end()) model.values.try_emplace("tnom", tnom->second);
    const int k = static_cast<int>(circuit.models.size());
    circuit.models.push_back(std::move(model));
    f->models.emplace(name.view(), k);
    return k;
}

int CircuitBuilder::add_inner_node(const std::string& name) {
    const auto [at, is_new] = circuit.node_numbers.try_emplace(name, static_cast<int>(circuit.nodes.size()));
    if (is_new) circuit.nodes.push_back(name), name_bytes_ += 2 * name.size();
    return at->second;
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
    name_bytes_ += 2 * (scope.path.size() + s.text(0).size()) + s.line.file->size();
    is_limit_exceeded_ = ++statement_count_ > max_elements || name_bytes_ > max_name_bytes;
    if (statement_count_ > max_elements)
        return error_at(s.line.location(), "the circuit has more elements than the limit of {}", max_elements);
    if (name_bytes_ > max_name_bytes)
        return error_at(s.line.location(), "the names of all elements and nodes exceed the limit of {} MB", max_name_bytes >> 20);
    return {};
}

}  // namespace corpuscle::circuit
