// Controlled sources (E F G H) and sources with an expression (B, E, G).

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

/// v(+) - v(-) = gain times a voltage (E) or a current (H). Unknowns: two nodes and the current through the source, then from index 3 the
/// two controlling nodes or the controlling current.
class ControlledVoltageSource final : public DeviceWithValue {
public:
    using DeviceWithValue::DeviceWithValue;  // the gain
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        out.add_branch(v);
        out.f[2] -= value_ * (v[3] - (v.size() > 4 ? v[4] : 0));
        out.slope(2, 3) -= value_;
        if (v.size() > 4) out.slope(2, 4) += value_;
    }
};

/// i = gain times a voltage (G) or a current (F). Unknowns: two nodes, then from index 2 the two controlling nodes or the controlling
/// current.
class ControlledCurrentSource final : public DeviceWithValue {
public:
    using DeviceWithValue::DeviceWithValue;  // the gain
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        Stamp::add_between(out.f, 0, 1, value_ * (v[2] - (v.size() > 3 ? v[3] : 0)));
        out.slope(0, 2) += value_, out.slope(1, 2) -= value_;
        if (v.size() > 3) out.slope(0, 3) -= value_, out.slope(1, 3) += value_;
    }
};

Result<std::unique_ptr<Device>> make_expression_source(const Element& e, DeviceSetup& setup) {
    return make_expression_device(e, setup, e.expression_is_voltage ? ExpressionQuantity::voltage : ExpressionQuantity::current);
}

/// The gain of a current source is multiplied by m.
Result<std::unique_ptr<Device>> make_controlled_source(const Element& e, DeviceSetup& setup) {
    if (e.expression) return make_expression_source(e, setup);
    auto unknowns = setup.ends(e);
    const bool is_voltage = unknowns.size() > 2;
    if (e.control_source.empty()) {
        for (const auto k : {2, 3}) unknowns.push_back(setup.node_unknown(e.nodes[static_cast<std::size_t>(k)]));
    } else {
        unknowns.push_back(setup.branch_unknown(setup.circuit().find_element(e.control_source)));
        if (unknowns.back() < 0) return error_at(e.location, "{}: unknown controlling voltage source '{}'", e.name, e.control_source);
    }
    if (is_voltage) return make_device<ControlledVoltageSource>(std::move(unknowns), e.value);
    return make_device<ControlledCurrentSource>(std::move(unknowns), e.value * value_or(e.values, "m", 1));
}

// ---- netlist ----

/// Reads the word, which must be the last, as the gain.
Result<void> read_gain(ElementReader& line, std::size_t word) {
    if (word >= line.word_count()) return line.error_at(word, "its gain is missing");
    if (line.word_count() > word + 1) return line.too_many(word + 1);
    return line.value(word);
}

/// The products of a polynomial of n inputs in SPICE's order, as lists of inputs: 1, x0 .. x(n-1), x0 x0, x0 x1 .. up to `count`.
std::vector<std::vector<std::size_t>> polynomial_terms(std::size_t n, std::size_t count) {
    std::vector<std::vector<std::size_t>> out = {{}};
    for (std::size_t from = 0; out.size() < count;) {  // each degree follows from the one before
        const std::size_t to = out.size();
        for (std::size_t first = 0; first < n; ++first)
            for (std::size_t k = from; k < to && out.size() < count; ++k)
                if (out[k].empty() || first <= out[k].front()) {
                    auto product = out[k];
                    product.insert(product.begin(), first);
                    out.push_back(std::move(product));
                }
        from = to;
    }
    return out;
}

/// Reads "poly(n)", from word `at` on: the n inputs, each of `words_each` words, then the coefficients. The polynomial becomes the
/// element's expression.
Result<void> read_polynomial(ElementReader& line, std::size_t at, std::size_t words_each) {
    constexpr double max_inputs = 1000;
    const double n = line.word_count() > at + 1 ? TRY(line.number(at + 1)) : 0;
    if (!(n >= 1 && n <= max_inputs && n == std::floor(n)))
        return line.error_at(at + 1, "poly: expected the number of inputs in parentheses, such as poly(2)");
    const auto inputs = static_cast<std::size_t>(n);
    const std::size_t first_input = at + 2, first_coefficient = first_input + inputs * words_each;
    if (line.word_count() <= first_coefficient)
        return line.error_at(line.word_count(), "poly({}): expected {}, then the coefficients", inputs,
                             words_each == 2 ? fmt::format("{} pairs of nodes", inputs) : fmt::format("{} voltage sources", inputs));
    std::vector<std::string> names;
    for (std::size_t k = 0; k < inputs; ++k)
        names.push_back(words_each == 2 ? fmt::format("v({},{})", line.text(first_input + 2 * k), line.text(first_input + 1 + 2 * k))
                                        : fmt::format("i({})", line.text(first_input + k)));
    const std::size_t count = line.word_count() - first_coefficient;
    const bool is_gain = inputs == 1 && count == 1;  // a single coefficient is that of the input, as in SPICE
    const auto terms = polynomial_terms(inputs, is_gain ? 2 : count);
    std::string text;
    for (std::size_t k = 0; k < count; ++k) {
        text += fmt::format("{}({:.17g})", k == 0 ? "" : "+", TRY(line.number(first_coefficient + k)));
        for (const auto input : terms[k + is_gain]) text += "*" + names[input];
    }
    line.element.expression_is_voltage = has_branch_current(line.element);
    return line.expression(std::move(text), line.word(at));
}

/// Reads "table {EXPRESSION} = (x,y) (x,y) ...", from word 3 on; the '=' may be missing. The table becomes the element's expression.
Result<void> read_table(ElementReader& line) {
    constexpr std::string_view usage = "table: expected table {EXPRESSION} = (x1,y1) (x2,y2) ...";
    std::string numbers;
    const auto add = [&](double x) { numbers += fmt::format(",{:.17g}", x); };
    std::size_t first = 5;  // word of the first number, or of the third if '=' follows the expression
    const auto* pair = line.pair_of_expression();
    if (pair != nullptr) {
        line.take(*pair);
        for (const auto& word : line.words_of(pair->value)) add(TRY(line.number(word)));
        first = 4;
    } else if (line.word_count() < 5 || line.is_plain(4)) {
        return line.error_at(4, "{}", usage);
    }
    for (auto k = first; k < line.word_count(); ++k) add(TRY(line.number(k)));
    const auto& expression = pair ? pair->name : line.word(4);
    line.element.expression_is_voltage = has_branch_current(line.element);
    return line.expression(fmt::format("table({}{})", line.text(expression), numbers), line.word(3));
}

/// The first word after the two nodes and the name, such as vcvs, that HSPICE gives the kind of source.
std::size_t word_after_kind(const ElementReader& line) {
    constexpr std::pair<char, std::string_view> kinds[] = {{'e', "vcvs"}, {'g', "vccs"}, {'f', "cccs"}, {'h', "ccvs"}};
    return std::ranges::find(kinds, std::pair(line.element.letter, line.text(3))) != std::end(kinds) ? 4 : 3;
}

/// Reads "value {EXPRESSION}" of PSpice, from word 3 on.
Result<void> read_value_without_equals(ElementReader& line) {
    if (line.word_count() < 5 || line.is_plain(4)) return line.error_at(4, "{0}: expected {0}={{EXPRESSION}}", line.text(3));
    if (line.word_count() > 5) return line.too_many(5);
    line.element.expression_is_voltage = has_branch_current(line.element);
    return line.expression(std::string(line.text(4)), line.word(4));
}

/// The refusal of a function that other simulators have in E and G; "" for any other word.
std::string foreign_function(std::string_view word) {
    if (word == "laplace" || word == "freq") return fmt::format("{} is not supported; write value={{...}}", word);
    if (word == "opamp") return "opamp is not supported; write the four nodes and a gain, such as 1e6";
    for (const std::string_view name : {"vcr", "vccap", "delay", "and", "nand", "or", "nor", "pwl", "ppwl", "npwl", "transformer"})
        if (word == name) return fmt::format("{} is not supported; write value={{...}} or table {{...}} = (x1,y1) (x2,y2) ...", word);
    return "";
}

Result<void> read_voltage_controlled(ElementReader& line) {
    constexpr std::string_view expected = "plus, minus, the two controlling nodes, then the gain";
    TRY(line.nodes(2, expected));
    for (const auto name : {"value", "vol", "cur"})  // vol= and cur= are other names of value=
        if (const auto* pair = line.find(name)) {
            line.element.expression_is_voltage = line.element.letter == 'e';
            if (line.word_count() > 3) return line.too_many(3);
            return line.expression(*pair);
        }
    const auto word = line.text(3);
    if (word == "value" || word == "vol" || word == "cur") return read_value_without_equals(line);
    if (word == "table") return read_table(line);
    const bool is_function = line.word_count() != 6;  // else the name of a node
    if (const auto refusal = is_function ? foreign_function(word) : ""; !refusal.empty()) return line.error_at(3, "{}", refusal);
    const auto k = word_after_kind(line);
    if (line.text(k) == "poly") return read_polynomial(line, k, 2);
    TRY(line.nodes_from(k, 2, expected));
    return read_gain(line, k + 2);
}

Result<void> read_current_controlled(ElementReader& line) {
    TRY(line.nodes(2, "plus, minus, then the controlling voltage source and the gain"));
    const auto k = word_after_kind(line);
    if (line.text(k) == "poly") return read_polynomial(line, k, 1);
    if (line.word_count() < k + 1) return line.error_at(k, "the controlling voltage source is missing");
    line.control_source(k);
    return read_gain(line, k + 1);
}

Result<void> read_expression_source(ElementReader& line) {
    TRY(line.nodes(2, "plus and minus, then v=... or i=..."));
    if (line.word_count() > 3) return line.too_many(3);
    const auto *v = line.find("v"), *i = line.find("i");
    if (v && i) return line.error_at(i->name, "has both v=... and i=...");
    if (!v && !i) return line.error_at(line.word_count(), "expected v=... or i=...");
    line.element.expression_is_voltage = v != nullptr;
    return line.expression(v ? *v : *i);
}

// ---- export ----

Result<std::string> write_controlled_source(const ElementExport& e) {
    if (!e.element.expression) {
        const auto control = e.element.control_source.empty() ? "" : ' ' + e.names.element(e.element.control_source);
        return fmt::format("{}{} {}\n", e.head, control, e.element.value * (has_branch_current(e.element) ? 1 : e.value("m", 1)));
    }
    const auto text = TRY(e.expression());
    const bool is_voltage = has_branch_current(e.element);
    if (e.element.letter == 'f' || e.element.letter == 'h')  // ngspice has no expression there
        return fmt::format("b_{} {} {} {}={}\n", e.names.element(e.element.name), e.names.node(e.element.nodes[0]),
                           e.names.node(e.element.nodes[1]), is_voltage ? "v" : "i", text);
    return fmt::format("{} {}='{}'\n", e.head, is_voltage ? "vol" : "cur", text);
}

Result<std::string> write_expression_source(const ElementExport& e) {
    const auto text = TRY(e.expression());
    return fmt::format("{} {}={}\n", e.head, has_branch_current(e.element) ? "v" : "i", text);
}

// ---- rows ----

bool gives_voltage(const Element& e) { return e.expression_is_voltage; }

/// A constant current, unlike one that depends on a voltage, cannot set the voltage of an otherwise floating node.
std::vector<int> nodes_of_expression_source(const Element& e) {
    return gives_voltage(e) || !e.expression->is_constant() ? first_two_nodes(e) : no_nodes(e);
}

/// The controlling current is that of all copies.
void divide_gain(Element& e, double m) { e.value /= m; }
void multiply_expression_source(Element& e, double m) {
    if (!gives_voltage(e)) multiply_m(e, m);
}

constexpr ElementParameter gain[] = {{.name = "", .unit = "", .is_value = true}};
constexpr std::string_view voltage_expression_names[] = {"value", "vol"}, current_expression_names[] = {"value", "cur", "m"},
                           controlled_current_names[] = {"m"}, expression_source_names[] = {"v", "i", "temp", "dtemp", "m"},
                           value_names[] = {"value", "vol", "cur"}, v_and_i[] = {"v", "i"};

}  // namespace

extern constexpr DeviceKind voltage_controlled_voltage_kind = {.letter = 'e',
                                                               .description = "voltage source controlled by a voltage or an expression",
                                                               .read = read_voltage_controlled,
                                                               .make = make_controlled_source,
                                                               .parameters = gain,
                                                               .other_names = voltage_expression_names,
                                                               .expression_names = value_names,
                                                               .has_branch_current = always,
                                                               .multiply = keep_value,
                                                               .area = no_area,
                                                               .write_spice = write_controlled_source};

extern constexpr DeviceKind current_controlled_current_kind = {.letter = 'f',
                                                               .description = "current source controlled by a current",
                                                               .read = read_current_controlled,
                                                               .make = make_controlled_source,
                                                               .parameters = gain,
                                                               .other_names = controlled_current_names,
                                                               .multiply = keep_value,
                                                               .area = no_area,
                                                               .write_spice = write_controlled_source};

extern constexpr DeviceKind voltage_controlled_current_kind = {.letter = 'g',
                                                               .description = "current source controlled by a voltage or an expression",
                                                               .read = read_voltage_controlled,
                                                               .make = make_controlled_source,
                                                               .parameters = gain,
                                                               .other_names = current_expression_names,
                                                               .expression_names = value_names,
                                                               .area = no_area,
                                                               .write_spice = write_controlled_source};

extern constexpr DeviceKind current_controlled_voltage_kind = {.letter = 'h',
                                                               .description = "voltage source controlled by a current",
                                                               .read = read_current_controlled,
                                                               .make = make_controlled_source,
                                                               .parameters = gain,
                                                               .has_branch_current = always,
                                                               .multiply = divide_gain,
                                                               .area = no_area,
                                                               .write_spice = write_controlled_source};

extern constexpr DeviceKind expression_source_kind = {.letter = 'b',
                                                      .description = "voltage or current source with an expression",
                                                      .read = read_expression_source,
                                                      .make = make_expression_source,
                                                      .other_names = expression_source_names,
                                                      .expression_names = v_and_i,
                                                      .has_branch_current = gives_voltage,
                                                      .conducting_nodes = nodes_of_expression_source,
                                                      .multiply = multiply_expression_source,
                                                      .area = no_area,
                                                      .write_spice = write_expression_source};

}  // namespace corpuscle::circuit
