#include "circuit/measure/measure_line.hpp"

#include "circuit/expression/spice_number.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view measured_analyses[] = {"tran", "ac", "dc", "noise", "op"};
// Analyses of Xyce and ngspice. Those of "_cont" give a result for each edge.
constexpr std::string_view foreign_analyses[] = {"tran_cont", "dc_cont", "ac_cont", "noise_cont", "fft", "sp", "hb", "pss"};

constexpr std::string_view measurements[] = {"find", "when",    "deriv",    "min",   "max",    "pp",     "avg",
                                             "rms",  "integ",   "trig",     "count", "min_at", "max_at", "duty",
                                             "freq", "on_time", "off_time", "err",   "err1",   "err2",   "param="};
constexpr std::string_view foreign_measurements[] = {"error", "four", "thd", "sfdr", "enob", "sndr", "snr"};
constexpr std::string_view foreign_qualifiers[] = {"rise",    "fall",     "cross",         "rfc_level",   "frac_max",  "file",
                                                   "numfreq", "gridsize", "comp_function", "indepvarcol", "depvarcol", "reverse",
                                                   "minfreq", "maxfreq",  "binsiz",        "nbharm"};

struct Spelling {
    std::string_view other, ours;
};
constexpr Spelling spellings[] = {{"derivative", "deriv"}, {"int", "integ"}, {"integral", "integ"}, {"average", "avg"}};
constexpr std::string_view equation_words[] = {"param", "eqn", "equation"};
// A number may follow these without '='.
constexpr std::string_view keys[] = {"at", "val", "td", "from", "to", "on", "off", "minval"};
constexpr std::string_view edge_keys[] = {"rise", "fall", "cross"};
constexpr std::string_view without_effect[] = {"goal", "weight", "precision", "print", "default_val", "default", "failvalue"};

template <class Names>
bool contains(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != std::end(names);
}

std::string_view name_before_equals(std::string_view word) { return word.substr(0, word.find('=')); }

/// True if two words are parts of one expression: "2*" and "v(a)", or "2" and "* v(a)".
bool continues(std::string_view before, std::string_view after) {
    const auto is_operator = [](char c) { return std::string_view("+-*/^<>?:&|").find(c) != std::string_view::npos; };
    return is_operator(before.back()) || std::string_view("*/^<>?:&|").find(after.front()) != std::string_view::npos ||
           (std::string_view("+-").find(after.front()) != std::string_view::npos && after.size() == 1);
}

/// Copies the words of a line, from number 2 on (the first of the measurement), into their normal form.
class WordNormalizer {
    const Directive& from_;
    Directive out_;
    std::size_t at_ = 2;

public:
    WordNormalizer(const Directive& from) : from_(from), out_{from.name, {from.words[0], from.words[1]}, {}, from.location} {
        if (from.columns.size() > 1) out_.columns = {from.columns[0], from.columns[1]};
    }

    Directive run() {
        if (at_ < from_.words.size() && contains(equation_words, name_before_equals(from_.words[at_]))) equation();
        while (at_ < from_.words.size()) word();
        move_interval_behind_curve();
        return std::move(out_);
    }

private:
    void append(std::string word, std::size_t at) {
        out_.words.push_back(std::move(word));
        if (at < from_.columns.size()) out_.columns.push_back(from_.columns[at]);
    }
    const std::string& next() { return from_.words[at_++]; }
    bool continues_here(std::string_view word) const { return at_ < from_.words.size() && continues(word, from_.words[at_]); }

    /// "param=A", "param A" and "eqn A" with all parts of the expression A.
    void equation() {
        const auto at = at_;
        auto text = next();
        const auto equals = text.find('=');
        text = equals == std::string::npos ? "" : text.substr(equals + 1);
        if (text.empty() && at_ < from_.words.size()) text = next();
        if (text.empty()) return append("param=", at);
        while (continues_here(text)) text += next();
        append("param=" + text, at);
    }

    /// "avg from=1m to=2m v(a)" becomes "avg v(a) from=1m to=2m".
    void move_interval_behind_curve() {
        const auto is_bound = [](std::string_view w) { return w.starts_with("from=") || w.starts_with("to=") || w.starts_with("td="); };
        const auto first =
            std::find_if_not(out_.words.begin() + std::min<std::ptrdiff_t>(3, std::ssize(out_.words)), out_.words.end(), is_bound);
        if (first == out_.words.end() || std::ssize(out_.words) < 4) return;
        const auto k = first - out_.words.begin();
        std::rotate(out_.words.begin() + 3, first, first + 1);
        if (out_.columns.size() == out_.words.size())
            std::rotate(out_.columns.begin() + 3, out_.columns.begin() + k, out_.columns.begin() + k + 1);
    }

    /// True if a value for this key follows without '='.
    bool has_value_after(std::string_view key) const {
        if (at_ >= from_.words.size() || from_.words[at_].find('=') != std::string::npos) return false;
        const auto& value = from_.words[at_];
        return contains(keys, key) || (contains(edge_keys, key) && (value == "last" || parse_number(value)));
    }

    void word() {
        const auto at = at_;
        auto text = next();
        if (const auto brace = text.find('{'); at == 2 && brace != std::string::npos && is_measurement(text.substr(0, brace))) {
            append(text.substr(0, brace), at);  // "max{v(a)}"
            text.erase(0, brace);
        }
        if (contains(without_effect, name_before_equals(text)) && text.find('=') != std::string::npos) return;
        if (has_value_after(text)) text += "=" + next();
        while (continues_here(text)) text += next();
        const auto* spelling = std::ranges::find(spellings, text, &Spelling::other);
        append(spelling == std::end(spellings) || at != 2 ? text : std::string(spelling->ours), at);
    }
};

bool begins_measurement(std::string_view word) {
    const auto* spelling = std::ranges::find(spellings, word, &Spelling::other);
    return is_measurement(word) || is_foreign_measurement(word) || spelling != std::end(spellings) ||
           contains(equation_words, name_before_equals(word));
}

}  // namespace

std::string_view foreign_measured_analysis(std::string_view word) {
    const auto* found = std::ranges::find(foreign_analyses, word);
    return found == std::end(foreign_analyses) ? "" : *found;
}

std::string known_measurements() { return joined(measurements); }
bool is_measurement(std::string_view word) { return contains(measurements, word); }
bool is_foreign_measurement(std::string_view word) { return contains(foreign_measurements, word); }
bool is_foreign_qualifier(std::string_view name) { return contains(foreign_qualifiers, name); }

Result<Directive> normalized_measure(const Directive& c, const Circuit& circuit) {
    auto line = c;
    const bool has_analysis = !c.words.empty() && (contains(measured_analyses, c.words[0]) || contains(foreign_analyses, c.words[0]));
    if (!has_analysis && c.words.size() > 1 && begins_measurement(c.words[1])) {
        const auto first = std::ranges::find_if(circuit.directives, [](const Directive& d) { return contains(measured_analyses, d.name); });
        if (first == circuit.directives.end()) return error_at(c.location, ".meas: the netlist has no analysis to measure");
        line.words.insert(line.words.begin(), first->name);
        if (!line.columns.empty()) line.columns.insert(line.columns.begin(), line.columns.front());
    } else if (!has_analysis && !c.words.empty()) {
        return error_at(c.location_of(0), ".meas: '{}' must be one of {}{}", c.words[0], joined(measured_analyses),
                        did_you_mean(c.words[0], measured_analyses));
    }
    if (line.words.size() < 3) return error_at(c.location, ".meas: expected .meas op|dc|ac|noise|tran NAME MEASUREMENT ...");
    return WordNormalizer(line).run();
}

}  // namespace corpuscle::circuit
