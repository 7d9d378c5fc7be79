#include "circuit/measure/measurement_parser.hpp"

#include "circuit/expression/spice_number.hpp"
#include "circuit/measure/measure_line.hpp"
#include "circuit/measure/missing_curve.hpp"
#include "circuit/measure/xyce_measurements.hpp"

namespace corpuscle::circuit {
namespace {

double position_of_min(const CurveSummary& s) { return s.low_at; }
double position_of_max(const CurveSummary& s) { return s.high_at; }

struct SummaryWord {
    std::string_view word;
    SummaryMeasurement::Statistic statistic;
};
constexpr SummaryWord summaries[] = {
    {"min", [](const CurveSummary& s) { return s.low; }},
    {"max", [](const CurveSummary& s) { return s.high; }},
    {"pp", [](const CurveSummary& s) { return s.high - s.low; }},
    {"min_at", position_of_min},
    {"max_at", position_of_max},
    {"avg", [](const CurveSummary& s) { return s.length == 0 ? s.first_value : s.area / s.length; }},
    {"rms", [](const CurveSummary& s) { return s.length == 0 ? std::abs(s.first_value) : std::sqrt(s.squares / s.length); }},
    {"integ", [](const CurveSummary& s) { return s.integral; }},
};

struct CycleWord {
    std::string_view word;
    CycleMeasurement::Statistic statistic;
};
constexpr CycleWord cycle_words[] = {
    {"duty", [](const CycleSummary& s) { return s.on / s.length; }},
    {"freq", [](const CycleSummary& s) { return 0.5 * (s.times_above + s.times_below) / s.length; }},
    {"on_time", [](const CycleSummary& s) { return s.times_above > 0 ? s.above / s.times_above : not_found; }},
    {"off_time", [](const CycleSummary& s) { return s.times_below > 0 ? s.below / s.times_below : not_found; }},
};

struct EdgeWord {
    std::string_view word;
    bool rising, falling;
};
constexpr EdgeWord edge_words[] = {{"rise", true, false}, {"fall", false, true}, {"cross", true, true}};

/// The position of '=' in CURVE=VALUE. An '=' inside parentheses, braces or quotes, as in par('...'), does not count.
std::size_t equals_in(const std::string& word) {
    int depth = 0;
    bool is_quoted = false;
    for (std::size_t k = 0; k < word.size(); ++k) {
        const char c = word[k];
        depth += c == '(' || c == '{' ? 1 : c == ')' || c == '}' ? -1 : 0;
        if (c == '\'') is_quoted = !is_quoted;
        if (c == '=' && depth == 0 && !is_quoted) return k;
    }
    return std::string::npos;
}

/// The text of an expression of numbers without braces or quotes around it.
std::string_view expression_text(std::string_view text) { return curve_expression_text(text).value_or(text); }

/// Reads the words of a .meas line one after another.
class MeasurementParser {
    const Directive& directive_;
    const Plot& head_;  // names and types of the curves
    const MeasureScope& scope_;
    std::size_t at_ = 2;         // index of the next word; the first two are "tran NAME"
    bool is_left_out_ = false;   // the error is that of left_out()
    bool uses_results_ = false;  // a number depends on a result of the scope

public:
    MeasurementParser(const Directive& directive, const Plot& head, const MeasureScope& scope)
        : directive_(directive), head_(head), scope_(scope) {}

    Result<ParsedMeasurement> parse() {
        auto out = head_.has_sweep ? swept() : operating_point();
        if (out && !done()) out = has_foreign_qualifier() ? left_out("{} is not supported", peek()) : error_here("unexpected '{}'", peek());
        if (out) return ParsedMeasurement{std::move(*out), {}, uses_results_};
        if (is_left_out_) return ParsedMeasurement{nullptr, out.error()};
        return out.error();
    }

private:
    using ParseResult = Result<std::unique_ptr<Measurement>>;

    bool done() const { return at_ >= directive_.words.size(); }
    std::string peek() const { return done() ? "" : directive_.words[at_]; }
    std::string next() { return done() ? "" : directive_.words[at_++]; }
    /// An error with the location of the next word.
    template <class... Arguments>
    Error error_here(fmt::format_string<Arguments...> message, Arguments&&... arguments) const {
        return error_at(directive_.location_of(at_), ".meas: {}", fmt::format(message, std::forward<Arguments>(arguments)...));
    }
    /// The reason why the line is left out, with the location of the next word.
    template <class... Arguments>
    Error left_out(fmt::format_string<Arguments...> message, Arguments&&... arguments) {
        is_left_out_ = true;
        return error_at(directive_.location_of(at_), ".meas {} is left out: {}", directive_.words[1],
                        fmt::format(message, std::forward<Arguments>(arguments)...));
    }
    bool has_foreign_qualifier() const {
        const auto word = peek();
        return word.find('=') != std::string::npos && is_foreign_qualifier(word.substr(0, word.find('=')));
    }

    ParseResult swept() {
        const auto kind = peek();
        for (const auto& s : summaries)
            if (kind == s.word) return ++at_, summary(s.statistic);
        for (const auto& c : cycle_words)
            if (kind == c.word) return ++at_, cycles(c.statistic);
        if (kind == "err" || kind == "err1" || kind == "err2") return ++at_, difference(kind == "err2");
        if (kind.starts_with("param=")) return last_value();
        if (kind == "find" || kind == "deriv") return ++at_, find_or_deriv(kind == "deriv");
        if (kind == "trig") return ++at_, distance();
        if (kind == "when" || kind == "count") {
            ++at_;
            auto crossings = TRY(edge(kind == "count"));
            return ParseResult(std::make_unique<DistanceMeasurement>(std::nullopt, EventPoint{not_found, std::move(crossings)}));
        }
        if (is_foreign_measurement(kind)) return left_out("the measurement '{}' of another simulator is not supported", kind);
        return error_here("unknown measurement '{}'; expected one of {}", kind, known_measurements());
    }

    ParseResult operating_point() {
        if (peek().starts_with("param=")) return last_value();
        if (peek() != "find") return error_here("a measurement of .op must be find v(node), find v(a,b) or find i(source)");
        ++at_;
        const auto view = TRY(curve());
        const auto first = [](const CurveSummary& s) { return s.first_value; };
        return ParseResult(std::make_unique<SummaryMeasurement>(first, CurveFollower{view}, Interval()));
    }

    /// The value of a parameter or of an earlier measurement.
    std::optional<double> value_of_name(std::string_view name) {
        for (const auto& [known, value] : scope_.results)
            if (known == name) return uses_results_ = true, value;
        if (scope_.circuit == nullptr) return {};
        const auto found = scope_.circuit->parameters.find(name);
        return found == scope_.circuit->parameters.end() ? std::nullopt : std::optional(found->second);
    }

    /// The curve of this name.
    Result<CurveView> curve(std::string_view name) {
        if (const auto text = curve_expression_text(name)) return expression(name, *text);
        if (const auto view = CurveView::find(head_, name)) return *view;
        if (std::ranges::find(scope_.results, name, &std::pair<std::string, double>::first) != scope_.results.end())
            return left_out("'{}' is a measure, which has no curve", name);
        if (parse_number(name)) return expression(name, name);  // {x} of a parameter x
        return no_curve(name);
    }
    Result<CurveView> expression(std::string_view name, std::string_view text) {
        auto names = curve_scope();
        names.parameter = [this](std::string_view n) { return value_of_name(n); };
        auto parsed = Expression::parse(text, directive_.location_of(at_), names);
        if (parsed)
            if (auto view = CurveView::of_expression(head_, std::move(*parsed))) return *view;
        const auto quantity = scope_.circuit ? unavailable_quantity(*scope_.circuit, head_, name) : std::nullopt;
        const bool is_only_complex = quantity && CurveView::find(head_, *quantity);
        if (quantity && !(is_only_complex && !parsed)) return no_curve(name);
        if (!parsed) return error_here("{}", parsed.error().message);
        return no_curve(name);
    }
    Error no_curve(std::string_view name) {
        const auto quantity = scope_.circuit ? unavailable_quantity(*scope_.circuit, head_, name) : std::nullopt;
        if (!quantity) return error_here("there is no curve '{}' in '{}'", name, head_.name);
        const bool is_complex = head_.is_complex && CurveView::find(head_, *quantity);
        return left_out("{} is not available {}", *quantity,
                        is_complex ? std::string("in an expression, because it is complex; use its vm, vdb, vp, vr or vi")
                                   : fmt::format("in .{}", directive_.words[0]));
    }

    /// Reads the next word as a curve.
    Result<CurveView> curve() {
        auto out = curve(peek());
        if (out) ++at_;
        return out;
    }

    /// The value of a number, or of an expression of parameters and earlier measurements; nothing if the text is neither.
    Result<std::optional<double>> number(std::string_view text) {
        if (const auto plain = parse_number(text)) {
            if (const auto why = ambiguity(*plain, text)) return error_here("{}", *why);
            return std::optional<double>(plain->value);
        }
        ExpressionScope names;
        names.parameter = [this](std::string_view n) { return value_of_name(n); };
        const auto parsed = Expression::parse(expression_text(text), {}, names);
        return parsed ? std::optional<double>(parsed->value()) : std::nullopt;
    }

    /// Reads the number if the next word is "name=NUMBER"; otherwise returns nothing and reads no word.
    Result<std::optional<double>> option(std::string_view name) {
        const auto word = peek();
        if (!word.starts_with(name) || word.size() <= name.size() || word[name.size()] != '=') return std::optional<double>();
        const auto value = TRY(number(std::string_view(word).substr(name.size() + 1)));
        if (!value) return error_here("'{}': expected a number after '{}='", word, name);
        ++at_;
        return value;
    }

    /// Reads a number of this name, which has no effect here. Returns true if it was next.
    Result<bool> ignored(std::string_view name) {
        const auto number = TRY(option(name));
        return number.has_value();
    }

    /// Reads from= and to=, if they are next. Returns true if there was at least one of them.
    Result<bool> bounds(Interval& interval) {
        const auto from = TRY(option("from"));
        if (from) interval.from = *from;
        const auto to = TRY(option("to"));
        if (to) interval.to = *to;
        return from || to;
    }
    /// Reads from=, to= and td= in any order, and the options that `read` reads. It returns true if it read one.
    template <class Read>
    Result<Interval> interval_and(Read&& read) {
        Interval out;
        for (bool more = true; more;) {
            const auto bounded = TRY(bounds(out));
            const auto delay = TRY(option("td"));
            if (delay) out.from = std::max(out.from, *delay);
            const auto other = TRY(read());
            more = bounded || delay || other;
        }
        if (directive_.words[0] == "dc" && out.from > out.to) std::swap(out.from, out.to);  // as in Xyce
        return out;
    }

    /// Reads rise=, fall= or cross=, if it is next. Returns true if there was one of them.
    Result<bool> numbered_edge(EdgeSelection& edges) {
        for (const auto& e : edge_words) {
            const bool last = peek() == fmt::format("{}=last", e.word);
            if (last) ++at_;
            const auto number = TRY(last ? Result<std::optional<double>>(-1.0) : option(e.word));
            if (!number) continue;
            if (!(*number != 0 && std::abs(*number) <= 1e6 && *number == std::floor(*number)))
                return --at_, error_here("'{}' must be 1, 2 ... or last", peek());
            edges.rising = e.rising, edges.falling = e.falling, edges.number = *number;
            return true;
        }
        return false;
    }

    /// Reads rise= fall= cross= td= from= to= in any order; val= as well if `level` is not null. For count, the words rise, fall and cross
    /// without a number select the kind of edges.
    Result<EdgeSelection> edges(bool is_count, std::optional<double>* level = nullptr) {
        EdgeSelection out;
        out.is_counted = is_count;
        for (bool more = true; more;) {
            more = false;
            for (const auto& e : edge_words)
                if (is_count && peek() == e.word) out.rising = e.rising, out.falling = e.falling, more = true, ++at_;
            const auto chosen = TRY(is_count ? Result<bool>(false) : numbered_edge(out));
            const auto bounded = TRY(bounds(out.interval));
            const auto delay = TRY(option("td"));
            if (delay) out.interval.from = *delay;
            const auto value = TRY(level ? option("val") : Result<std::optional<double>>(std::nullopt));
            if (value) *level = value;
            const auto minval = TRY(ignored("minval"));  // Xyce's tolerance; crossings are located exactly here
            more = more || chosen || bounded || delay || value || minval;
        }
        return out;
    }

    /// Reads CURVE=VALUE or CURVE=CURVE and the selection of edges.
    Result<CrossingCounter> edge(bool is_count = false) {
        const auto word = peek();
        const auto equals = equals_in(word);
        if (equals == std::string::npos) return error_here("'{}' must be CURVE=VALUE", word);
        const auto left = curve(std::string_view(word).substr(0, equals));
        if (!left) return left.error();
        const auto right = std::string_view(word).substr(equals + 1);
        CurveFollower follower{*left};
        if (const auto level = TRY(number(right)))
            follower.level = *level;
        else
            follower.other = TRY(curve(right));
        ++at_;
        const auto selection = TRY(edges(is_count));
        return CrossingCounter{std::move(follower), selection};
    }

    ParseResult summary(SummaryMeasurement::Statistic statistic) {
        const auto view = TRY(curve());
        const bool is_max = directive_.words[2] == "max", is_extreme = is_max || directive_.words[2] == "min";
        const auto interval = TRY(interval_and([&]() -> Result<bool> {
            if (!is_extreme || !peek().starts_with("output=")) return false;
            if (next() != "output=value") statistic = is_max ? position_of_max : position_of_min;  // Xyce: time, freq, sv
            return true;
        }));
        return ParseResult(std::make_unique<SummaryMeasurement>(statistic, CurveFollower{view}, interval));
    }

    /// param=EXPRESSION of curves: its value at the end, as in Xyce.
    ParseResult last_value() {
        const std::string text(expression_text(std::string_view(peek()).substr(6)));
        const auto view = TRY(expression("{" + text + "}", text));
        ++at_;
        const auto interval = TRY(interval_and([] { return Result<bool>(false); }));
        const auto last = [](const CurveSummary& s) { return s.last_value; };
        return ParseResult(std::make_unique<SummaryMeasurement>(last, CurveFollower{view}, interval));
    }

    ParseResult cycles(CycleMeasurement::Statistic statistic) {
        const auto view = TRY(curve());
        std::optional<double> on, off;
        const auto interval = TRY(interval_and([&]() -> Result<bool> {
            const auto above = TRY(option("on"));
            const auto below = TRY(option("off"));
            const auto minval = TRY(ignored("minval"));  // Xyce's tolerance; crossings are located exactly here
            if (above) on = above;
            if (below) off = below;
            return above || below || minval;
        }));
        const double level = on.value_or(off.value_or(0)), lower = off.value_or(level);
        if (lower > level) return error_here("off={:g} is above on={:g}", lower, level);
        return ParseResult(std::make_unique<CycleMeasurement>(statistic, CurveFollower{view}, interval, level, lower));
    }

    ParseResult difference(bool is_absolute) {
        const auto measured = TRY(curve());
        const auto calculated = TRY(curve());
        DifferenceMeasurement::Settings settings{.is_absolute = is_absolute};
        const auto interval = TRY(interval_and([&]() -> Result<bool> {
            bool any = false;
            for (const auto& [name, setting] :
                 {std::pair{"minval", &settings.minval}, std::pair{"ymin", &settings.ymin}, std::pair{"ignore", &settings.ymin},
                  std::pair{"ignor", &settings.ymin}, std::pair{"ymax", &settings.ymax}}) {
                const auto given = TRY(option(name));
                if (given) *setting = *given, any = true;
            }
            return any;
        }));
        return ParseResult(std::make_unique<DifferenceMeasurement>(measured, calculated, interval, settings));
    }

    ParseResult find_or_deriv(bool is_slope) {
        const auto view = TRY(curve());
        const auto at = TRY(option("at"));
        if (at) {
            const auto interval = TRY(interval_and([this] { return ignored("minval"); }));
            return ParseResult(std::make_unique<ValueMeasurement>(CurveFollower{view}, is_slope, EventPoint{*at, {}}, interval));
        }
        if (peek() != "when") return error_here("'{}': expected at=VALUE or when CURVE=VALUE", peek());
        ++at_;
        auto crossings = TRY(edge());
        return ParseResult(std::make_unique<ValueMeasurement>(CurveFollower{view}, is_slope, EventPoint{not_found, std::move(crossings)}));
    }

    ParseResult distance() {
        auto trigger = TRY(position());
        if (peek() != "targ") return error_here("expected targ after trig");
        ++at_;
        auto target = TRY(position());
        return ParseResult(std::make_unique<DistanceMeasurement>(std::move(trigger), std::move(target)));
    }

    /// Reads the position after trig or targ: at=X, CURVE val=LEVEL with a selection of edges, or CURVE=VALUE as after when.
    Result<EventPoint> position() {
        const auto at = TRY(option("at"));
        if (at) {
            TRY(ignored("td"));  // as in Xyce
            return EventPoint{*at, {}};
        }
        const auto name = peek();
        if (equals_in(name) != std::string::npos) {
            auto crossings = TRY(edge());
            return EventPoint{not_found, std::move(crossings)};
        }
        const auto view = TRY(curve());
        std::optional<double> level;
        if (peek().find('=') == std::string::npos && parse_number(peek())) level = parse_number(next())->value;
        const auto selection = TRY(edges(false, &level));
        if (!level && has_foreign_qualifier()) return left_out("{} is not supported", peek());
        if (!level) return error_here("expected val= after '{}'", name);
        return EventPoint{not_found, CrossingCounter{CurveFollower{view, *level}, selection}};
    }
};

/// The expression of a param= line. Names are looked up by `value_of_name`; curves are allowed if `allows_curves` is true.
template <class ValueOfName>
Result<Expression> parse_equation(const Directive& c, bool allows_curves, ValueOfName value_of_name,
                                  std::vector<std::string> suggestions = {}) {
    auto scope = allows_curves ? curve_scope() : ExpressionScope();
    scope.parameter = value_of_name;
    scope.suggestions = std::move(suggestions);
    return Expression::parse(expression_text(std::string_view(c.words[2]).substr(6)), c.location_of(2), scope);
}

}  // namespace

Result<ParsedMeasurement> parse_measurement(const Directive& c, const Plot& head, const MeasureScope& scope) {
    return MeasurementParser(c, head, scope).parse();
}

bool is_expression_of_results(const Directive& c) {
    if (!c.words[2].starts_with("param=")) return false;
    const auto parsed = parse_equation(c, true, [](std::string_view name) {
        constexpr std::string_view swept[] = {"time", "freq", "frequency", "hertz"};
        return std::ranges::find(swept, name) == std::end(swept) ? std::optional(1.0) : std::nullopt;
    });
    if (parsed) return parsed->is_constant();
    return c.words[2].find('(') == std::string::npos;  // a function such as id(m1) is unknown; the parser reports it
}

Result<double> evaluate_expression_of_results(const Directive& c, const Circuit& circuit,
                                              const std::vector<std::pair<std::string, double>>& numbers) {
    std::vector<std::string> suggestions;
    for (const auto& [known, value] : numbers) suggestions.push_back(known);
    const auto value_of = [&](std::string_view name) -> std::optional<double> {
        for (const auto& [known, value] : numbers)
            if (known == name) return value;
        const auto found = circuit.parameters.find(name);
        return found == circuit.parameters.end() ? std::nullopt : std::optional(found->second);
    };
    const auto expression = TRY(parse_equation(c, false, value_of, std::move(suggestions)));
    return expression.value();
}

}  // namespace corpuscle::circuit
