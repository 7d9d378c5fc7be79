#include "circuit/measure/words.hpp"

#include <fmt/format.h>

#include "circuit/netlist/number.hpp"

namespace corpuscle::circuit {
namespace {

struct SummaryWord {
    std::string_view word;
    Summary::Of of;
};
constexpr SummaryWord summaries[] = {{"min", Summary::Of::min},       {"max", Summary::Of::max},       {"pp", Summary::Of::pp},
                                     {"min_at", Summary::Of::min_at}, {"max_at", Summary::Of::max_at}, {"avg", Summary::Of::avg},
                                     {"rms", Summary::Of::rms},       {"integ", Summary::Of::integ},   {"integral", Summary::Of::integ}};

struct EdgeWord {
    std::string_view word;
    Edges::Kind kind;
};
constexpr EdgeWord edge_words[] = {{"rise", Edges::Kind::rise}, {"fall", Edges::Kind::fall}, {"cross", Edges::Kind::cross}};

/// Of CURVE=VALUE; not one inside par('...').
std::size_t equals_in(const std::string& word) {
    const bool formula = word.starts_with("par('");
    return word.find('=', formula ? word.find('\'', 5) : 0);
}

class Reader {
    const Command& command_;
    const Plot& head_;
    std::size_t at_ = 2;  // behind "tran NAME"

public:
    Reader(const Command& command, const Plot& head) : command_(command), head_(head) {}

    Result<std::unique_ptr<Gauge>> gauge() {
        auto out = head_.swept ? swept() : at_rest();
        if (out && !done()) return wrong(fmt::format("'{}' is not known here", look()));
        return out;
    }

private:
    using Made = Result<std::unique_ptr<Gauge>>;

    bool done() const { return at_ >= command_.words.size(); }
    std::string look() const { return done() ? "" : command_.words[at_]; }
    std::string next() { return done() ? "" : command_.words[at_++]; }
    Error wrong(std::string_view what) const {
        auto place = command_.place;
        if (at_ < command_.columns.size()) place.column = command_.columns[at_];
        return bad_input(fmt::format(".meas: {}", what), place);
    }

    Made swept() {
        const auto what = look();
        for (const auto& s : summaries)
            if (what == s.word) return ++at_, summary(s.of);
        if (what == "find" || what == "deriv") return ++at_, found(what == "deriv");
        if (what == "trig") return ++at_, between();
        if (what == "when" || what == "count") {
            ++at_;
            auto crossings = edge(what == "count");
            if (!crossings) return crossings.error();
            if (what == "count") return Made(std::make_unique<Count>(std::move(*crossings)));
            return Made(std::make_unique<Where>(Spot{nothing, std::move(*crossings)}));
        }
        return wrong(fmt::format(
            "'{}' is not known; there are find, when, deriv, min, max, pp, avg, rms, integ, min_at, max_at, trig, count, param=", what));
    }

    Made at_rest() {
        if (look() != "find") return wrong("of an operating point: find v(node), v(a,b) or i(source)");
        ++at_;
        const auto name = look();
        const auto view = CurveView::of(head_, name);
        if (!view) return wrong(fmt::format("there is no {}", name));
        ++at_;
        return Made(std::make_unique<AtRest>(*view));
    }

    Result<CurveView> curve(std::string_view name) const {
        if (const auto view = CurveView::of(head_, name)) return *view;
        if (name.starts_with("par(") && head_.is_complex) return wrong("par() is of real curves, not of .ac; say param=");
        if (name.starts_with("par("))
            if (const auto formula = par_formula(name, command_.place); !formula) return wrong(formula.error().sentence);
        return wrong(fmt::format("there is no curve '{}' in '{}'", name, head_.name));
    }

    /// The word here, as a curve.
    Result<CurveView> curve() {
        auto out = curve(look());
        if (out) ++at_;
        return out;
    }

    /// The number behind "name=", if the word here begins so.
    Result<std::optional<double>> option(std::string_view name) {
        const auto word = look();
        if (!word.starts_with(name) || word.size() <= name.size() || word[name.size()] != '=') return std::optional<double>();
        const auto number = whole_number(std::string_view(word).substr(name.size() + 1));
        if (!number) return wrong(fmt::format("'{}': a number was expected after '{}='", word, name));
        if (const auto why = ambiguous(*number, std::string_view(word).substr(name.size() + 1))) return wrong(*why);
        ++at_;
        return std::optional<double>(number->value);
    }

    /// from= and to=, if one of them is here.
    Result<bool> bound(Stretch& stretch) {
        const auto from = option("from");
        if (!from) return from.error();
        if (*from) stretch.from = **from;
        const auto to = option("to");
        if (!to) return to.error();
        if (*to) stretch.to = **to;
        return *from || *to;
    }

    /// rise=, fall= or cross=, if one of them is here.
    Result<bool> which(Edges& edges) {
        for (const auto& e : edge_words) {
            const bool last = look() == fmt::format("{}=last", e.word);
            if (last) ++at_;
            const auto number = last ? Result<std::optional<double>>(0.0) : option(e.word);
            if (!number) return number.error();
            if (!*number) continue;
            if (!last && !(**number >= 1 && **number == std::floor(**number)))
                return --at_, wrong(fmt::format("'{}' must be 1, 2 ... or last", look()));
            edges.kind = e.kind, edges.which = **number;
            return true;
        }
        return false;
    }

    /// rise= fall= cross= td= from= to=, in any order; before them, of a count, what is counted.
    Result<Edges> edges(bool counted, std::optional<double>* level = nullptr) {
        Edges out;
        for (bool more = true; more;) {
            more = false;
            for (const auto& e : edge_words)
                if (counted && look() == e.word) out.kind = e.kind, more = true, ++at_;
            const auto chosen = counted ? Result<bool>(false) : which(out);
            if (!chosen) return chosen.error();
            const auto bounded = bound(out.within);
            if (!bounded) return bounded.error();
            const auto delay = option("td");
            if (!delay) return delay.error();
            if (*delay) out.within.from = **delay;
            const auto value = level ? option("val") : Result<std::optional<double>>(std::nullopt);
            if (!value) return value.error();
            if (*value) *level = *value;
            more = more || *chosen || *bounded || *delay || *value;
        }
        return out;
    }

    /// CURVE=VALUE or CURVE=CURVE, and which.
    Result<Crossings> edge(bool counted = false) {
        const auto word = look();
        const auto equals = equals_in(word);
        if (equals == std::string::npos) return wrong(fmt::format("'{}' must be CURVE=VALUE", word));
        const auto left = curve(std::string_view(word).substr(0, equals));
        if (!left) return left.error();
        const auto right = std::string_view(word).substr(equals + 1);
        const auto level = whole_number(right);
        const auto other = level ? left : curve(right);
        if (!other) return other.error();
        ++at_;
        const auto which = edges(counted);
        if (!which) return which.error();
        return Crossings(level ? Traced(*left, level->value) : Traced(*left, *other), *which);
    }

    Made summary(Summary::Of of) {
        const auto view = curve();
        if (!view) return view.error();
        Stretch stretch;
        for (bool more = true; more;) {
            const auto bounded = bound(stretch);
            if (!bounded) return bounded.error();
            more = *bounded;
        }
        return Made(std::make_unique<Summary>(of, Traced(*view), stretch));
    }

    Made found(bool slope) {
        const auto view = curve();
        if (!view) return view.error();
        const auto at = option("at");
        if (!at) return at.error();
        if (*at) return Made(std::make_unique<Found>(Traced(*view), slope, Spot{**at, {}}));
        if (look() != "when") return wrong(fmt::format("'{}': at=VALUE or when CURVE=VALUE was expected", look()));
        ++at_;
        auto crossings = edge();
        if (!crossings) return crossings.error();
        return Made(std::make_unique<Found>(Traced(*view), slope, Spot{nothing, std::move(*crossings)}));
    }

    Made between() {
        auto trigger = spot();
        if (!trigger) return trigger.error();
        if (look() != "targ") return wrong("targ was expected after trig");
        ++at_;
        auto target = spot();
        if (!target) return target.error();
        return Made(std::make_unique<Between>(std::move(*trigger), std::move(*target)));
    }

    /// After trig or targ: at=X, or CURVE val=LEVEL and which; or as after when.
    Result<Spot> spot() {
        const auto at = option("at");
        if (!at) return at.error();
        if (*at) return Spot{**at, {}};
        const auto name = look();
        if (equals_in(name) != std::string::npos) {
            auto crossings = edge();
            if (!crossings) return crossings.error();
            return Spot{nothing, std::move(*crossings)};
        }
        const auto view = curve();
        if (!view) return view.error();
        std::optional<double> level;
        const auto which = edges(false, &level);
        if (!which) return which.error();
        if (!level) return wrong(fmt::format("val= was expected after '{}'", name));
        return Spot{nothing, Crossings(Traced(*view, *level), *which)};
    }
};

}  // namespace

Result<std::unique_ptr<Gauge>> gauge_of(const Command& c, const Plot& head) { return Reader(c, head).gauge(); }

}  // namespace corpuscle::circuit
