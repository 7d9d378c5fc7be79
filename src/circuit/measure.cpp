#include "circuit/measure.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "circuit/curves.hpp"
#include "circuit/netlist/number.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A curve along what was swept, real; of a complex plot its magnitude, as ngspice measures it.
struct Course {
    std::vector<double> x, y;

    /// Nothing beyond the ends; a value that rounding put there is meant as the end.
    double at(double where) const {
        if (x.empty()) return nothing;
        const double slack = 1e-9 * std::abs(x.back() - x.front());
        for (const std::size_t end : {std::size_t{0}, x.size() - 1})
            if (std::abs(where - x[end]) <= slack) return y[end];
        for (std::size_t k = 1; k < x.size(); ++k)
            if ((x[k - 1] <= where && where <= x[k]) || (x[k] <= where && where <= x[k - 1])) {
                const double h = x[k] - x[k - 1];
                return h == 0 ? y[k] : y[k - 1] + (y[k] - y[k - 1]) * (where - x[k - 1]) / h;
            }
        return nothing;
    }
};

/// The words of one measure after its name, some with "=": from=1, when, v(out)=0.5.
struct Words {
    const Command& command;
    std::size_t at;

    bool done() const { return at >= command.words.size(); }
    std::string next() { return done() ? "" : command.words[at++]; }
    const std::string& look() const {
        static const std::string none;
        return done() ? none : command.words[at];
    }
    Error wrong(std::string_view what) const {
        auto place = command.place;
        if (at < command.columns.size()) place.column = command.columns[at];
        return bad_input(fmt::format(".meas: {}", what), place);
    }
    /// The number after "name=" if the next word is that.
    Result<std::optional<double>> option(std::string_view name) {
        const auto& word = look();
        if (!word.starts_with(name) || word.size() <= name.size() || word[name.size()] != '=') return std::optional<double>();
        const auto number = whole_number(std::string_view(word).substr(name.size() + 1));
        if (!number) return wrong(fmt::format("'{}': a number was expected after '{}='", word, name));
        ++at;
        return std::optional<double>(number->value);
    }
};

class Measure {
    const Plot& plot_;
    Words& words_;

    Result<Course> course(const std::string& name) const {
        auto values = values_of(plot_, name);
        if (!values && name.starts_with("par(")) return words_.wrong("par() is not known here; say param=");
        if (!values) return words_.wrong(fmt::format("there is no curve '{}' in '{}'", name, plot_.name));
        Course out;
        for (std::size_t k = 0; k < values->size(); ++k) {
            out.x.push_back(plot_.curves[0].values[k].real());
            const auto y = (*values)[k];
            const bool viewed = name.find('(') > 1;
            out.y.push_back(plot_.is_complex && !viewed ? std::abs(y) : y.real());
        }
        return out;
    }

    /// "v(out)=0.5" or "v(out)=v(in)", then rise= fall= cross= td=: where along the sweep.
    Result<double> crossing() {
        const auto word = words_.next();
        const auto equals = word.find('=');
        if (equals == std::string::npos) return words_.wrong(fmt::format("'{}' must be CURVE=VALUE", word));
        auto left = course(word.substr(0, equals));
        if (!left) return left.error();
        const auto right = word.substr(equals + 1);
        if (const auto level = whole_number(right)) {
            for (double& y : left->y) y -= level->value;
        } else {
            const auto other = course(right);
            if (!other) return other.error();
            for (std::size_t k = 0; k < left->y.size(); ++k) left->y[k] -= other->y[k];
        }
        std::string kind = "cross";
        double which = 1, after = -std::numeric_limits<double>::infinity();
        for (bool more = true; more;) {
            more = false;
            for (const std::string_view name : {"rise", "fall", "cross", "td"}) {
                if (name != "td" && words_.look() == fmt::format("{}=last", name)) {
                    kind = name, which = -1, more = true, words_.next();
                    continue;
                }
                const auto value = words_.option(name);
                if (!value) return value.error();
                if (!*value) continue;
                more = true;
                if (name == "td")
                    after = **value;
                else
                    kind = name, which = **value;
            }
        }
        double last = nothing;
        for (std::size_t k = 1; k < left->y.size(); ++k) {
            const double a = left->y[k - 1], b = left->y[k];
            const bool rises = a < 0 && b >= 0, falls = a > 0 && b <= 0;
            if (!((rises && kind != "fall") || (falls && kind != "rise"))) continue;
            const double where = left->x[k - 1] + (left->x[k] - left->x[k - 1]) * (a / (a - b));
            if (where < after) continue;
            last = where;
            if (which > 0 && --which < 0.5) return where;
        }
        return which > 0 ? nothing : last;
    }

    /// The part of a course between from= and to=.
    Result<Course> stretch(const std::string& name) {
        auto all = course(name);
        if (!all) return all.error();
        double from = -std::numeric_limits<double>::infinity(), to = -from;
        for (int k = 0; k < 2; ++k) {
            const auto a = words_.option("from"), b = words_.option("to");
            if (!a) return a.error();
            if (!b) return b.error();
            if (*a) from = **a;
            if (*b) to = **b;
        }
        Course out;
        for (std::size_t k = 0; k < all->x.size(); ++k)
            if (all->x[k] >= from && all->x[k] <= to) out.x.push_back(all->x[k]), out.y.push_back(all->y[k]);
        return out;
    }

    static double integral(const Course& c, double power) {
        double sum = 0;
        for (std::size_t k = 1; k < c.x.size(); ++k)
            sum += 0.5 * (std::pow(c.y[k - 1], power) + std::pow(c.y[k], power)) * (c.x[k] - c.x[k - 1]);
        return sum;
    }

    Result<double> over(const std::string& what) {
        const auto c = stretch(words_.next());
        if (!c) return c.error();
        if (c->x.empty()) return nothing;
        const auto [low, high] = std::minmax_element(c->y.begin(), c->y.end());
        const double length = c->x.back() - c->x.front();
        if (what == "min") return *low;
        if (what == "max") return *high;
        if (what == "pp") return *high - *low;
        if (what == "min_at" || what == "max_at") return c->x[static_cast<std::size_t>((what == "min_at" ? low : high) - c->y.begin())];
        if (what == "integ") return integral(*c, 1);
        if (what == "avg") return length == 0 ? c->y[0] : integral(*c, 1) / length;
        return length == 0 ? std::abs(c->y[0]) : std::sqrt(integral(*c, 2) / length);
    }

    /// at=X, or when CURVE=...
    Result<double> where() {
        const auto at = words_.option("at");
        if (!at) return at.error();
        if (*at) return **at;
        if (words_.look() != "when") return words_.wrong(fmt::format("'{}': at=VALUE or when CURVE=VALUE was expected", words_.look()));
        words_.next();
        return crossing();
    }

public:
    Measure(const Plot& plot, Words& words) : plot_(plot), words_(words) {}

    Result<double> value() {
        const auto what = words_.next();
        for (const std::string_view w : {"min", "max", "pp", "avg", "rms", "integ", "min_at", "max_at"})
            if (what == w) return over(what);
        if (what == "when") return crossing();
        if (what == "find" || what == "deriv") {
            const auto c = course(words_.next());
            if (!c) return c.error();
            const auto x = where();
            if (!x) return x.error();
            if (what == "find") return c->at(*x);
            for (std::size_t k = 1; k < c->x.size(); ++k)
                if (c->x[k - 1] <= *x && *x <= c->x[k]) return (c->y[k] - c->y[k - 1]) / (c->x[k] - c->x[k - 1]);
            return nothing;
        }
        if (what == "trig") {
            const auto from = edge();
            if (!from) return from.error();
            if (words_.next() != "targ") return words_.wrong("targ was expected after trig");
            const auto to = edge();
            if (!to) return to.error();
            return *to - *from;
        }
        return words_.wrong(fmt::format(
            "'{}' is not known; there are find, when, deriv, min, max, pp, avg, rms, integ, min_at, max_at, trig, param=", what));
    }

private:
    /// After trig or targ: at=X, or CURVE val=LEVEL rise=N.
    Result<double> edge() {
        const auto at = words_.option("at");
        if (!at) return at.error();
        if (*at) return **at;
        const auto curve = words_.next();
        const auto level = words_.option("val");
        if (!level) return level.error();
        if (!*level) return words_.wrong(fmt::format("val= was expected after '{}'", curve));
        Command joined = words_.command;
        joined.words = {fmt::format("{}={:.17g}", curve, **level)};
        while (!words_.done() && words_.look() != "targ") joined.words.push_back(words_.next());
        Words inner{joined, 0};
        return Measure(plot_, inner).crossing();
    }
};

/// param='expression' of earlier measures.
Result<double> parameter(const Command& c, const std::string& text, const RunOutcome& out) {
    FormulaScope scope;
    scope.parameter = [&](std::string_view name) -> std::optional<double> {
        for (const auto& [known, value] : out.numbers)
            if (known == name) return value;
        return {};
    };
    scope.function = [](std::string_view) -> const FormulaScope::Function* { return nullptr; };
    for (const auto& [known, value] : out.numbers) scope.known.push_back(known);
    auto inside = text;
    if (inside.size() > 1 && (inside.front() == '\'' || inside.front() == '{')) inside = inside.substr(1, inside.size() - 2);
    const auto formula = Formula::parse(inside, c.place, scope);
    if (!formula) return formula.error();
    return formula->value();
}

/// Of an operating point: find CURVE.
Result<double> at_rest(const Plot& plot, Words& words) {
    if (words.next() != "find") return words.wrong("of an operating point: find v(node), v(a,b) or i(source)");
    const auto curve = words.next();
    const auto values = values_of(plot, curve);
    if (!values || values->empty()) return words.wrong(fmt::format("there is no {}", curve));
    return values->front().real();
}

}  // namespace

Result<void> measure(const Circuit& circuit, RunOutcome& out) {
    for (const auto& c : circuit.commands) {
        if (c.name != "meas" && c.name != "measure") continue;
        if (c.words.size() < 3) return bad_input(".meas: it is .meas op|dc|ac NAME WHAT ...", c.place);
        const auto& name = c.words[1];
        if (c.words[2].starts_with("param=")) {
            const auto value = parameter(c, c.words[2].substr(6), out);
            if (!value) return value.error();
            out.numbers.emplace_back(name, *value);
            continue;
        }
        const auto analysed =
            std::find_if(out.analyses.begin(), out.analyses.end(), [&](const Analysed& a) { return a.command->name == c.words[0]; });
        if (analysed == out.analyses.end() || analysed->findings.plots.empty())
            return bad_input(fmt::format(".meas: the netlist has no .{} to measure", c.words[0]), c.place);
        Words words{c, 2};
        const auto& plot = analysed->findings.plots[0];
        const auto value = plot.swept ? Measure(plot, words).value() : at_rest(plot, words);
        if (!value) return value.error();
        if (!words.done()) return words.wrong(fmt::format("'{}' is not known here", words.look()));
        if (std::isnan(*value)) out.remarks.push_back(bad_input(fmt::format(".meas {}: nothing was found", name), c.place));
        out.numbers.emplace_back(name, *value);
    }
    return {};
}

}  // namespace corpuscle::circuit
