#include "circuit/netlist/script/script_vectors.hpp"

#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/script/script_words.hpp"
#include "circuit/output/curve_view.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_expanded = 10000;  // characters of one expression

/// Functions of a complex vector, and the letters of the part of v() or i() that they take. The phase is in radians.
constexpr std::pair<std::string_view, std::string_view> part_functions[] = {
    {"mag", "m"}, {"magnitude", "m"}, {"db", "db"}, {"ph", "p"}, {"phase", "p"}, {"real", "r"}, {"re", "r"}, {"imag", "i"}, {"im", "i"}};
/// Names that are constants of expressions and often nodes, too.
constexpr std::string_view ambiguous_names[] = {"c", "e", "i", "yes", "no"};
constexpr std::string_view swept_names[] = {"time", "frequency", "pi"};
/// Words of a meas line that are not vectors.
constexpr std::string_view measure_words[] = {"trig", "targ", "val",   "rise",   "fall",   "cross", "td",     "at",    "from",
                                              "to",   "when", "find",  "last",   "deriv",  "param", "min",    "max",   "pp",
                                              "avg",  "rms",  "integ", "min_at", "max_at", "goal",  "minval", "weight"};

template <class Names>
bool is_among(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != std::end(names);
}

bool starts_vector_name(char c) { return (c >= 'a' && c <= 'z') || c == '_' || c == '@'; }
bool is_in_vector_name(char c) { return starts_vector_name(c) || (c >= '0' && c <= '9') || c == '.' || c == '#' || c == '$'; }

/// For each '(' of a text, the offset of the ')' that closes it; npos if none does.
std::vector<std::size_t> closing_parentheses(std::string_view text) {
    std::vector<std::size_t> out(text.size(), std::string_view::npos), open;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '(') open.push_back(k);
        if (text[k] != ')' || open.empty()) continue;
        out[open.back()] = k;
        open.pop_back();
    }
    return out;
}

/// True for the arguments of v() and i(): a name, or two with a comma.
bool is_curve_argument(std::string_view text) { return !text.empty() && text.find_first_of("()") == std::string_view::npos; }

/// "v(a)" and "i(v1)", without the part; true also for "v(a,b)".
bool is_whole_curve(std::string_view text) {
    return text.size() > 3 && (text[0] == 'v' || text[0] == 'i') && text[1] == '(' && text.back() == ')' &&
           is_curve_argument(text.substr(2, text.size() - 3));
}

/// The curve that a script calls `name`: v(a), a, or v1#branch.
std::string curve_called(std::string_view name) {
    if (name.empty() || !std::ranges::all_of(name, is_in_vector_name) || name.find('$') != std::string_view::npos) return std::string(name);
    return name.ends_with("#branch") ? fmt::format("i({})", name.substr(0, name.size() - 7)) : fmt::format("v({})", name);
}

/// Copies a text, and replaces the names in it. is_vector(name) is true for the names of vectors.
template <class IsVector>
class NameReplacer {
    std::string_view text_;
    std::size_t at_ = 0;
    ScriptVectors::Expanded out_;
    IsVector is_vector_;
    std::vector<std::size_t> closing_;
    std::size_t end_of_part_ = 0;  // curves before this offset are in the argument of a function such as db()

    /// The function of expressions in .ac that gives this part of a complex expression; "" if there is none. mag() and im() have other
    /// meanings in other analyses.
    static std::string_view part_of_expression(std::string_view function) {
        if (function == "db" || function == "ph" || function == "re") return function;
        return function == "phase" ? "ph" : function == "real" ? "re" : function == "imag" ? "im" : "";
    }

public:
    NameReplacer(std::string_view text, IsVector is) : text_(text), is_vector_(std::move(is)), closing_(closing_parentheses(text)) {}

    /// replace(name, out) appends the replacement of a name that is not followed by a parenthesis.
    template <class Replace>
    ScriptVectors::Expanded run(Replace&& replace) {
        while (at_ < text_.size() && out_.problem.empty()) {
            const char c = text_[at_];
            if (starts_vector_name(c))
                name(replace);
            else if ((c >= '0' && c <= '9') || c == '.')
                number();
            else if (c == '[')
                out_.problem = "elements of a vector are not available; measure with meas ... at=X";
            else
                out_.text += c, ++at_;
            if (out_.text.size() > max_expanded) out_.problem = fmt::format("it is longer than {} characters", max_expanded);
        }
        return std::move(out_);
    }

private:
    void number() {
        const auto read = parse_leading_number(text_.substr(at_));
        const auto length = read ? read->length : 1;
        out_.text += text_.substr(at_, length);
        at_ += length;
    }

    template <class Replace>
    void name(Replace&& replace) {
        const auto from = at_;
        while (at_ < text_.size() && is_in_vector_name(text_[at_])) ++at_;
        const auto word = text_.substr(from, at_ - from);
        const auto next = text_.find_first_not_of(" \t", at_);
        if (next == std::string_view::npos || text_[next] != '(') return replace(word, out_);
        const auto close = closing_[next];
        if (close == std::string_view::npos) return void(out_.problem = "a '(' is not closed");
        const auto argument = trimmed(text_.substr(next + 1, close - next - 1));
        const auto* part = std::ranges::find(part_functions, word, &std::pair<std::string_view, std::string_view>::first);
        const auto curve = part == std::end(part_functions) ? std::string() : whole_curve(argument);
        if (!curve.empty() && (word != "im" || curve == argument)) {  // im(v1) is the magnitude of a current
            out_.text += fmt::format("{}{}{}", curve[0], part->second, std::string_view(curve).substr(1));
        } else if (is_curve_function(word) && is_curve_argument(argument)) {
            out_.has_whole_curves |= word.size() == 1 && from >= end_of_part_;
            out_.text += text_.substr(from, close + 1 - from);
        } else if (const auto whole = part_of_expression(word); !whole.empty()) {
            out_.text += whole;  // its argument may be complex
            end_of_part_ = std::max(end_of_part_, close);
            return;
        } else {
            out_.text += word == "log" ? "log10" : word == "mag" ? "abs" : word;  // log has the base 10 in scripts
            return;
        }
        out_.depends_on_curves = true;
        at_ = close + 1;
    }

    /// The curve that the argument of a part function names; "" if it is a vector or an expression.
    std::string whole_curve(std::string_view argument) const {
        if (is_whole_curve(argument)) return std::string(argument);
        if (!is_curve_argument(argument) || is_vector_(argument)) return "";
        auto curve = curve_called(argument);
        return is_whole_curve(curve) ? curve : "";
    }
};

/// The reason why a power may differ: scripts give complex numbers or negative ones where ^ of an expression takes the magnitude.
bool has_ambiguous_power(std::string_view text) {
    for (auto at = text.find_first_of("^"); at != std::string_view::npos; at = text.find('^', at + 1)) {
        const auto exponent = parse_leading_number(trimmed(text.substr(at + 1)));
        if (!exponent || std::fmod(exponent->value, 2) != 0) return true;
    }
    return text.find("**") != std::string_view::npos;
}

}  // namespace

ScriptVectors::Expanded ScriptVectors::expand(std::string_view expression) {
    if (has_ambiguous_power(expression)) return {"", "'^' takes the magnitude of its base here; write pow(x,y)"};
    const auto is_vector = [this](std::string_view name) { return contains(name); };
    auto out = NameReplacer(expression, is_vector).run([&](std::string_view name, Expanded& to) {
        const auto known = vectors_.find(name);
        if (known != vectors_.end() && known->second.kind == Kind::unknown) {
            to.problem = fmt::format("'{}' is not available", name);
        } else if (known != vectors_.end()) {
            const bool is_measure = known->second.kind == Kind::number_of_measures;
            (is_measure ? to.depends_on_measures : to.depends_on_curves) |= is_measure || !number(name);
            to.has_whole_curves |= known->second.has_whole_curves;
            to.text += is_measure ? std::string(name) : fmt::format("({})", known->second.text);
        } else if (name.starts_with('@') || name.find('$') != std::string_view::npos) {
            to.problem = fmt::format("'{}' is not available", name);
        } else if (is_among(ambiguous_names, name)) {
            to.problem = fmt::format("'{0}' may be a constant or a node; write v({0}) for the node", name);
        } else if (is_among(swept_names, name)) {
            to.depends_on_curves |= name != "pi";
            to.text += name;
        } else {
            to.depends_on_curves = to.has_whole_curves = true;
            to.text += curve_called(name);
        }
    });
    expanded_characters_ += out.text.size();
    if (!out.problem.empty()) return out;
    auto scope = curve_scope();
    if (out.depends_on_measures)
        scope.parameter = [this](std::string_view name) { return is_measure(name) ? std::optional(1.0) : std::nullopt; };
    const auto parsed = Expression::parse(out.text, {}, scope);
    if (!parsed) out.problem = parsed.error().message;
    if (!parsed || out.depends_on_curves || out.depends_on_measures) return out;
    out.text = fmt::format("{:.17g}", parsed->value());
    if (!std::isfinite(parsed->value())) out.problem = fmt::format("its value is {}", out.text);
    return out;
}

ScriptVectors::Expanded ScriptVectors::expand_measure(std::string_view words) {
    bool has_whole_curves = false;
    auto out = NameReplacer(words, [this](std::string_view name) { return contains(name); }).run([&](std::string_view name, Expanded& to) {
        const auto known = vectors_.find(name);
        if (known == vectors_.end() || known->second.kind == Kind::number_of_measures || is_among(measure_words, name))
            to.text += name;
        else if (known->second.kind == Kind::unknown)
            to.problem = fmt::format("'{}' is not available", name);
        else
            has_whole_curves |= known->second.has_whole_curves,
                to.text += number(name) ? known->second.text : fmt::format("par('{}')", known->second.text);
    });
    expanded_characters_ += out.text.size();
    out.has_whole_curves = has_whole_curves;
    return out;
}

void ScriptVectors::define(std::string name, const Expanded& value) {
    vectors_.insert_or_assign(std::move(name), Vector{Kind::expression, value.text, value.has_whole_curves});
}

void ScriptVectors::leave_plot() {
    for (auto& [name, vector] : vectors_)
        if (vector.kind == Kind::expression && !parse_number(vector.text)) vector = {Kind::unknown, ""};
}

bool ScriptVectors::is_measure(std::string_view name) const {
    const auto at = vectors_.find(name);
    return at != vectors_.end() && at->second.kind == Kind::number_of_measures;
}

std::optional<std::string> ScriptVectors::number(std::string_view name) const {
    const auto at = vectors_.find(name);
    if (at == vectors_.end() || at->second.kind != Kind::expression || !parse_number(at->second.text)) return {};
    return at->second.text;
}

}  // namespace corpuscle::circuit
