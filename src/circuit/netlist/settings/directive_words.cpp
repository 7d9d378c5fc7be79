#include "circuit/netlist/settings/directive_words.hpp"

#include <algorithm>

namespace corpuscle::circuit {
namespace {

/// The offset after the quotes or braces that open at `from`.
std::size_t group_end(std::string_view text, std::size_t from) {
    if (text[from] != '{') return std::min(text.find(text[from], from + 1), text.size() - 1) + 1;
    int depth = 0;
    for (std::size_t k = from; k < text.size(); ++k) {
        depth += text[k] == '{' ? 1 : text[k] == '}' ? -1 : 0;
        if (depth == 0) return k + 1;
    }
    return text.size();
}

/// The value, as text, of the expression in braces or quotes from offset `from` to `end` of a word. The original text if it is in double
/// quotes or cannot be evaluated.
std::string evaluate_group(const Scope& scope, const Statement& s, const Word& w, std::size_t from, std::size_t end) {
    const std::string original(s.text(w).substr(from, end - from));
    if (original[0] == '"' || original.size() < 3) return original;
    const Word inside{Word::Kind::expression, static_cast<std::uint32_t>(w.at + from + 1), static_cast<std::uint32_t>(end - from - 2)};
    const auto value = scope.evaluate({&s, inside});
    return value ? fmt::format("{:.17g}", *value) : original;
}

bool is_expectation(const Directive& directive) { return directive.name == "expect"; }

}  // namespace

WordRef without_braces(const Statement& s, Word w, std::uint32_t from) {
    w.at += from, w.size -= from;
    const auto text = s.text(w);
    if (text.size() >= 2 && ((text[0] == '{' && text.back() == '}') || (text[0] == '\'' && text.back() == '\'')))
        w = {Word::Kind::expression, w.at + 1, w.size - 2};
    return {&s, w};
}

std::string without_blanks(const Scope& scope, const Statement& s, const Word& w) {
    std::string out;
    const auto text = s.text(w);
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c != '{' && c != '\'' && c != '"') {
            if (c != ' ' && c != '\t') out += c;
            continue;
        }
        const auto end = group_end(text, k);
        out += evaluate_group(scope, s, w, k, end);
        k = end - 1;
    }
    return out;
}

Directive make_directive(const Scope& top, const Statement& s) {
    Directive out{std::string(s.text(0).substr(1)), {}, {}, s.line.location()};
    if (s.analysis) out.analysis_location = s.analysis->line.location();
    for (std::size_t k = 1; k < s.words.size(); ++k) {
        out.words.push_back(without_blanks(top, s, s.words[k]));
        out.columns.push_back(static_cast<int>(s.location(k).column));
    }
    return out;
}

void apply_directive_overrides(const ResolvedOverrides& overrides, bool changes_values, Circuit& c) {
    const auto expectation = std::ranges::find_if(c.directives, is_expectation);
    if (changes_values && expectation != c.directives.end()) {
        c.warnings.push_back(error_at(expectation->location, "values of the netlist are overridden, so .expect is ignored"));
        std::erase_if(c.directives, is_expectation);
    }
    std::erase_if(c.directives, [&](const Directive& directive) {
        return (overrides.replaces_saved && (directive.name == "save" || directive.name == "probe")) ||
               (overrides.mismatch_seed && directive.name == "mc");
    });
    if (!overrides.saved.empty()) c.directives.push_back({"save", overrides.saved, {}, {c.file}});
}

}  // namespace corpuscle::circuit
