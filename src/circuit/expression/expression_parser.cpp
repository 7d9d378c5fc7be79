// Parses the text of an expression into steps in one pass. User functions are expanded where they are called.

#include "circuit/error_at.hpp"
#include "circuit/expression/expression.hpp"
#include "circuit/expression/expression_operations.hpp"
#include "circuit/expression/spice_number.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr int max_expression_depth = 200;    // of nested parentheses, functions and ? :
constexpr std::ptrdiff_t max_inputs = 4096;  // of one expression
constexpr std::size_t max_steps = 1000000;   // of one expression, after the expansion of functions

constexpr std::string_view complex_parts[] = {"m", "db", "p", "r", "i"};

/// "4.7k" for "4k7", as the values of parts are printed; "" for any other text.
std::string with_decimal_point(std::string_view text) {
    constexpr std::string_view digits = "0123456789";
    const auto before = std::min(text.find_first_not_of(digits), text.size());
    const auto after = std::min(text.find_first_of(digits, before), text.size());
    const auto scale = lower(text.substr(before, after - before)), fraction = lower(text.substr(after));
    const bool is_scale = scale == "meg" || (scale.size() == 1 && std::string_view("rtgkmunpf").find(scale[0]) != std::string_view::npos);
    if (before == 0 || fraction.empty() || !is_scale || fraction.find_first_not_of(digits) != std::string::npos) return "";
    return fmt::format("{}.{}{}", text.substr(0, before), fraction, scale == "r" ? "" : scale);
}

bool starts_name(char c) { return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_'; }
bool in_name(char c) { return starts_name(c) || (c >= '0' && c <= '9') || c == '.' || c == '#' || c == '@'; }

}  // namespace

/// Each function of the grammar parses a part of the text and returns the index of the step that gives its value, or no_index after an
/// error.
class FormulaReader {
    using Index = std::int32_t;
    static constexpr Index no_index = -1;
    using Arguments = std::vector<std::pair<std::string, Index>>;  // name and step of each argument

    const ExpressionScope& scope_;
    const SourceLocation& location_;  // of the expression's text
    Expression out_;
    std::string_view text_;                 // the expression, or the text of the function being expanded
    std::size_t at_ = 0;                    // offset in text_ of the character to read next
    const Arguments* arguments_ = nullptr;  // of the function being expanded; null outside functions
    std::vector<std::string> calls_;        // functions being expanded, outermost first
    std::size_t call_at_ = 0;               // offset of the outermost call in the expression, where errors inside it are located
    int depth_ = 0;
    std::size_t step_count_ = 0;  // operands and prefix operators read so far
    std::optional<Error> error_;  // the first error

public:
    FormulaReader(std::string_view text, const SourceLocation& location, const ExpressionScope& scope)
        : scope_(scope), location_(location), text_(text) {}

    Result<Expression> read() {
        Index last = choice();
        if (last != no_index) last = expect_end(last);
        if (last == no_index) return *error_;
        remove_unused(last);
        return std::move(out_);
    }

private:
    // ---- errors ----

    /// `at`: offset in text_
    template <class... Arguments>
    Index fail(std::size_t at, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
        if (error_) return no_index;
        auto message = fmt::format(text, std::forward<Arguments>(arguments)...);
        if (!calls_.empty()) message = fmt::format("in {}(): {}", calls_.back(), message);
        SourceLocation location = location_;
        location.column = std::max(1L, location.column) + static_cast<long>(calls_.empty() ? at : call_at_);
        error_ = bad_input(std::move(message), std::move(location));
        return no_index;
    }

    std::string text_here() const {
        return at_ >= text_.size() ? "the end" : fmt::format("'{}'", text_.substr(at_, std::min<std::size_t>(12, text_.size() - at_)));
    }
    Index expect_end(Index last) {
        skip_blanks();
        if (at_ == text_.size()) return last;
        const auto is_digit_at = [&](std::size_t k) { return k < text_.size() && text_[k] >= '0' && text_[k] <= '9'; };
        if (text_[at_] == ',' && at_ > 0 && is_digit_at(at_ - 1) && is_digit_at(at_ + 1))
            return fail(at_, "',' is not a decimal point; write a dot");
        if (text_[at_] == '=') return fail(at_, "'=' is an assignment; compare two values with '=='");
        return fail(at_, "expected an operator such as + or the end of the expression, not {}", text_here());
    }

    // ---- steps ----

    Index push(Expression::Step step) {
        out_.steps_.push_back(step);
        return static_cast<Index>(out_.steps_.size() - 1);
    }
    Index number(double value) { return push({.number = value}); }
    bool is_number(Index k) const { return step(k).is_number(); }
    const Expression::Step& step(Index k) const { return out_.steps_[static_cast<std::size_t>(k)]; }

    /// Adds a step. If all operands are numbers, the step is the number that results.
    Index apply(const Operation& operation, const std::vector<Index>& operands) {
        if (std::find(operands.begin(), operands.end(), no_index) != operands.end()) return no_index;
        const auto operand = [&](std::size_t k) { return k < operands.size() ? operands[k] : operands[0]; };
        const Index a = operand(0), b = operand(1), c = operand(2);
        if (is_number(a) && is_number(b) && is_number(c)) return number(operation.value({step(a).number, step(b).number, step(c).number}));
        return push({.operation = &operation, .a = a, .b = b, .c = c});
    }
    Index apply(std::string_view name, const std::vector<Index>& operands) {
        return apply(*find_operation(name, static_cast<int>(operands.size())), operands);
    }

    Index input(ExpressionInput::Kind kind, std::string name = "", std::string minus = "", std::string_view part = "") {
        return input(ExpressionInput{kind, std::move(name), std::move(minus), part});
    }
    Index input(ExpressionInput new_input) {
        const auto found = std::find(out_.inputs_.begin(), out_.inputs_.end(), new_input);
        const auto k = found - out_.inputs_.begin();
        if (k >= max_inputs) return fail(at_, "the expression uses more than {} voltages and currents", max_inputs);
        if (found == out_.inputs_.end()) out_.inputs_.push_back(std::move(new_input));
        return push({.input = static_cast<Index>(k)});
    }

    /// Removes the steps and inputs that do not contribute to the value.
    void remove_unused(Index last) {
        auto& steps = out_.steps_;
        std::vector<Index> new_index(steps.size(), no_index), new_input_index(out_.inputs_.size(), no_index);
        const auto mark_used = [&](Index k) { new_index[static_cast<std::size_t>(k)] = 0; };
        mark_used(last);
        for (std::size_t k = static_cast<std::size_t>(last) + 1; k-- > 0;) {
            if (new_index[k] == no_index) continue;
            if (steps[k].input >= 0) new_input_index[static_cast<std::size_t>(steps[k].input)] = 0;
            if (steps[k].operation) mark_used(steps[k].a), mark_used(steps[k].b), mark_used(steps[k].c);
        }
        renumber_inputs(new_input_index);
        std::size_t kept = 0;
        for (std::size_t k = 0; k <= static_cast<std::size_t>(last); ++k) {
            if (new_index[k] == no_index) continue;
            Expression::Step s = steps[k];
            if (s.input >= 0) s.input = new_input_index[static_cast<std::size_t>(s.input)];
            if (s.operation)
                for (Index* operand : {&s.a, &s.b, &s.c}) *operand = new_index[static_cast<std::size_t>(*operand)];
            new_index[k] = static_cast<Index>(kept);
            steps[kept++] = s;
        }
        steps.resize(kept);
        steps.shrink_to_fit();
    }
    void renumber_inputs(std::vector<Index>& new_index) {
        std::vector<ExpressionInput> kept;
        for (std::size_t k = 0; k < new_index.size(); ++k)
            if (new_index[k] != no_index) {
                new_index[k] = static_cast<Index>(kept.size());
                kept.push_back(std::move(out_.inputs_[k]));
            }
        out_.inputs_ = std::move(kept);
    }

    // ---- text ----

    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }
    bool take(char c) {
        skip_blanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    std::string_view name_here() {
        const auto from = at_;
        while (at_ < text_.size() && in_name(text_[at_])) ++at_;
        return text_.substr(from, at_ - from);
    }
    /// Takes a binary operator of this level or a higher one; null if there is none here.
    const Operation* take_operator(int level) {
        skip_blanks();
        const auto [operation, length] = leading_operator(text_.substr(at_));
        if (!operation || operation->level < level) return nullptr;
        at_ += length;
        return operation;
    }

    // ---- grammar, from low to high precedence ----

    Index nested(Index (FormulaReader::*read)()) {
        if (depth_ >= max_expression_depth) return fail(at_, "the expression is nested deeper than the limit of {}", max_expression_depth);
        ++depth_;
        const Index k = (this->*read)();
        --depth_;
        return k;
    }

    /// c ? a : b
    Index choice() {
        const Index condition = chain(1);
        if (condition == no_index || !take('?')) return condition;
        const Index yes = nested(&FormulaReader::choice);
        if (yes == no_index) return no_index;
        if (!take(':')) return fail(at_, "expected ':', as in c ? a : b, not {}", text_here());
        const Index no = nested(&FormulaReader::choice);
        return no == no_index ? no_index : apply("?:", {condition, yes, no});
    }

    /// Binary operators of this level and higher ones, from left to right. power() has read those of power_level.
    Index chain(int level) {
        Index left = signed_value(&FormulaReader::power);
        while (left != no_index) {
            const auto* found = take_operator(level);
            if (!found) break;
            left = apply(*found, {left, chain(found->level + 1)});
        }
        return left;
    }

    /// x^y^z, where y and z may have signs; -x^2 is -(x^2).
    Index power() {
        Index left = operand();
        while (left != no_index) {
            const auto* found = take_operator(power_level);
            if (!found) break;
            left = apply(*found, {left, signed_value(&FormulaReader::operand)});
        }
        return left;
    }
    /// A value that `read` parses, with any prefix operators - + ! before it. The operator next to the value applies first.
    Index signed_value(Index (FormulaReader::*read)()) {
        const auto from = (skip_blanks(), at_);
        while (at_ < text_.size() && std::string_view("-+! \t").find(text_[at_]) != std::string_view::npos) ++at_;
        auto prefix = text_.substr(from, at_ - from);
        Index k = (this->*read)();
        for (; !prefix.empty() && k != no_index; prefix.remove_suffix(1)) {
            if (prefix.back() == '-' || prefix.back() == '!') k = apply(prefix.substr(prefix.size() - 1), {k});
            if (!count_step()) return no_index;
        }
        return k;
    }

    bool count_step() {
        if (++step_count_ <= max_steps) return true;
        fail(at_, "the expression has more than {} steps", max_steps);
        return false;
    }

    Index operand() {
        if (!count_step()) return no_index;
        skip_blanks();
        const char c = at_ < text_.size() ? text_[at_] : '\0';
        if (c == '(' || c == '{') return group(c == '(' ? ')' : '}');
        if (starts_name(c)) return named();
        if ((c >= '0' && c <= '9') || c == '.') return literal();
        return fail(at_, "expected a number, a name or '(', not {}", text_here());
    }

    Index group(char close) {
        const auto open = at_++;
        const Index k = nested(&FormulaReader::choice);
        if (k == no_index || take(close)) return k;
        if (at_ >= text_.size()) return fail(open, "this '{}' is not closed", text_[open]);
        return fail(at_, "expected '{}', not {}", close, text_here());
    }

    Index literal() {
        const auto from = at_;
        const auto read = parse_leading_number(text_.substr(at_));
        const auto end = at_ + (read ? read->length : 1);
        if (!read || (end < text_.size() && (in_name(text_[end])))) {
            name_here();
            const auto text = text_.substr(from, std::max<std::size_t>(1, at_ - from));
            const auto point = with_decimal_point(text);
            return fail(from, "'{}' is not a number{}", text, point.empty() ? "" : "; write " + point);
        }
        if (auto why = ambiguity(*read, text_.substr(from, end - from))) return fail(from, "{}", *why);
        at_ = end;
        return number(read->value);
    }

    // ---- names ----

    Index named() {
        const auto from = at_;
        const std::string name = lower(name_here());
        skip_blanks();
        if (at_ < text_.size() && text_[at_] == '(') return call(name, from);
        if (arguments_)
            for (const auto& [argument, k] : *arguments_)
                if (argument == name) return k;
        if (scope_.parameter)
            if (const auto value = scope_.parameter(name)) return number(*value);
        if (name == "time" || name == "temper") return time_or_temperature(name, from);
        const bool is_frequency = name == "hertz" || name == "freq" || name == "frequency";
        if (is_frequency && scope_.allows_parts) return input(ExpressionInput::Kind::frequency);
        if (name == "hertz") return fail(from, "an expression must not depend on the frequency (hertz)");
        for (const auto& constant : all_constants())
            if (constant.name == name) return number(constant.value);
        return fail(from, "unknown name '{}'{}", name, suggestion(name));
    }

    Index time_or_temperature(std::string_view name, std::size_t from) {
        if (!scope_.allows_inputs) return fail(from, "'{}' is not available in a parameter, only in an expression of the circuit", name);
        return input(name == "time" ? ExpressionInput::Kind::time : ExpressionInput::Kind::temperature);
    }

    std::string suggestion(std::string_view name) const {
        std::vector<std::string_view> names(scope_.suggestions.begin(), scope_.suggestions.end());
        if (arguments_)
            for (const auto& argument : *arguments_) names.push_back(argument.first);
        for (const auto& constant : all_constants())
            if (constant.name.size() > 1) names.push_back(constant.name);
        return did_you_mean(name, names);
    }
    Index call(const std::string& name, std::size_t from) {
        const auto* user_function = scope_.function ? scope_.function(name) : nullptr;
        if (scope_.allows_parts && !user_function && name == "im" && has_call_inside()) return part_of(*find_part_function(name), from);
        if (!user_function && (name == "v" || name == "i")) return voltage_or_current(name[0], "", from);
        if (const auto part = part_named(name); !user_function && !part.empty()) return voltage_or_current(name[0], part, from);
        if (!user_function && (name == "ddt" || name == "idt" || name == "sdt"))
            return fail(from, "{}() is not supported; for a charge, use a capacitor with q='...'", name);
        if (const auto* part = scope_.allows_parts && !user_function ? find_part_function(name) : nullptr) return part_of(*part, from);
        const auto* row = find_function(name, scope_.allows_inputs);
        const auto* random = find_random_function(name);
        const bool is_table = name == "table" || name == "pwl";
        if (!user_function && !row && !random && !is_table)
            return fail(from, "unknown function '{}'{}", name,
                        did_you_mean(name, all_operations() | std::views::transform(&Operation::name)));
        std::vector<Index> values;
        if (!read_arguments(values)) return no_index;
        if (user_function) return expand_function(name, *user_function, values, from);
        const int count = static_cast<int>(values.size());
        if (is_table) return table(name, values, from);
        if (random && count == random->arguments) return random_value(name, values);
        if (row && count == row->operands) return apply(*row, values);
        if (count > 0 && (name == "max" || name == "min")) {  // of any number of values, as in ngspice
            Index out = values[0];
            for (std::size_t k = 1; k < values.size(); ++k) out = apply(*row, {out, values[k]});
            return out;
        }
        const auto expected = row && random ? fmt::format("{} or {}", random->arguments, row->operands)
                                            : fmt::format("{}", row ? row->operands : random->arguments);
        return fail(from, "{}", argument_count_message(name, expected, values.size()));
    }

    /// table(x, x1,y1, x2,y2 ...): straight lines between points. Beyond the first and last point a table is constant, and pwl() continues
    /// its outer lines, as in ngspice.
    Index table(std::string_view name, const std::vector<Index>& values, std::size_t from) {
        if (values.size() < 5 || values.size() % 2 == 0)
            return fail(from, "{}() takes a value and at least two points: {}(x, x1,y1, x2,y2)", name, name);
        const auto constant = [&](std::size_t k) { return step(values[k]).number; };
        for (std::size_t k = 1; k < values.size(); ++k)
            if (!is_number(values[k])) return fail(from, "{}(): the points must be numbers", name);
        for (std::size_t k = 3; k < values.size(); k += 2)
            if (!(constant(k) > constant(k - 2)))
                return fail(from, "{}(): x = {:g} must be above {:g}", name, constant(k), constant(k - 2));
        const auto slope = [&](std::size_t k) { return (constant(k + 3) - constant(k + 1)) / (constant(k + 2) - constant(k)); };
        const Index x = values[0];
        Index out = values[2];
        const auto add = [&](const Index term) { out = apply("+", {out, term}); };
        for (std::size_t k = 1; k + 3 < values.size(); k += 2)
            add(apply("*", {number(slope(k)), apply("-", {apply("limit", {x, values[k], values[k + 2]}), values[k]})}));
        if (name == "table") return out;
        const auto last = values.size() - 2;
        add(apply("*", {number(-slope(1)), apply("uramp", {apply("-", {values[1], x})})}));
        add(apply("*", {number(slope(last - 2)), apply("uramp", {apply("-", {x, values[last]})})}));
        return out;
    }

    Index random_value(std::string_view name, const std::vector<Index>& values) {
        std::vector<double> arguments;
        for (const Index k : values)
            if (is_number(k)) arguments.push_back(step(k).number);
        return scope_.random && arguments.size() == values.size() ? number(scope_.random(name, arguments)) : values[0];
    }

    static std::string argument_count_message(std::string_view name, std::string_view expected, std::size_t count) {
        return fmt::format("{}() takes {} argument{}, not {}", name, expected, expected == "1" ? "" : "s", count);
    }

    bool read_arguments(std::vector<Index>& values) {
        const auto open = at_++;
        if (take(')')) return true;
        do {
            values.push_back(nested(&FormulaReader::choice));
            if (values.back() == no_index) return false;
        } while (take(','));
        if (take(')')) return true;
        if (at_ >= text_.size())
            fail(open, "this '(' is not closed");
        else
            fail(at_, "expected ',' or ')', not {}", text_here());
        return false;
    }

    /// Expands a user's function: parses its text with its argument names bound to the values.
    Index expand_function(const std::string& name, const ExpressionScope::Function& function, const std::vector<Index>& values,
                          std::size_t from) {
        const std::size_t expected = function.arguments.size();
        if (values.size() != expected) return fail(from, "{}", argument_count_message(name, fmt::format("{}", expected), values.size()));
        if (std::find(calls_.begin(), calls_.end(), name) != calls_.end()) return fail(from, "{}() calls itself", name);
        if (depth_ >= max_expression_depth) return fail(from, "the expression is nested deeper than the limit of {}", max_expression_depth);
        Arguments bound;
        for (std::size_t k = 0; k < values.size(); ++k) bound.emplace_back(function.arguments[k], values[k]);
        const auto text = std::exchange(text_, function.text);
        const auto at = std::exchange(at_, 0);
        const auto* arguments = std::exchange(arguments_, &bound);
        if (calls_.empty()) call_at_ = from;
        calls_.push_back(name);
        Index k = nested(&FormulaReader::choice);
        if (k != no_index) k = expect_end(k);
        calls_.pop_back();
        text_ = text, at_ = at, arguments_ = arguments;
        return k;
    }

    // ---- v(a), v(a,b), i(vx) ----

    /// The part of a complex value that a function such as vdb() or ip() selects; "" if it is none of these.
    std::string_view part_named(std::string_view function) const {
        if (!scope_.allows_parts || function.empty() || (function[0] != 'v' && function[0] != 'i')) return "";
        const auto* found = std::ranges::find(complex_parts, function.substr(1));
        return found == std::end(complex_parts) ? "" : *found;
    }

    /// True for im(v(a)), the imaginary part; false for im(v1), the magnitude of a current.
    bool has_call_inside() const {
        const auto next = text_.find_first_of("()", at_ + 1);
        return next != std::string_view::npos && text_[next] == '(';
    }
    /// Reads mag(...), db(...) and similar, of an expression that may be complex. In parentheses, parameters are known, but not the
    /// arguments of a function being expanded.
    Index part_of(const PartFunction& function, std::size_t from) {
        if (function.part.empty())
            return fail(from, "{}() is not available: the phase between two points is not continued; use ph()", function.name);
        std::size_t end = at_;
        for (int depth = 0; end < text_.size(); ++end) {
            depth += text_[end] == '(' ? 1 : text_[end] == ')' ? -1 : 0;
            if (depth == 0) break;
        }
        if (end == text_.size()) return fail(at_, "this '(' is not closed");
        const auto inside = text_.substr(at_ + 1, end - at_ - 1);
        if (depth_ >= max_expression_depth) return fail(from, "the expression is nested deeper than the limit of {}", max_expression_depth);
        FormulaReader reader(inside, location_, scope_);
        reader.depth_ = depth_ + 1;
        auto parsed = reader.read();
        if (!parsed) return fail(at_ + 1, "{}", parsed.error().message);
        if (!parsed->is_rational()) return fail(from, "{}(): only + - * / of curves and numbers are available in it", function.name);
        at_ = end + 1;
        const bool is_curve =
            parsed->steps_.size() == 1 && parsed->inputs_.size() == 1 && parsed->inputs_[0].part.empty() &&
            (parsed->inputs_[0].kind == ExpressionInput::Kind::voltage || parsed->inputs_[0].kind == ExpressionInput::Kind::current);
        if (is_curve) {
            auto& of = parsed->inputs_[0];
            return input(of.kind, std::move(of.name), std::move(of.minus), function.part);
        }
        ExpressionInput new_input{ExpressionInput::Kind::part, std::string(inside), "", function.part,
                                  std::make_shared<const Expression>(std::move(*parsed))};
        return input(std::move(new_input));
    }

    /// Reads the names in parentheses after v or i (`kind`), which is at offset `from`.
    Index voltage_or_current(char kind, std::string_view part, std::size_t from) {
        if (!scope_.allows_inputs) return fail(from, "{}(...) is not available in a parameter, only in an expression of the circuit", kind);
        const auto close = text_.find(')', at_);
        if (close == std::string_view::npos) return fail(at_, "this '(' is not closed");
        const auto inside = text_.substr(at_ + 1, close - at_ - 1);
        const auto comma = inside.find(',');
        const std::string first = lower(trimmed(inside.substr(0, comma)));
        const std::string second = comma == std::string_view::npos ? "" : lower(trimmed(inside.substr(comma + 1)));
        const bool is_difference = comma != std::string_view::npos;
        if (!is_one_name(first) || (is_difference && (kind == 'i' || !is_one_name(second))))
            return fail(from, "'{}' is not a {}", text_.substr(from, close + 1 - from),
                        kind == 'v' ? "voltage; write v(node) or v(node,node)" : "current; write i(element)");
        at_ = close + 1;
        if (kind == 'i') return input(ExpressionInput::Kind::current, scope_.element ? scope_.element(first) : first, "", part);
        if (!part.empty()) return input(ExpressionInput::Kind::voltage, node(first), is_difference ? node(second) : "", part);
        return voltage(node(first), is_difference ? node(second) : "");
    }
    static bool is_one_name(std::string_view name) { return !name.empty() && name.find_first_of(" \t({,") == std::string_view::npos; }

    /// The name in the circuit of a node that the expression calls `name`; "" is ground.
    std::string node(const std::string& name) const {
        std::string full = is_ground(name) ? "" : scope_.node ? scope_.node(name) : name;
        return full == "0" ? "" : full;
    }
    Index voltage(const std::string& plus, const std::string& minus) {
        if (plus == minus) return number(0);
        if (!plus.empty()) return input(ExpressionInput::Kind::voltage, plus, minus);
        return apply("-", {input(ExpressionInput::Kind::voltage, minus)});
    }
};

Result<Expression> Expression::parse(std::string_view text, const SourceLocation& location, const ExpressionScope& scope) {
    return FormulaReader(text, location, scope).read();
}

}  // namespace corpuscle::circuit
