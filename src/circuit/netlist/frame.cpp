#include "circuit/netlist/frame.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/netlist/number.hpp"

namespace corpuscle::circuit {
namespace {

/// Calls named(name) for each name in a formula's text; letters behind digits are a scale.
template <class Named>
void names_of(std::string_view text, Named&& named) {
    const auto digit = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
    for (std::size_t k = 0; k < text.size();) {
        const auto from = k;
        while (k < text.size() && (letter(text[k]) || digit(text[k]))) ++k;
        if (k == from)
            ++k;
        else if (letter(text[from]))
            named(text.substr(from, k - from));
    }
}

/// The names that a formula needs, those in the functions that it calls included.
std::vector<std::string> needs(std::string_view text, const Frame& frame) {
    std::vector<std::string> names;
    std::set<std::string, std::less<>> seen;
    std::vector<const FormulaScope::Function*> functions;
    const auto look_through = [&](std::string_view in, const FormulaScope::Function* of) {
        names_of(in, [&](std::string_view name) {
            const bool argument = of && std::find(of->arguments.begin(), of->arguments.end(), name) != of->arguments.end();
            if (argument || !seen.emplace(name).second) return;
            names.emplace_back(name);
            if (const auto* f = frame.function(name)) functions.push_back(f);
        });
    };
    look_through(text, nullptr);
    for (std::size_t k = 0; k < functions.size(); ++k) look_through(functions[k]->text, functions[k]);
    return names;
}

/// The same error, in the line that the formula stands in.
Error moved(const Error& error, const Text& text) {
    Error out = error;
    out.place = text.in->line.place(text.word.at + static_cast<std::size_t>(std::max(1L, error.place.column) - 1));
    return out;
}

}  // namespace

std::optional<double> Frame::parameter(std::string_view name) const {
    for (const Frame* f = this; f; f = f->caller)
        if (const auto at = f->parameters.find(name); at != f->parameters.end()) return at->second;
    return {};
}

const FormulaScope::Function* Frame::function(std::string_view name) const {
    for (const Frame* f = this; f; f = f->caller)
        if (const auto at = f->body->functions.find(name); at != f->body->functions.end()) return &at->second;
    return nullptr;
}

FormulaScope Frame::scope() const {
    FormulaScope s;
    s.parameter = [this](std::string_view name) { return parameter(name); };
    s.function = [this](std::string_view name) { return function(name); };
    return s;
}

std::vector<std::string> Frame::known() const {
    std::vector<std::string> names;
    for (const Frame* f = this; f; f = f->caller)
        for (const auto* part : {&f->body->parameters, &f->body->defaults})
            for (const auto& [name, text] : *part) names.push_back(name);
    return names;
}

Result<Formula> Frame::formula(const Text& text, FormulaScope scope) const {
    const Place place{text.in->line.file ? *text.in->line.file : "", 1, 1};
    auto read = Formula::parse(text.view(), place, scope);
    if (read) return read;
    scope.known = known();
    return moved(Formula::parse(text.view(), place, scope).error(), text);
}

Result<double> Frame::number(const Text& text) const {
    double value = 0;
    if (const auto plain = text.word.kind == Word::Kind::plain ? whole_number(text.view()) : std::nullopt) {
        if (auto why = ambiguous(*plain, text.view())) return bad_input(std::move(*why), text.place());
        value = plain->value;
    } else {
        const auto read = formula(text, scope());
        if (!read) return read.error();
        value = read->value();
    }
    if (std::isnan(value)) return bad_input(fmt::format("'{}' is not a number", text.view().substr(0, 60)), text.place());
    if (!std::isfinite(value))
        return bad_input(fmt::format("'{}' is {}, not a finite number", text.view().substr(0, 60), value), text.place());
    return value;
}

Result<void> Frame::define(const Values& given) {
    parameters = given;
    ByName<Text> pending;
    for (const auto* part : {&body->parameters, &body->defaults})
        for (const auto& [name, text] : *part)
            if (!parameters.contains(name)) pending.emplace(name, text);
    while (!pending.empty())
        if (const auto ok = define(std::string(pending.begin()->first), pending); !ok) return ok;
    return {};
}

/// Works out one and all it needs, those first; without recursion, which a long chain would take too deep.
Result<void> Frame::define(const std::string& first, ByName<Text>& pending) {
    struct Begun {
        std::string name;
        std::vector<std::string> needs;
        std::size_t next = 0;
    };
    std::vector<Begun> begun;
    std::set<std::string, std::less<>> in_work;
    const auto begin = [&](const std::string& name) {
        begun.push_back({name, needs(pending.find(name)->second.view(), *this)});
        in_work.insert(name);
    };
    const auto circle = [&](const std::string& name) {
        std::string chain;
        auto at = std::find_if(begun.begin(), begun.end(), [&](const Begun& b) { return b.name == name; });
        for (int shown = 0; at != begun.end() && shown < 20; ++at, ++shown) chain += at->name + " -> ";
        return bad_input(fmt::format("parameter {} goes round in a circle: {}{}", name, chain, name), pending.find(name)->second.place());
    };
    for (begin(first); !begun.empty();) {
        auto& top = begun.back();
        if (top.next < top.needs.size()) {
            const std::string& name = top.needs[top.next++];
            if (in_work.contains(name)) return circle(name);
            if (pending.contains(name)) begin(std::string(name));
            continue;
        }
        const auto value = number(pending.find(top.name)->second);
        if (!value) return value.error();
        parameters.emplace(top.name, *value);
        pending.erase(top.name);
        in_work.erase(top.name);
        begun.pop_back();
    }
    return {};
}

}  // namespace corpuscle::circuit
