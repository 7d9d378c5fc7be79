// Reading a formula: the text, once through, becomes steps. User functions are put in place where they are called.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/netlist/formula.hpp"
#include "circuit/netlist/formula_steps.hpp"
#include "circuit/netlist/number.hpp"
#include "signal/field.hpp"
#include "signal/text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr int deepest_formula = 200;  // of parentheses, functions and ? : within each other
constexpr std::ptrdiff_t most_inputs = 4096;
constexpr std::size_t most_steps = 1000000;  // of one formula, all functions put in place

bool starts_name(char c) { return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_'; }
bool in_name(char c) { return starts_name(c) || (c >= '0' && c <= '9') || c == '.' || c == '#' || c == '@'; }

/// An operation between two values, by what it looks like; the longer ones first. Those of a higher level bind first.
struct Sign {
    std::string_view text;
    Operation operation;
    int level;
};
constexpr Sign signs[] = {
    {"||", Operation::either, 1},
    {"&&", Operation::both, 2},
    {"==", Operation::equal, 3},
    {"!=", Operation::unequal, 3},
    {"<>", Operation::unequal, 3},
    {"<=", Operation::at_most, 4},
    {">=", Operation::at_least, 4},
    {"<", Operation::less, 4},
    {">", Operation::greater, 4},
    {"|", Operation::either, 1},
    {"&", Operation::both, 2},
    {"+", Operation::add, 5},
    {"-", Operation::subtract, 5},
    {"**", Operation::magnitude_power, 7},
    {"*", Operation::multiply, 6},
    {"/", Operation::divide, 6},
    {"^", Operation::magnitude_power, 7},
};
constexpr int power_level = 7;

}  // namespace

class FormulaReader {
    using Index = std::int32_t;
    static constexpr Index failed = -1;
    using Arguments = std::vector<std::pair<std::string, Index>>;

    const FormulaScope& scope_;
    const Place& place_;
    Formula out_;
    std::string_view text_;
    std::size_t at_ = 0;
    const Arguments* arguments_ = nullptr;  // what the names of the function being put in place stand for
    std::vector<std::string> calls_;        // functions being put in place, outermost first
    std::size_t call_at_ = 0;               // where the outermost was called
    int depth_ = 0;
    std::size_t read_ = 0;
    std::optional<Error> wrong_;

public:
    FormulaReader(std::string_view text, const Place& place, const FormulaScope& scope) : scope_(scope), place_(place), text_(text) {}

    Result<Formula> read() {
        Index last = choice();
        if (last != failed) last = nothing_more(last);
        if (last == failed) return *wrong_;
        keep_what_is_used(last);
        return std::move(out_);
    }

private:
    // ---- errors ----

    Index wrong(std::string sentence, std::size_t at) {
        if (wrong_) return failed;
        if (!calls_.empty()) sentence = fmt::format("in {}(): {}", calls_.back(), sentence);
        Place place = place_;
        place.column = std::max(1L, place.column) + static_cast<long>(calls_.empty() ? at : call_at_);
        wrong_ = bad_input(std::move(sentence), std::move(place));
        return failed;
    }
    Index wrong(std::string sentence) { return wrong(std::move(sentence), at_); }

    std::string what_stands_here() const {
        return at_ >= text_.size() ? "the formula ends"
                                   : fmt::format("'{}'", text_.substr(at_, std::min<std::size_t>(12, text_.size() - at_)));
    }
    Index nothing_more(Index last) {
        skip_blanks();
        if (at_ == text_.size()) return last;
        if (text_[at_] == '=') return wrong("'=' gives a value; two values are compared by '=='");
        return wrong(fmt::format("{} where an operation such as + or the end of the formula was expected", what_stands_here()));
    }

    // ---- steps ----

    Index push(Formula::Step step) {
        out_.steps_.push_back(step);
        return static_cast<Index>(out_.steps_.size() - 1);
    }
    Index number(double value) { return push({static_cast<std::int16_t>(Operation::number), 0, 0, 0, value}); }
    bool is_number(Index k) const { return step(k).what == static_cast<std::int16_t>(Operation::number); }
    const Formula::Step& step(Index k) const { return out_.steps_[static_cast<std::size_t>(k)]; }

    /// A step on others; at once a number where they all are.
    Index apply(Operation what, Index a, Index b, Index c) {
        if (a == failed || b == failed || c == failed) return failed;
        const int n = operands(what);
        if (is_number(a) && (n < 2 || is_number(b)) && (n < 3 || is_number(c)))
            return number(value_of(what, step(a).number, step(b).number, step(c).number));
        return push({static_cast<std::int16_t>(what), a, n < 2 ? a : b, n < 3 ? a : c, 0});
    }
    Index apply(Operation what, Index a, Index b) { return apply(what, a, b, a); }
    Index apply(Operation what, Index a) { return apply(what, a, a, a); }

    Index input(FormulaInput::Kind kind, std::string name = "", std::string minus = "") {
        FormulaInput wanted{kind, std::move(name), std::move(minus)};
        const auto found = std::find(out_.inputs_.begin(), out_.inputs_.end(), wanted);
        const auto k = found - out_.inputs_.begin();
        if (k >= most_inputs) return wrong(fmt::format("the formula names more than {} voltages and currents", most_inputs));
        if (found == out_.inputs_.end()) out_.inputs_.push_back(std::move(wanted));
        return push({static_cast<std::int16_t>(Operation::input), static_cast<Index>(k), 0, 0, 0});
    }

    /// Drops steps and inputs that the value does not need.
    void keep_what_is_used(Index last) {
        auto& steps = out_.steps_;
        std::vector<Index> place(steps.size(), failed), input_place(out_.inputs_.size(), failed);
        const auto need = [&](Index k) { place[static_cast<std::size_t>(k)] = 0; };
        need(last);
        for (std::size_t k = static_cast<std::size_t>(last) + 1; k-- > 0;) {
            if (place[k] == failed) continue;
            const auto what = static_cast<Operation>(steps[k].what);
            if (what == Operation::input) input_place[static_cast<std::size_t>(steps[k].a)] = 0;
            if (operands(what) > 0) need(steps[k].a), need(steps[k].b), need(steps[k].c);
        }
        renumber_inputs(input_place);
        std::size_t kept = 0;
        for (std::size_t k = 0; k <= static_cast<std::size_t>(last); ++k) {
            if (place[k] == failed) continue;
            Formula::Step s = steps[k];
            if (static_cast<Operation>(s.what) == Operation::input)
                s.a = input_place[static_cast<std::size_t>(s.a)];
            else if (operands(static_cast<Operation>(s.what)) > 0)
                for (Index* operand : {&s.a, &s.b, &s.c}) *operand = place[static_cast<std::size_t>(*operand)];
            place[k] = static_cast<Index>(kept);
            steps[kept++] = s;
        }
        steps.resize(kept);
        steps.shrink_to_fit();
    }
    void renumber_inputs(std::vector<Index>& place) {
        std::vector<FormulaInput> kept;
        for (std::size_t k = 0; k < place.size(); ++k)
            if (place[k] != failed) {
                place[k] = static_cast<Index>(kept.size());
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
    const Sign* sign_here() {
        skip_blanks();
        const auto rest = text_.substr(at_);
        for (const Sign& s : signs)
            if (rest.starts_with(s.text)) return &s;
        return nullptr;
    }

    // ---- grammar, from the loosest to the tightest ----

    Index deeper(Index (FormulaReader::*read)()) {
        if (depth_ >= deepest_formula) return wrong(fmt::format("the formula is nested more than {} deep", deepest_formula));
        ++depth_;
        const Index k = (this->*read)();
        --depth_;
        return k;
    }

    /// c ? a : b
    Index choice() {
        const Index condition = chain(1);
        if (condition == failed || !take('?')) return condition;
        const Index yes = deeper(&FormulaReader::choice);
        if (yes == failed) return failed;
        if (!take(':')) return wrong(fmt::format("{} where ':' was expected, as in c ? a : b", what_stands_here()));
        const Index no = deeper(&FormulaReader::choice);
        return no == failed ? failed : apply(Operation::choose, condition, yes, no);
    }

    /// Operations of this level and tighter ones, from left to right.
    Index chain(int level) {
        Index left = signed_value(&FormulaReader::power);
        while (left != failed) {
            const Sign* sign = sign_here();
            if (!sign || sign->level < level) break;
            at_ += sign->text.size();
            const Index right = chain(sign->level + 1);
            left = right == failed ? failed : apply(sign->operation, left, right);
        }
        return left;
    }

    /// x^y^z, of which y and z may have signs; in -x^2 the sign is the power's.
    Index power() {
        Index left = operand();
        while (left != failed) {
            const Sign* sign = sign_here();
            if (!sign || sign->level != power_level) break;
            at_ += sign->text.size();
            const Index right = signed_value(&FormulaReader::operand);
            left = right == failed ? failed : apply(sign->operation, left, right);
        }
        return left;
    }
    /// - + ! before a value, the innermost first.
    Index signed_value(Index (FormulaReader::*read)()) {
        const auto from = (skip_blanks(), at_);
        while (at_ < text_.size() && std::string_view("-+! \t").find(text_[at_]) != std::string_view::npos) ++at_;
        auto before = text_.substr(from, at_ - from);
        Index k = (this->*read)();
        for (; !before.empty() && k != failed; before.remove_suffix(1)) {
            if (before.back() == '-') k = apply(Operation::negative, k);
            if (before.back() == '!') k = apply(Operation::bare_not, k);
            if (!spend()) return failed;
        }
        return k;
    }

    bool spend() {
        if (++read_ <= most_steps) return true;
        wrong(fmt::format("the formula has more than {} steps", most_steps));
        return false;
    }

    Index operand() {
        if (!spend()) return failed;
        skip_blanks();
        const char c = at_ < text_.size() ? text_[at_] : '\0';
        if (c == '(' || c == '{') return group(c == '(' ? ')' : '}');
        if (starts_name(c)) return named();
        if ((c >= '0' && c <= '9') || c == '.') return literal();
        return wrong(fmt::format("{} where a number, a name or '(' was expected", what_stands_here()));
    }

    Index group(char close) {
        const auto open = at_++;
        const Index k = deeper(&FormulaReader::choice);
        if (k == failed || take(close)) return k;
        if (at_ >= text_.size()) return wrong(fmt::format("this '{}' is not closed", text_[open]), open);
        return wrong(fmt::format("{} where '{}' was expected", what_stands_here(), close));
    }

    Index literal() {
        const auto from = at_;
        const auto read = leading_number(text_.substr(at_));
        const auto end = at_ + (read ? read->length : 1);
        if (!read || (end < text_.size() && (in_name(text_[end])))) {
            name_here();
            return wrong(fmt::format("'{}' is no number", text_.substr(from, std::max<std::size_t>(1, at_ - from))), from);
        }
        if (auto why = ambiguous(*read, text_.substr(from, end - from))) return wrong(std::move(*why), from);
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
        if (name == "time" || name == "temper") return course(name, from);
        if (name == "hertz") return wrong("a formula may not depend on the frequency (hertz)", from);
        if (const double* value = constant_value(name)) return number(*value);
        return wrong(fmt::format("unknown name '{}'{}", name, suggestion(name)), from);
    }

    Index course(std::string_view name, std::size_t from) {
        if (!scope_.inputs) return wrong(fmt::format("'{}' is known only while a circuit is solved, not in a parameter", name), from);
        return input(name == "time" ? FormulaInput::Kind::time : FormulaInput::Kind::temperature);
    }

    std::string suggestion(std::string_view name) const {
        std::vector<std::string_view> names(scope_.known.begin(), scope_.known.end());
        if (arguments_)
            for (const auto& argument : *arguments_) names.push_back(argument.first);
        for (std::size_t k = 0; !constant_name(k).empty(); ++k)
            if (constant_name(k).size() > 1) names.push_back(constant_name(k));
        return did_you_mean(name, names);
    }
    static std::string function_suggestion(std::string_view name) {
        std::vector<std::string_view> names;
        for (std::size_t k = 0; !function_name(k).empty(); ++k) names.push_back(function_name(k));
        return did_you_mean(name, names);
    }

    Index call(const std::string& name, std::size_t from) {
        const auto* own = scope_.function ? scope_.function(name) : nullptr;
        if (!own && (name == "v" || name == "i")) return probe(name[0], from);
        if (!own && (name == "ddt" || name == "idt" || name == "sdt"))
            return wrong(fmt::format("{}() is not worked out; a charge is said by a capacitor's q='...'", name), from);
        const auto* row = own ? nullptr : function_row(name, scope_.inputs);
        if (!own && !row) return wrong(fmt::format("unknown function '{}'{}", name, function_suggestion(name)), from);
        std::vector<Index> values;
        if (!read_arguments(values)) return failed;
        if (own) return put_in_place(name, *own, values, from);
        const int given = static_cast<int>(values.size());
        if (given < row->least || given > row->most) return wrong(arguments_sentence(*row, given), from);
        const bool nominal = row->operation == Operation::limit && given == 2;
        values.resize(3, values[0]);
        return apply(nominal ? Operation::nominal : row->operation, values[0], values[1], values[2]);
    }

    static std::string arguments_sentence(const FunctionRow& row, int given) {
        const auto wanted = row.least == row.most ? fmt::format("{}", row.most) : fmt::format("{} or {}", row.least, row.most);
        return fmt::format("{}() takes {} argument{}, not {}", row.name, wanted, row.most == 1 ? "" : "s", given);
    }

    bool read_arguments(std::vector<Index>& values) {
        const auto open = at_++;
        if (take(')')) return true;
        do {
            values.push_back(deeper(&FormulaReader::choice));
            if (values.back() == failed) return false;
        } while (take(','));
        if (take(')')) return true;
        if (at_ >= text_.size())
            wrong("this '(' is not closed", open);
        else
            wrong(fmt::format("{} where ',' or ')' was expected", what_stands_here()));
        return false;
    }

    /// A user's function: its text is read with its arguments' names standing for the values.
    Index put_in_place(const std::string& name, const FormulaScope::Function& own, const std::vector<Index>& values, std::size_t from) {
        if (values.size() != own.arguments.size())
            return wrong(fmt::format("{}() takes {} argument{}, not {}", name, own.arguments.size(), own.arguments.size() == 1 ? "" : "s",
                                     values.size()),
                         from);
        if (std::find(calls_.begin(), calls_.end(), name) != calls_.end()) return wrong(fmt::format("{}() calls itself", name), from);
        if (depth_ >= deepest_formula) return wrong(fmt::format("the formula is nested more than {} deep", deepest_formula), from);
        Arguments bound;
        for (std::size_t k = 0; k < values.size(); ++k) bound.emplace_back(own.arguments[k], values[k]);
        const auto text = std::exchange(text_, own.text);
        const auto at = std::exchange(at_, 0);
        const auto* arguments = std::exchange(arguments_, &bound);
        if (calls_.empty()) call_at_ = from;
        calls_.push_back(name);
        Index k = deeper(&FormulaReader::choice);
        if (k != failed) k = nothing_more(k);
        calls_.pop_back();
        text_ = text, at_ = at, arguments_ = arguments;
        return k;
    }

    // ---- v(a), v(a,b), i(vx) ----

    Index probe(char kind, std::size_t from) {
        if (!scope_.inputs) return wrong(fmt::format("{}(...) is known only while a circuit is solved, not in a parameter", kind), from);
        const auto close = text_.find(')', at_);
        if (close == std::string_view::npos) return wrong("this '(' is not closed");
        const auto inside = text_.substr(at_ + 1, close - at_ - 1);
        const auto comma = inside.find(',');
        const std::string first = lower(trimmed(inside.substr(0, comma)));
        const std::string second = comma == std::string_view::npos ? "" : lower(trimmed(inside.substr(comma + 1)));
        const bool two = comma != std::string_view::npos;
        if (!is_probe(first) || (two && (kind == 'i' || !is_probe(second))))
            return wrong(fmt::format("'{}' is no {}", text_.substr(from, close + 1 - from),
                                     kind == 'v' ? "voltage; write v(node) or v(node,node)" : "current; write i(element)"),
                         from);
        at_ = close + 1;
        if (kind == 'i') return input(FormulaInput::Kind::current, scope_.element ? scope_.element(first) : first);
        return voltage(node(first), two ? node(second) : "");
    }
    static bool is_probe(std::string_view name) { return !name.empty() && name.find_first_of(" \t({,") == std::string_view::npos; }

    /// A node's name in the circuit; "" is ground.
    std::string node(const std::string& name) const {
        std::string full = name == "0" || name == "gnd" ? "" : scope_.node ? scope_.node(name) : name;
        return full == "0" ? "" : full;
    }
    Index voltage(const std::string& plus, const std::string& minus) {
        if (plus == minus) return number(0);
        if (!plus.empty()) return input(FormulaInput::Kind::voltage, plus, minus);
        return apply(Operation::negative, input(FormulaInput::Kind::voltage, minus));
    }
};

Result<Formula> Formula::parse(std::string_view text, const Place& at, const FormulaScope& scope) {
    return FormulaReader(text, at, scope).read();
}

}  // namespace corpuscle::circuit
