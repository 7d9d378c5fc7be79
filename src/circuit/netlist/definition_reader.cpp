#include "circuit/netlist/definition_reader.hpp"

#include "circuit/netlist/random_values.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_arguments = 100;  // of a function

/// Defines a function; `head` is its name with its arguments: "f(x, y)".
Result<void> define_function(std::string_view head, std::string text, SourceLocation location, SubcktDef& body,
                             std::vector<Error>& warnings) {
    const auto open = head.find('(');
    const std::string name(trimmed(head.substr(0, open)));
    if (open == std::string_view::npos || name.empty() || head.back() != ')')
        return error_at(location, "'{}' is not a function with arguments; write f(x,y)", head);
    ExpressionScope::Function f{{}, std::move(text)};
    for (auto rest = trimmed(head.substr(open + 1, head.size() - open - 2)); !rest.empty();) {
        const auto comma = std::min(rest.find(','), rest.size());
        f.arguments.emplace_back(trimmed(rest.substr(0, comma)));
        rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    if (f.arguments.size() > max_arguments) return error_at(location, "{}() has more than {} arguments", name, max_arguments);
    auto& known = body.functions[name];
    const bool is_same = known.text == f.text && known.arguments == f.arguments;
    if (!known.text.empty() && !is_same) warnings.push_back(error_at(location, "{}() is defined twice; this definition is used", name));
    known = std::move(f);
    return {};
}

/// Takes the words "name value" after the type of a model as name=value, as SPICE does, except for dev and lot, which are words.
void join_values(Statement& s) {
    const auto begins_with_letter = [&](std::size_t k) { return std::isalpha(static_cast<unsigned char>(s.text(k)[0])) != 0; };
    const auto is_name = [&](std::size_t k) {
        return s.words[k].kind == Word::Kind::plain && s.words[k].size > 0 && begins_with_letter(k);
    };
    const auto is_value = [&](std::size_t k) {
        return k < s.words.size() && s.words[k].size > 0 && (s.words[k].kind == Word::Kind::expression || !begins_with_letter(k));
    };
    std::vector<Word> rest(s.words.begin(), s.words.begin() + 3);
    for (std::size_t k = 3; k < s.words.size(); ++k) {
        if (find_tolerance(s.text(k)) != nullptr && k + 1 < s.words.size())
            rest.push_back(s.words[k]), rest.push_back(s.words[++k]);
        else if (is_name(k) && is_value(k + 1))
            s.pairs.push_back({s.words[k], s.words[k + 1]}), ++k;
        else
            rest.push_back(s.words[k]);
    }
    s.words = std::move(rest);
}

/// Keeps the last of the values that a model gives to one name, as ngspice does, with a warning.
void keep_last_values(Statement& s, std::vector<Error>& warnings) {
    std::map<std::string_view, std::size_t> known;  // index in `kept`
    std::vector<NameValue> kept;
    for (const auto& pair : s.pairs) {
        const auto name = s.text(pair.name);
        const auto [at, is_new] = known.try_emplace(name, kept.size());
        if (is_new) {
            kept.push_back(pair);
            continue;
        }
        kept[at->second] = pair;
        warnings.push_back(error_at(s.location(pair.name), "model '{}': {} is given twice; this value is used", s.text(1), name));
    }
    s.pairs = std::move(kept);
}

}  // namespace

Result<void> read_parameters(const Statement& s, SubcktDef& body, std::vector<Error>& warnings) {
    if (s.pairs.empty()) warnings.push_back(error_at(s.line.location(), "{} has no name=value, so it has no effect", s.text(0)));
    for (const auto& pair : s.pairs) {
        const std::string name(s.text(pair.name));
        if (const auto open = name.find('('); open != std::string::npos) {
            TRY(define_function(name, std::string(s.text(pair.value)), s.location(pair.name), body, warnings));
            continue;
        }
        const auto [at, is_new] = body.parameters.insert_or_assign(name, WordRef{&s, pair.value});
        if (!is_new) warnings.push_back(error_at(s.location(pair.name), "{} {} is given twice; this value is used", s.text(0), name));
    }
    return {};
}

Result<void> read_function(const LogicalLine& line, SubcktDef& body, std::vector<Error>& warnings) {
    const std::string_view text = line.text;
    constexpr std::size_t after_keyword = 5;  // length of ".func"
    const auto from = std::min(text.find_first_not_of(" \t", after_keyword), text.size()), close = text.find(')', from);
    if (close == std::string_view::npos) return bad_input(".func: expected a function such as f(x) {2*x}", line.location(from));
    auto value = trimmed(text.substr(close + 1));
    if (value.starts_with('=')) value = trimmed(value.substr(1));
    const auto is_enclosed = [&](char open, char end) { return value.size() >= 2 && value.front() == open && value.back() == end; };
    if (is_enclosed('\'', '\'')) value = value.substr(1, value.size() - 2);
    if (value.empty()) return bad_input(".func: the expression is missing; write one such as f(x) {2*x}", line.location(close));
    return define_function(text.substr(from, close + 1 - from), std::string(value), line.location(from), body, warnings);
}

Result<void> read_model(Statement read, SubcktDef& body, ParsedNetlist& out) {
    if (read.words.size() < 3)
        return error_at(read.location(read.words.size()), ".model: expected a name and a type, such as .model nm nmos (vto=0.5)");
    join_values(read);
    keep_last_values(read, out.warnings);
    const std::string name(read.text(1));
    auto& models = body.models[name];
    const auto known = std::ranges::find(models, read.condition, [](const Statement* s) { return s->condition; });
    if (known != models.end()) {
        const auto place = location_text(**known);
        if ((*known)->line.text != read.line.text) return error_at(read.location(1), "model '{}' is already defined at {}", name, place);
        out.warnings.push_back(error_at(read.location(1), "model '{}' is also defined at {}, in the same words", name, place));
        return {};
    }
    models.push_back(&out.statements.emplace_back(std::move(read)));
    if (models.size() == 2) body.alternative_models.push_back(&models);
    return {};
}

Result<void> read_subcircuit_head(SubcktDef& body) {
    const Statement& s = *body.head;
    std::set<std::string_view> seen;
    for (std::size_t k = 2; k < s.words.size(); ++k) {
        const auto port = s.text(k);
        if (port == "params:") continue;
        if (!seen.insert(port).second) return error_at(s.location(k), ".subckt {}: node '{}' is given twice", body.name, port);
        body.ports.emplace_back(port);
    }
    for (const auto& pair : s.pairs) {
        auto name = s.text(pair.name);
        if (name.starts_with("params:")) name.remove_prefix(7);
        body.defaults.insert_or_assign(std::string(name), WordRef{&s, pair.value});
    }
    return {};
}

}  // namespace corpuscle::circuit
