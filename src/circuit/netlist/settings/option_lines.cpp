#include "circuit/netlist/settings/option_lines.hpp"

#include "circuit/netlist/settings/directive_words.hpp"

namespace corpuscle::circuit {
namespace {

/// True if an option of another simulator has no counterpart here; adds a warning.
bool is_ignored_option(std::string_view name, XycePackage package, const SourceLocation& location, std::vector<Error>& warnings) {
    if (name == "scale") return false;  // which Xyce has in the package "parser"
    if (is_small_element_option(name)) {
        warnings.push_back(error_at(location, ".options: '{}' is ignored: no such elements are added; if they matter, write them", name));
        return true;
    }
    if (package == XycePackage::none ? !is_foreign_option(name) : package == XycePackage::devices && is_option(name)) return false;
    warnings.push_back(package == XycePackage::none ? error_at(location, ".options: '{}' is not known and is ignored", name)
                                                    : error_at(location, ".options: '{}' belongs to Xyce's solver and is ignored", name));
    return true;
}

Result<void> read_options(const Scope& top, const Statement& s, Circuit& c) {
    const auto package = s.words.size() > 1 ? xyce_package(s.text(1)) : XycePackage::none;
    for (std::size_t k = package == XycePackage::none ? 1 : 2; k < s.words.size(); ++k) {
        if (is_ignored_option(s.text(k), package, s.location(k), c.warnings)) continue;
        TRY(check_option(s.text(k), {}, {}, s.location(k)));
        c.options.insert_or_assign(std::string(s.text(k)), 1.0);
    }
    for (const auto& pair : s.pairs) {
        const std::string name(s.text(pair.name));
        if (is_ignored_option(name, package, s.location(pair.name), c.warnings)) continue;
        const auto text = s.text(pair.value);
        const bool is_word = pair.value.kind == Word::Kind::quoted ||
                             (pair.value.kind == Word::Kind::plain && text[0] >= 'a' && text[0] <= 'z' && !top.parameter(text));
        if (is_word) {
            TRY(check_option(name, {}, text, s.location(pair.name)));
            c.option_words.insert_or_assign(name, std::string(text));
            continue;
        }
        const auto value = TRY(top.evaluate({&s, pair.value}));
        TRY(check_option(name, value, {}, s.location(pair.name)));
        c.options.insert_or_assign(name, value);
    }
    return {};
}

/// Several temperatures repeat all analyses, as in PSpice. An override of the temperature replaces all of them.
Directive step_of_temperature(const Scope& top, const Statement& s) {
    Directive out{"step", {"temp", "list"}, {}, s.line.location()};
    for (std::size_t k = 1; k < s.words.size(); ++k) out.words.push_back(without_blanks(top, s, s.words[k]));
    return out;
}

}  // namespace

Result<void> read_settings(const ParsedNetlist& parsed, const Scope& top, const ResolvedOverrides& overrides, Circuit& c) {
    for (const auto* s : parsed.options) TRY(read_options(top, *s, c));
    for (const auto& [name, value] : overrides.options) c.options.insert_or_assign(name, value);
    if (const auto at = c.options.find("temp"); at != c.options.end()) c.temperature = at->second;
    for (const auto* s : parsed.temperatures) {
        if (s->words.size() < 2) return error_at(s->location(1), ".temp: expected temperatures, in Celsius");
        for (std::size_t k = s->words.size() - 1; k > 0; --k) c.temperature = TRY(top.evaluate(without_braces(*s, s->words[k], 0)));
        if (s->words.size() > 2 && !overrides.temperature) c.directives.push_back(step_of_temperature(top, *s));
    }
    c.temperature = overrides.temperature.value_or(c.temperature);
    c.mismatch_seed = overrides.mismatch_seed, c.chip = overrides.chip;
    return {};
}

}  // namespace corpuscle::circuit
