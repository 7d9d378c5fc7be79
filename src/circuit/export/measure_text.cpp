#include "circuit/export/measure_text.hpp"

#include <cmath>
#include <optional>

#include "circuit/expression/spice_number.hpp"
#include "circuit/measure/measure_line.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view unknown_to_ngspice[] = {"count", "duty", "freq", "on_time", "off_time", "err", "err1", "err2"};

bool is_part_of_name(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

/// True if the text has this name as a word of its own.
bool mentions(std::string_view text, std::string_view name) {
    for (auto at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
        const auto end = at + name.size();
        if ((at == 0 || !is_part_of_name(text[at - 1])) && (end == text.size() || !is_part_of_name(text[end]))) return true;
    }
    return false;
}

/// The values of the only .dc of the circuit, if it sweeps one source in equal steps.
struct Sweep {
    double from, to, step;
};
std::optional<Sweep> only_sweep(const Circuit& c) {
    std::optional<Sweep> out;
    for (const auto& dc : c.directives_named("dc")) {
        auto words = dc.words;
        if (!words.empty() && words.back() == "updown") words.pop_back();
        if (out || words.size() != 4) return {};
        const auto from = parse_number(words[1]), to = parse_number(words[2]), step = parse_number(words[3]);
        if (!from || !to || !step || step->value == 0) return {};
        out = Sweep{from->value, to->value, std::copysign(step->value, to->value - from->value)};
    }
    return out;
}

}  // namespace

std::string MeasureExporter::line(const Directive& c) const {
    std::string out = "." + c.name;
    for (const auto& word : c.words) out += ' ' + names_.word(word);
    return out + '\n';
}

Result<std::string> MeasureExporter::slope(const Directive& c) const {
    const auto sweep = only_sweep(circuit_);
    const auto at = c.words.size() == 5 && c.words[4].starts_with("at=") ? parse_number(c.words[4].substr(3)) : std::nullopt;
    if (c.words[0] != "dc" || !at || !sweep) return bad_input("ngspice has no deriv; it is exported only for at=VALUE of one .dc");
    // The straight line between the point before the position and the next, at a quarter and three quarters.
    const double points = (at->value - sweep->from) / sweep->step, before = std::max(std::ceil(points - 1e-6) - 1, 0.0);
    const auto position = [&](double part) { return fmt::format("{:.12g}", sweep->from + (before + part) * sweep->step); };
    const auto name = c.words[1], curve = names_.word(c.words[3]);
    std::string out = fmt::format("* ngspice has no deriv: {} is the slope between two points of the .dc\n", name);
    for (const auto& [suffix, part] : {std::pair{"before", 0.25}, {"after", 0.75}})
        out += fmt::format(".{} dc {}_{} find {} at={}\n", c.name, name, suffix, curve, position(part));
    return out + fmt::format(".{0} dc {1} param='({1}_after-{1}_before)/{2}'\n", c.name, name, fmt::format("{:.12g}", sweep->step / 2));
}

Result<std::string> MeasureExporter::measured(const Directive& c) const {
    const auto& kind = c.words[2];
    if (std::ranges::find(unknown_to_ngspice, kind) != std::end(unknown_to_ngspice))
        return bad_input(fmt::format("ngspice has no {}", kind));
    for (const auto& name : left_out_)
        for (std::size_t k = 2; k < c.words.size(); ++k)
            if (mentions(lower(c.words[k]), name)) return bad_input(fmt::format("it needs {}, which is left out", name));
    if (kind == "deriv") return slope(c);
    return kind == "trig" ? distance(c) : line(within_sweep(c));
}

Result<std::string> MeasureExporter::distance(Directive c) const {
    for (std::size_t k = 2; k + 1 < c.words.size(); ++k) {
        if (c.words[k] != "trig" && c.words[k] != "targ") continue;
        const auto position = c.words[k + 1];
        const auto equals = position.rfind('=');
        if (equals == std::string::npos || position.starts_with("at=")) continue;
        if (!parse_number(position.substr(equals + 1)))
            return bad_input(fmt::format("ngspice has no {} where two curves cross", c.words[k]));
        c.words[k + 1] = position.substr(0, equals);
        c.words.insert(c.words.begin() + static_cast<std::ptrdiff_t>(k) + 2, "val" + position.substr(equals));
    }
    return line(c);
}

Directive MeasureExporter::within_sweep(Directive c) const {
    const auto sweep = only_sweep(circuit_);
    if (!sweep || c.words[0] != "dc") return c;
    for (auto& word : c.words) {
        const auto at = word.starts_with("at=") ? parse_number(word.substr(3)) : std::nullopt;
        if (at && std::abs(at->value - sweep->to) < 1e-6 * std::abs(sweep->step))
            word = fmt::format("at={:.12g}", sweep->to - 1e-6 * sweep->step);
    }
    return c;
}

Result<std::string> MeasureExporter::text(const Directive& c) {
    const auto normalized = normalized_measure(c, circuit_);
    if (!normalized || normalized->words.size() < 3) return line(c);
    auto out = measured(*normalized);
    if (!out) left_out_.insert(lower(normalized->words[1]));
    return out;
}

}  // namespace corpuscle::circuit
