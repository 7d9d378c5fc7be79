#include "circuit/netlist/element_reader.hpp"

#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/parasitic/parasitics.hpp"
#include "circuit/netlist/scope.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {

namespace {

/// The last word of a line that names a model; 0 if none does.
std::size_t find_model_word(Scope& scope, const Statement& s) {
    std::size_t k = s.words.size() - 1;
    while (k > 0 && scope.definer_of_model(s.text(k)) == nullptr) --k;
    return k;
}

/// True for what LTspice writes into the line of an R, C or L about the part and its limits, and that no equation has.
bool is_rating(const DeviceKind& kind, std::string_view name) {
    constexpr std::string_view ratings[] = {"irms", "ipk", "v", "tol", "pwr", "mfg", "type", "pn"};
    return std::string_view("rcl").find(kind.letter) != std::string_view::npos && std::ranges::find(ratings, name) != std::end(ratings);
}

/// The kind of device of a line: by its letter, and by the level of its model if it has one.
const DeviceKind& find_kind(Scope& scope, const Statement& s) {
    const auto model = find_model_word(scope, s);
    return *find_device_kind(s.text(0)[0], model == 0 ? std::nullopt : scope.model_level(s.text(model)));
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
    if (refuse_level()) return {};
    TRY(kind_.read(*this));
    TRY(named_parameters());
    apply_size_options();
    TRY(apply_step());
    override_values();
    TRY(apply_tolerances());
    TRY(apply_multiplicity());
    TRY(add_parasitics(builder_, element, scope_.m));
    return builder_.add_element(std::move(element));
}

bool ElementReader::refuse_level() {
    const auto word = find_model_word(scope_, s_);
    const auto level = word == 0 ? std::nullopt : scope_.model_level(text(word));
    if (!level || kind_.level == 0 || has_level(kind_, *level)) return false;
    auto error =
        error_at(word, "model '{}' has level {:g}, which is not supported; use {}", text(word), *level, supported_levels(kind_.letter));
    builder_.refusals.add_device(std::move(error), fmt::format("level {:g} of {}", *level, kind_.letter), element.name);
    return true;
}

Error ElementReader::too_many(std::size_t word) const {
    const bool is_in_list = continues_initial_voltages(word, word_count());
    if (const auto number = number_with_decimal_comma(word); !number.empty() && !is_in_list) {
        const bool may_be_thousands = text(word).find_first_not_of("0123456789") == 3 || text(word).size() == 3;
        return error_at(word - 1, "'{},{}' has a decimal comma; write {}{}", text(word - 1), text(word), number,
                        may_be_thousands ? fmt::format(", or {}{}", text(word - 1), text(word)) : "");
    }
    return error_at(word, "unexpected '{}'", text(word));
}

std::vector<Word> ElementReader::words_of(const Word& value) const {
    std::vector<Word> out;
    const auto text = s_.text(value);
    constexpr std::string_view separators = "(), \t";
    for (auto at = text.find_first_not_of(separators); at != std::string_view::npos;) {
        const auto end = std::min(text.find_first_of(separators, at), text.size());
        out.push_back({Word::Kind::plain, static_cast<std::uint32_t>(value.at + at), static_cast<std::uint32_t>(end - at)});
        at = text.find_first_not_of(separators, end);
    }
    return out;
}

std::string ElementReader::number_with_decimal_comma(std::size_t word) const {
    if (word < 2 || word >= word_count()) return "";
    const auto before = text(word - 1), after = text(word);
    const auto digits = before.substr(before.starts_with('-') || before.starts_with('+'));
    const bool is_whole = !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
    const bool is_split_by_comma = s_.words[word].at == s_.words[word - 1].at + before.size() + 1 && is_after_comma(word);
    const bool is_fraction = !after.empty() && after[0] >= '0' && after[0] <= '9' && parse_number(after);
    return is_whole && is_split_by_comma && is_fraction ? fmt::format("{}.{}", before, after) : "";
}

bool ElementReader::is_after_comma(std::size_t word) const {
    const auto at = s_.words[word].at;
    const auto before = at == 0 ? std::string_view::npos : std::string_view(s_.line.text).find_last_not_of(" \t", at - 1);
    return before != std::string_view::npos && s_.line.text[before] == ',';
}

bool ElementReader::is_model(std::size_t word) const { return scope_.definer_of_model(text(word)) != nullptr; }
bool ElementReader::is_parameter(std::size_t word) const { return scope_.parameter(text(word)).has_value(); }

Result<void> ElementReader::nodes(std::size_t n, std::string_view expected) { return nodes_from(1, n, expected); }

Result<void> ElementReader::nodes_from(std::size_t first, std::size_t n, std::string_view expected) {
    for (std::size_t k = first; k < first + n; ++k) {
        if (k >= word_count() || !is_plain(k)) {
            const auto found = element.nodes.size();
            return error_at(k, "{} node{}, but expected {}: {}", found, found == 1 ? "" : "s", found + first + n - k, expected);
        }
        element.nodes.push_back(builder_.find_or_add_node(scope_, text(k)));
    }
    return {};
}

Result<void> ElementReader::model(std::size_t word, std::initializer_list<std::string_view> types) {
    element.model = TRY(builder_.find_or_add_model(scope_, {&s_, s_.words[word]}, name_, {types.begin(), types.size()}));
    return {};
}

void ElementReader::drop_unknown_model_values(std::span<const std::string_view> known, std::span<const std::string_view> ignored) {
    auto& model = builder_.circuit.models[static_cast<std::size_t>(element.model)];
    std::erase_if(model.values, [&](const auto& value) {
        const std::string& name = value.first;
        const auto is_in = [&](std::span<const std::string_view> names) { return std::ranges::find(names, name) != names.end(); };
        if (is_in(known) || (!is_in(ignored) && !did_you_mean(name, known).empty())) return false;
        if (is_in(ignored) && value.second == 0) return true;
        builder_.warn_once(circuit::error_at(model.location, "{}: models of type {} have no parameter '{}', so it has no effect",
                                             model.name, model.type, name));
        return true;
    });
}

bool ElementReader::continues_initial_voltages(std::size_t word, std::size_t count) const {
    const auto* ic = find("ic");
    return ic != nullptr && this->word(word).at > ic->value.at && (word < count || this->word(word - count).at < ic->value.at);
}

Result<double> ElementReader::number(std::size_t word) const { return scope_.evaluate({&s_, s_.words[word]}); }

Result<double> ElementReader::number(const Word& word) const { return scope_.evaluate({&s_, word}); }

void ElementReader::warn(std::size_t word, std::string_view message) {
    builder_.circuit.warnings.push_back(error_in(s_.location(word), message));
}

void ElementReader::warn_about_model(std::string_view message) {
    const auto& model = builder_.circuit.models[static_cast<std::size_t>(element.model)];
    builder_.warn_once(circuit::error_at(model.location, "{}: {}", model.name, message));
}

Result<double> ElementReader::number(const NameValue& pair) {
    read_names_.push_back(s_.text(pair.name));
    return scope_.evaluate({&s_, pair.value});
}

void ElementReader::control_source(std::size_t word) {
    element.control_source = scope_.path + std::string(text(word));
    builder_.forward_refs.push_back({element.control_source, s_.location(word), std::string(name_), ForwardRef::Target::current});
}

void ElementReader::inductor(std::size_t word) {
    element.inductors.push_back(scope_.path + std::string(text(word)));
    builder_.forward_refs.push_back({element.inductors.back(), s_.location(word), std::string(name_), ForwardRef::Target::inductor});
}

std::optional<double> ElementReader::model_value(std::string_view name) const {
    if (element.model < 0) return {};
    const auto& values = builder_.circuit.models[static_cast<std::size_t>(element.model)].values;
    const auto at = values.find(name);
    return at == values.end() ? std::nullopt : std::optional(at->second);
}

std::string_view ElementReader::model_type() const { return builder_.circuit.models[static_cast<std::size_t>(element.model)].type; }

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
        if (find_tolerance(name) != nullptr || is_rating(kind_, name)) continue;  // see apply_tolerances()
        if (std::find(read_names_.begin(), read_names_.end(), name) != read_names_.end()) continue;
        if (std::find(known.begin(), known.end(), name) == known.end())
            return error_at(pair.name, "unknown parameter '{}'{}", name, did_you_mean(name, known));
        const auto value = TRY(scope_.evaluate({&s_, pair.value}));
        element.values.insert_or_assign(std::string(name), value);
    }
    if (const auto* m = s_.find("m"); m && !(element.values["m"] > 0))
        return error_at(m->value, "m = {:g} must be positive", element.values["m"]);
    return {};
}

/// Applies .options scale to the size in the line of a MOS transistor, and defl, defw, defad, defas, defnrd and defnrs where the line does
/// not give it. As in ngspice, the defaults are not scaled.
void ElementReader::apply_size_options() {
    if (element.letter != 'm') return;
    const auto& options = builder_.circuit.options;
    const auto scale = options.find("scale");
    for (auto& [name, value] : element.values) {
        if (scale == options.end()) break;
        if (name == "l" || name == "w" || name == "pd" || name == "ps") value *= scale->second;
        if (name == "ad" || name == "as") value *= scale->second * scale->second;
    }
    for (const auto& p : kind_.parameters)
        if (const auto given = options.find("def" + std::string(p.name)); given != options.end())
            element.values.try_emplace(std::string(p.name), given->second);
}

/// Replaces the value of the line by that of .step.
Result<void> ElementReader::apply_step() {
    const auto stepped = builder_.stepped.find(element.name);
    if (stepped == builder_.stepped.end()) return {};
    const bool has_value = std::ranges::any_of(kind_.parameters, [](const ElementParameter& p) { return p.is_value; });
    if (!has_value || element.expression)
        return error_at(0, ".step: a {} has no value to step; write {{x}} in its line or model, and .step param x", kind_.description);
    set_main_value(element, stepped->second);
    builder_.stepped_elements.insert(element.name);
    return {};
}

/// Replaces values of the line by those of the overrides.
void ElementReader::override_values() {
    const auto overrides = builder_.overrides.numbers.find(element.name);
    if (overrides == builder_.overrides.numbers.end()) return;
    for (const auto& [name, value] : overrides->second)
        name.empty() ? set_main_value(element, value) : void(element.values.insert_or_assign(name, value));
}

/// Multiplies the value by the factors that dev= and lot= of the line, or of its model, draw.
Result<void> ElementReader::apply_tolerances() {
    for (const auto& t : tolerance_names) {
        const auto given = TRY(tolerance(t.name));
        if (!given) continue;
        if (element.expression || (is_independent_source(element) && element.waveform.shape != Waveform::Shape::none))
            return error_at(0, "{}= needs a constant value", t.name);
        auto& random = builder_.random;
        const auto lot = element.model < 0 ? element.name : builder_.circuit.models[static_cast<std::size_t>(element.model)].name;
        const double factor = t.is_lot ? random.lot_factor(lot, *given, t.is_normal) : random.element_factor(*given, t.is_normal);
        set_main_value(element, main_value(element) * factor);
    }
    return {};
}

/// The tolerance of this name in the line, else in the model.
Result<std::optional<double>> ElementReader::tolerance(std::string_view name) {
    std::optional<double> out;
    if (element.model >= 0) {
        const auto& tolerances = builder_.circuit.models[static_cast<std::size_t>(element.model)].tolerances;
        if (const auto at = tolerances.find(name); at != tolerances.end()) out = at->second;
    }
    if (const auto* pair = s_.find(name)) out = TRY(scope_.evaluate_tolerance({&s_, pair->value}));
    const auto has_value = [](const ElementParameter& p) { return p.is_value; };
    if (out && std::ranges::none_of(kind_.parameters, has_value))
        return error_at(0, "{} is not supported for a {}, only for an element with a value", name, kind_.description);
    return out;
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
