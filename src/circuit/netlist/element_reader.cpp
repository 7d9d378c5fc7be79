#include "circuit/netlist/element_reader.hpp"

#include "circuit/devices.hpp"
#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

namespace {

/// The kind of device of a line: by its letter, and by the level of its model if it has one.
const DeviceKind& find_kind(Scope& scope, const Statement& s) {
    const char letter = s.text(0)[0];
    std::optional<double> level;
    for (std::size_t k = s.words.size() - 1; k > 0 && !level; --k) level = scope.model_level(s.text(k));
    return *find_device_kind(letter, level);
}

}  // namespace

ElementReader::ElementReader(CircuitBuilder& builder, Scope& scope, const Statement& s)
    : builder_(builder), scope_(scope), s_(s), kind_(find_kind(scope, s)), name_(s.text(0)) {
    element.kind = &kind_;
    element.name = scope.path + std::string(name_);
    element.letter = name_[0];
    element.location = s.line.location();
}

Result<void> ElementReader::read() {
    TRY(kind_.read(*this));
    TRY(named_parameters());
    override_values();
    TRY(apply_multiplicity());
    return builder_.add_element(std::move(element));
}

Error ElementReader::too_many(std::size_t word) const { return error_at(word, "unexpected '{}'", text(word)); }

bool ElementReader::is_model(std::size_t word) const { return scope_.definer_of_model(text(word)) != nullptr; }
bool ElementReader::is_parameter(std::size_t word) const { return scope_.parameter(text(word)).has_value(); }

Result<void> ElementReader::nodes(std::size_t n, std::string_view expected) {
    for (std::size_t k = 1; k <= n; ++k) {
        if (k >= word_count() || !is_plain(k)) return error_at(k, "{} node{}, but expected {}: {}", k - 1, k == 2 ? "" : "s", n, expected);
        element.nodes.push_back(builder_.find_or_add_node(scope_, text(k)));
    }
    return {};
}

Result<void> ElementReader::model(std::size_t word, std::initializer_list<std::string_view> types) {
    element.model = TRY(builder_.find_or_add_model(scope_, {&s_, s_.words[word]}, name_, {types.begin(), types.size()}));
    return {};
}

Result<double> ElementReader::number(std::size_t word) const { return scope_.evaluate({&s_, s_.words[word]}); }

Result<double> ElementReader::number(const Word& word) const { return scope_.evaluate({&s_, word}); }

void ElementReader::warn(std::size_t word, std::string_view message) {
    builder_.circuit.warnings.push_back(error_in(s_.location(word), message));
}

Result<double> ElementReader::number(const NameValue& pair) {
    read_names_.push_back(s_.text(pair.name));
    return scope_.evaluate({&s_, pair.value});
}

void ElementReader::control_source(std::size_t word) {
    element.control_source = scope_.path + std::string(text(word));
    builder_.forward_refs.push_back({element.control_source, s_.location(word), std::string(name_), ForwardRef::Target::source});
}

std::optional<double> ElementReader::model_value(std::string_view name) const {
    if (element.model < 0) return {};
    const auto& values = builder_.circuit.models[static_cast<std::size_t>(element.model)].values;
    const auto at = values.find(name);
    return at == values.end() ? std::nullopt : std::optional(at->second);
}

SourceLocation ElementReader::model_location() const { return builder_.circuit.model_of(element)->location; }

Result<void> ElementReader::expression(const NameValue& pair) {
    read_names_.push_back(s_.text(pair.name));
    return parse_expression({&s_, pair.value});
}

Result<void> ElementReader::expression(std::string text, const Word& from) {
    const auto location = s_.location(from);
    Statement generated;
    generated.line.file = s_.line.file;
    generated.line.segments = {{0, static_cast<std::uint32_t>(location.line), static_cast<std::uint32_t>(location.column)}};
    generated.line.text = std::move(text);
    return parse_expression({&generated, {Word::Kind::expression, 0, static_cast<std::uint32_t>(generated.line.text.size())}});
}

Result<void> ElementReader::parse_expression(const WordRef& t) {
    ExpressionScope scope = scope_.expression_scope();
    scope.allows_inputs = true;
    scope.node = [this](std::string_view name) { return builder_.node_name(scope_, name); };
    scope.element = [this](std::string_view name) { return scope_.path + std::string(name); };
    auto expression = TRY(scope_.parse_expression(t, std::move(scope)));
    for (const auto& input : expression.inputs()) add_forward_reference(input, t.location());
    element.expression = std::move(expression);
    return {};
}

void ElementReader::add_forward_reference(const ExpressionInput& input, const SourceLocation& location) {
    using Kind = ExpressionInput::Kind;
    if (input.kind == Kind::current)
        builder_.forward_refs.push_back({input.name, location, std::string(name_), ForwardRef::Target::current});
    else if (input.kind == Kind::voltage)
        for (const auto& node : {input.name, input.minus})
            if (!node.empty()) builder_.forward_refs.push_back({node, location, std::string(name_), ForwardRef::Target::node});
}

/// Reads the name=value pairs that the device has not read itself.
Result<void> ElementReader::named_parameters() {
    std::vector<std::string_view> known;
    for (const auto& p : kind_.parameters)
        if (!p.name.empty()) known.push_back(p.name);
    known.insert(known.end(), kind_.other_names.begin(), kind_.other_names.end());
    for (const auto& pair : s_.pairs) {
        const auto name = s_.text(pair.name);
        if (std::find(known.begin(), known.end(), name) == known.end())
            return error_at(pair.name, "unknown parameter '{}'{}", name, did_you_mean(name, known));
        if (std::find(read_names_.begin(), read_names_.end(), name) != read_names_.end()) continue;
        const auto value = TRY(scope_.evaluate({&s_, pair.value}));
        element.values.insert_or_assign(std::string(name), value);
    }
    if (const auto* m = s_.find("m"); m && !(element.values["m"] > 0))
        return error_at(m->value, "m = {:g} must be positive", element.values["m"]);
    return {};
}

/// Replaces values of the line by those of the overrides.
void ElementReader::override_values() {
    const auto overrides = builder_.overrides.numbers.find(element.name);
    if (overrides == builder_.overrides.numbers.end()) return;
    for (const auto& [name, value] : overrides->second)
        name.empty() ? set_main_value(element, value) : void(element.values.insert_or_assign(name, value));
}

/// Applies the m= of the subcircuits around the element.
Result<void> ElementReader::apply_multiplicity() {
    if (scope_.m == 1) return {};
    if (element.expression)
        for (const auto& input : element.expression->inputs())
            if (input.kind == ExpressionInput::Kind::current)
                return error_at(0, "an expression with a current is not supported in a subcircuit with m=");
    kind_.multiply(element, scope_.m);
    return {};
}

Result<void> read_element(CircuitBuilder& builder, Scope& scope, const Statement& s) { return ElementReader(builder, scope, s).read(); }

}  // namespace corpuscle::circuit
