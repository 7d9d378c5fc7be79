#include "circuit/measure/measurement.hpp"

#include "circuit/expression/spice_number.hpp"

namespace corpuscle::circuit {
namespace {

double integral_of(const CurveSummary& s) { return s.integral; }

struct SummaryWord {
    std::string_view word;
    SummaryMeasurement::Statistic statistic;
};
constexpr SummaryWord summaries[] = {
    {"min", [](const CurveSummary& s) { return s.low; }},
    {"max", [](const CurveSummary& s) { return s.high; }},
    {"pp", [](const CurveSummary& s) { return s.high - s.low; }},
    {"min_at", [](const CurveSummary& s) { return s.low_at; }},
    {"max_at", [](const CurveSummary& s) { return s.high_at; }},
    {"avg", [](const CurveSummary& s) { return s.length == 0 ? s.first_value : s.area / s.length; }},
    {"rms", [](const CurveSummary& s) { return s.length == 0 ? std::abs(s.first_value) : std::sqrt(s.squares / s.length); }},
    {"integ", integral_of},
    {"integral", integral_of},
};

struct EdgeWord {
    std::string_view word;
    bool rising, falling;
};
constexpr EdgeWord edge_words[] = {{"rise", true, false}, {"fall", false, true}, {"cross", true, true}};

/// The position of '=' in CURVE=VALUE. An '=' inside par('...') does not count.
std::size_t equals_in(const std::string& word) {
    const bool is_expression = word.starts_with("par('");
    return word.find('=', is_expression ? word.find('\'', 5) : 0);
}

/// Reads the words of a .meas line one after another.
class MeasurementParser {
    const Directive& directive_;
    const Plot& head_;    // names and types of the curves
    std::size_t at_ = 2;  // index of the next word; the first two are "tran NAME"

public:
    MeasurementParser(const Directive& directive, const Plot& head) : directive_(directive), head_(head) {}

    Result<std::unique_ptr<Measurement>> parse() {
        auto out = head_.has_sweep ? swept() : operating_point();
        if (out && !done()) return error_here("unexpected '{}'", peek());
        return out;
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

    ParseResult swept() {
        const auto kind = peek();
        for (const auto& s : summaries)
            if (kind == s.word) return ++at_, summary(s.statistic);
        if (kind == "find" || kind == "deriv") return ++at_, find_or_deriv(kind == "deriv");
        if (kind == "trig") return ++at_, distance();
        if (kind == "when" || kind == "count") {
            ++at_;
            auto crossings = TRY(edge(kind == "count"));
            return ParseResult(std::make_unique<DistanceMeasurement>(std::nullopt, EventPoint{not_found, std::move(crossings)}));
        }
        return error_here(
            "unknown measurement '{}'; expected one of find, when, deriv, min, max, pp, avg, rms, integ, min_at, max_at, trig, "
            "count, param=",
            kind);
    }

    ParseResult operating_point() {
        if (peek() != "find") return error_here("a measurement of .op must be find v(node), find v(a,b) or find i(source)");
        ++at_;
        const auto name = peek();
        const auto view = CurveView::find(head_, name);
        if (!view) return error_here("there is no curve {}", name);
        ++at_;
        const auto first = [](const CurveSummary& s) { return s.first_value; };
        return ParseResult(std::make_unique<SummaryMeasurement>(first, CurveFollower{*view}, Interval()));
    }

    /// The curve of this name.
    Result<CurveView> curve(std::string_view name) const {
        if (const auto view = CurveView::find(head_, name)) return *view;
        if (name.starts_with("par(") && head_.is_complex)
            return error_here("par() does not work on the complex curves of .ac; use param= instead");
        if (name.starts_with("par("))
            if (const auto expression = parse_par_expression(name, directive_.location); !expression)
                return error_here("{}", expression.error().message);
        return error_here("there is no curve '{}' in '{}'", name, head_.name);
    }

    /// Reads the next word as a curve.
    Result<CurveView> curve() {
        auto out = curve(peek());
        if (out) ++at_;
        return out;
    }

    /// Reads the number if the next word is "name=NUMBER"; otherwise returns nothing and reads no word.
    Result<std::optional<double>> option(std::string_view name) {
        const auto word = peek();
        if (!word.starts_with(name) || word.size() <= name.size() || word[name.size()] != '=') return std::optional<double>();
        const auto number = parse_number(std::string_view(word).substr(name.size() + 1));
        if (!number) return error_here("'{}': expected a number after '{}='", word, name);
        if (const auto why = ambiguity(*number, std::string_view(word).substr(name.size() + 1))) return error_here("{}", *why);
        ++at_;
        return std::optional<double>(number->value);
    }

    /// Reads from= and to=, if they are next. Returns true if there was at least one of them.
    Result<bool> bounds(Interval& interval) {
        const auto from = TRY(option("from"));
        if (from) interval.from = *from;
        const auto to = TRY(option("to"));
        if (to) interval.to = *to;
        return from || to;
    }

    /// Reads rise=, fall= or cross=, if it is next. Returns true if there was one of them.
    Result<bool> numbered_edge(EdgeSelection& edges) {
        for (const auto& e : edge_words) {
            const bool last = peek() == fmt::format("{}=last", e.word) || peek() == fmt::format("{}=-1", e.word);
            if (last) ++at_;
            const auto number = TRY(last ? Result<std::optional<double>>(0.0) : option(e.word));
            if (!number) continue;
            if (!last && !(*number >= 1 && *number == std::floor(*number)))
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
            more = more || chosen || bounded || delay || value;
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
        if (const auto level = parse_number(right))
            follower.level = level->value;
        else
            follower.other = TRY(curve(right));
        ++at_;
        const auto selection = TRY(edges(is_count));
        return CrossingCounter{std::move(follower), selection};
    }

    ParseResult summary(SummaryMeasurement::Statistic statistic) {
        const auto view = TRY(curve());
        Interval interval;
        for (bool more = true; more;) more = TRY(bounds(interval));
        return ParseResult(std::make_unique<SummaryMeasurement>(statistic, CurveFollower{view}, interval));
    }

    ParseResult find_or_deriv(bool is_slope) {
        const auto view = TRY(curve());
        const auto at = TRY(option("at"));
        if (at) return ParseResult(std::make_unique<ValueMeasurement>(CurveFollower{view}, is_slope, EventPoint{*at, {}}));
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
        if (at) return EventPoint{*at, {}};
        const auto name = peek();
        if (equals_in(name) != std::string::npos) {
            auto crossings = TRY(edge());
            return EventPoint{not_found, std::move(crossings)};
        }
        const auto view = TRY(curve());
        std::optional<double> level;
        const auto selection = TRY(edges(false, &level));
        if (!level) return error_here("expected val= after '{}'", name);
        return EventPoint{not_found, CrossingCounter{CurveFollower{view, *level}, selection}};
    }
};

}  // namespace

Result<std::unique_ptr<Measurement>> parse_measurement(const Directive& c, const Plot& head) { return MeasurementParser(c, head).parse(); }

}  // namespace corpuscle::circuit
