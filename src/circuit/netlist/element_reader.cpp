// Reads an element line by its first letter.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/circuit_builder.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {
namespace {

/// The names that the reader accepts in name=value pairs of elements with this letter. The device refuses those that it does not support.
struct ParameterNames {
    char letter;
    std::initializer_list<std::string_view> names;
};
const ParameterNames parameter_names[] = {
    {'r', {"r", "tc1", "tc2", "m", "temp", "dtemp", "l", "w", "ac", "scale", "noisy"}},
    {'c', {"c", "q", "ic", "tc1", "tc2", "m", "temp", "dtemp", "l", "w", "scale"}},
    {'l', {"l", "ic", "tc1", "tc2", "m", "temp", "dtemp", "scale"}},
    {'v', {"dc", "ac", "td", "r"}},
    {'i', {"dc", "ac", "td", "r", "m"}},
    {'e', {"value", "vol"}},
    {'g', {"value", "cur", "m"}},
    {'f', {"m"}},
    {'h', {}},
    {'b', {"v", "i", "tc1", "tc2", "temp", "dtemp", "m"}},
    {'d', {"area", "m", "pj", "l", "w", "ic", "temp", "dtemp", "off"}},
    {'m', {"w",   "l",    "m",     "stack", "delvto", "mulu0", "ad", "as", "pd", "ps",  "nrd",
           "nrs", "temp", "dtemp", "off",   "geo",    "nf",    "sa", "sb", "sd", "area"}},
};

std::span<const std::string_view> names_for(char letter) {
    for (const auto& row : parameter_names)
        if (row.letter == letter) return {row.names.begin(), row.names.size()};
    return {};
}

class ElementReader {
    CircuitBuilder& builder_;
    Scope& scope_;
    const Statement& s_;
    std::string_view name_;  // as in the line, without path
    Element out_;
    std::vector<std::string_view> read_names_;  // names of the pairs that named_parameters() must skip, since other functions read them

public:
    ElementReader(CircuitBuilder& builder, Scope& scope, const Statement& s)
        : builder_(builder), scope_(scope), s_(s), name_(s.text(std::size_t{0})) {
        out_.name = scope.path + std::string(name_);
        out_.letter = name_[0];
        out_.location = s.line.location();
    }

    Result<void> read() {
        if (name_.size() < 2) return error_at("the name of an element must be longer than its letter, such as r1", 0);
        TRY(read_by_letter());
        TRY(named_parameters());
        override_values();
        TRY(apply_multiplicity());
        return builder_.add_element(std::move(out_));
    }

private:
    Result<void> read_by_letter() {
        switch (out_.letter) {
            case 'r':
            case 'c':
            case 'l':
                return passive();
            case 'v':
            case 'i':
                return source();
            case 'e':
            case 'g':
                return voltage_controlled_source();
            case 'f':
            case 'h':
                return current_controlled_source();
            case 'b':
                return behavioural_source();
            case 'd':
                return diode();
            default:
                return transistor();
        }
    }

    Error error_at(std::string_view message, std::size_t word) const {
        return bad_input(fmt::format("{}: {}", name_, message), s_.location(word));
    }
    Error too_many(std::size_t word) const { return error_at(fmt::format("unexpected '{}'", s_.text(word)), word); }

    /// Reads the first n words after the name as nodes. `expected` describes all words, for the error message.
    Result<void> nodes(std::size_t n, std::string_view expected) {
        for (std::size_t k = 1; k <= n; ++k) {
            if (k >= s_.words.size() || s_.words[k].kind != Word::Kind::plain)
                return error_at(fmt::format("{} node{}, but expected {}: {}", k - 1, k == 2 ? "" : "s", n, expected), k);
            out_.nodes.push_back(builder_.find_or_add_node(scope_, s_.text(k)));
        }
        return {};
    }
    WordRef text(std::size_t word) const { return {&s_, s_.words[word]}; }

    // ---- R C L ----

    Result<void> passive() {
        TRY(nodes(2, "plus, minus, then a value or a model"));
        bool has_value = false;
        for (std::size_t k = 3; k < s_.words.size(); ++k) {
            const bool is_name = is_model(k, has_value);
            if (is_name ? out_.model >= 0 : has_value) return too_many(k);
            TRY(is_name ? passive_model(k) : read_value(text(k)));
            has_value = has_value || !is_name;
        }
        const std::string_view letter(&out_.letter, 1);
        if (const auto* pair = out_.letter == 'l' || out_.model < 0 || !has_value ? s_.find(letter) : nullptr) {
            if (has_value) return bad_input(fmt::format("{}: its value is given twice", name_), s_.location(pair->name));
            read_names_.push_back(letter);
            TRY(read_value({&s_, pair->value}));
            has_value = true;
        }
        if (const auto* q = out_.letter == 'c' ? s_.find("q") : nullptr) {
            if (has_value) return bad_input(fmt::format("{}: has both a capacitance and a charge", name_), s_.location(q->name));
            return formula(*q);
        }
        if (!has_value && out_.model < 0) return error_at("its value is missing", s_.words.size());
        if (out_.letter == 'r' && has_value && out_.value == 0)
            return error_at("a resistor must not be 0 ohm; use a 0 V source to connect two nodes", 3);
        return {};
    }
    /// True if word k, after the nodes, names a model; otherwise it is the value. A word that is neither a number, an expression nor the
    /// name of a parameter names a model. After the value, the name of a parameter does, too.
    bool is_model(std::size_t k, bool has_value) const {
        if (s_.words[k].kind != Word::Kind::plain || parse_number(s_.text(k))) return false;
        if (builder_.has_model(scope_, s_.text(k))) return true;
        const bool begins_with_letter = s_.text(k)[0] >= 'a' && s_.text(k)[0] <= 'z';
        return begins_with_letter &&
               (has_value || (!scope_.parameter(s_.text(k)) && s_.text(k).find_first_of("*/+-") == std::string_view::npos));
    }
    Result<void> passive_model(std::size_t k) {
        const std::string_view type[] = {std::string_view(&out_.letter, 1)};
        return model(k, type);
    }
    Result<void> model(std::size_t k, std::span<const std::string_view> types) {
        out_.model = TRY(builder_.find_or_add_model(scope_, text(k), name_, types));
        return {};
    }
    Result<void> read_value(const WordRef& t) {
        const auto value = TRY(scope_.evaluate(t));
        out_.value = value;
        return {};
    }

    // ---- V I ----

    Result<void> source() {
        TRY(nodes(2, "plus and minus"));
        auto waveform = TRY(read_waveform(scope_, s_));
        out_.waveform = std::move(waveform);
        for (const auto name : {"dc", "ac", "td", "r"}) read_names_.push_back(name);
        return {};
    }

    // ---- E G F H B ----

    Result<void> voltage_controlled_source() {
        TRY(nodes(2, "plus, minus, the two controlling nodes, then the gain"));
        out_.expression_is_voltage = out_.letter == 'e';
        for (const auto name : {"value", "vol", "cur"})  // vol= and cur= are other names of value=
            if (const auto* pair = s_.find(name)) {
                if (s_.words.size() > 3) return too_many(3);
                return formula(*pair);
            }
        const auto kind = s_.text(3);
        if (kind == "poly" || kind == "table" || kind == "laplace" || kind == "freq")
            return error_at(fmt::format("{} is not supported; write value={{...}}", kind), 3);
        out_.expression_is_voltage = false;
        out_.nodes.clear();
        TRY(nodes(4, "plus, minus, the two controlling nodes, then the gain"));
        return gain(5);
    }
    /// Reads word k, which must be the last, as the gain.
    Result<void> gain(std::size_t k) {
        if (k >= s_.words.size()) return error_at("its gain is missing", k);
        if (s_.words.size() > k + 1) return too_many(k + 1);
        return read_value(text(k));
    }

    Result<void> current_controlled_source() {
        TRY(nodes(2, "plus, minus, then the controlling voltage source and the gain"));
        if (s_.text(3) == "poly") return error_at("poly is not supported; use a B source instead", 3);
        if (s_.words.size() < 4) return error_at("the controlling voltage source is missing", 3);
        out_.control_source = scope_.path + std::string(s_.text(3));
        builder_.forward_refs.push_back({out_.control_source, s_.location(std::size_t{3}), std::string(name_), ForwardRef::Target::source});
        return gain(4);
    }

    Result<void> behavioural_source() {
        TRY(nodes(2, "plus and minus, then v=... or i=..."));
        if (s_.words.size() > 3) return too_many(3);
        const auto *v = s_.find("v"), *i = s_.find("i");
        if (v && i) return bad_input(fmt::format("{}: has both v=... and i=...", name_), s_.location(i->name));
        if (!v && !i) return error_at("expected v=... or i=...", s_.words.size());
        out_.expression_is_voltage = v != nullptr;
        return formula(v ? *v : *i);
    }

    /// Reads the value of a pair as the expression of the element.
    Result<void> formula(const NameValue& pair) {
        read_names_.push_back(s_.text(pair.name));
        const WordRef t{&s_, pair.value};
        ExpressionScope scope = scope_.expression_scope();
        scope.allows_inputs = true;
        scope.node = [this](std::string_view name) { return builder_.node_name(scope_, name); };
        scope.element = [this](std::string_view name) { return scope_.path + std::string(name); };
        auto expression = TRY(scope_.parse_expression(t, std::move(scope)));
        for (const auto& input : expression.inputs()) add_forward_reference(input, t.location());
        out_.expression = std::move(expression);
        return {};
    }
    void add_forward_reference(const ExpressionInput& input, const SourceLocation& location) {
        using Kind = ExpressionInput::Kind;
        if (input.kind == Kind::current)
            builder_.forward_refs.push_back({input.name, location, std::string(name_), ForwardRef::Target::current});
        else if (input.kind == Kind::voltage)
            for (const auto& node : {input.name, input.minus})
                if (!node.empty()) builder_.forward_refs.push_back({node, location, std::string(name_), ForwardRef::Target::node});
    }

    // ---- D M ----

    Result<void> diode() {
        TRY(nodes(2, "anode, cathode, then the model"));
        if (s_.words.size() < 4) return error_at("its model is missing", 3);
        constexpr std::string_view types[] = {"d"};
        TRY(model(3, types));
        for (std::size_t k = 4; k < s_.words.size(); ++k) {
            if (s_.text(k) == "off") {
                out_.values["off"] = 1;
                continue;
            }
            if (k > 4 || s_.find("area")) return too_many(k);
            const auto area = TRY(scope_.evaluate(text(k)));
            out_.values["area"] = area;
        }
        return {};
    }

    Result<void> transistor() {
        constexpr std::string_view expected = "drain, gate, source, bulk, then the model";
        constexpr std::string_view types[] = {"nmos", "pmos"};
        if (s_.words.size() == 5 && builder_.has_model(scope_, s_.text(4)))
            return error_at(fmt::format("3 nodes, but expected 4: {}", expected), 4);
        TRY(nodes(4, expected));
        if (s_.words.size() < 6) return error_at("its model is missing", 5);
        if (s_.words.size() > 6 && !builder_.has_model(scope_, s_.text(5)) && builder_.has_model(scope_, s_.text(6)))
            return error_at(fmt::format("5 nodes, but expected 4: {}", expected), 5);
        TRY(model(5, types));
        for (std::size_t k = 6; k < s_.words.size(); ++k) {
            if (s_.text(k) != "off") return too_many(k);
            out_.values["off"] = 1;
        }
        return {};
    }

    // ---- name=value ----

    Result<void> named_parameters() {
        const auto known = names_for(out_.letter);
        for (const auto& pair : s_.pairs) {
            const auto name = s_.text(pair.name);
            if (std::find(known.begin(), known.end(), name) == known.end())
                return bad_input(fmt::format("{}: unknown parameter '{}'{}", name_, name, did_you_mean(name, known)),
                                 s_.location(pair.name));
            if (std::find(read_names_.begin(), read_names_.end(), name) != read_names_.end()) continue;
            const auto value = TRY(scope_.evaluate({&s_, pair.value}));
            out_.values.insert_or_assign(std::string(name), value);
        }
        if (const auto* m = s_.find("m"); m && !(out_.values["m"] > 0))
            return bad_input(fmt::format("{}: m = {:g} must be positive", name_, out_.values["m"]), s_.location(m->value));
        return {};
    }

    /// Replaces values of the line by those of the overrides.
    void override_values() {
        const auto overrides = builder_.overrides.numbers.find(out_.name);
        if (overrides == builder_.overrides.numbers.end()) return;
        const bool is_source = out_.letter == 'v' || out_.letter == 'i';
        for (const auto& [name, value] : overrides->second) {
            if (!name.empty())
                out_.values.insert_or_assign(name, value);
            else if (is_source)
                out_.waveform.dc = value, out_.waveform.has_dc = true;
            else
                out_.value = value;
        }
    }

    /// Applies the m= of the subcircuits around the element. In m parallel copies of a subcircuit every current is m times as large, while
    /// the voltages are those of one copy. The current that controls an F or H already has this factor, so the gain of F stays and that of
    /// H is divided by it.
    Result<void> apply_multiplicity() {
        if (scope_.m == 1) return {};
        if (out_.letter == 'h') out_.value /= scope_.m;
        if (out_.expression)
            for (const auto& input : out_.expression->inputs())
                if (input.kind == ExpressionInput::Kind::current)
                    return error_at("an expression with a current is not supported in a subcircuit with m=", 0);
        const bool is_voltage =
            out_.letter == 'v' || out_.letter == 'e' || out_.letter == 'h' || (out_.letter == 'b' && out_.expression_is_voltage);
        if (is_voltage || out_.letter == 'f') return {};
        const auto at = out_.values.try_emplace("m", 1).first;
        at->second *= scope_.m;
        return {};
    }
};

}  // namespace

Result<void> read_element(CircuitBuilder& builder, Scope& scope, const Statement& s) { return ElementReader(builder, scope, s).read(); }

}  // namespace corpuscle::circuit
