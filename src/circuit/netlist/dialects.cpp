#include "circuit/netlist/dialects.hpp"

namespace corpuscle::circuit {
namespace {

std::string_view name_of(Dialect dialect) {
    if (dialect == Dialect::ltspice) return "LTspice";
    return dialect == Dialect::xyce ? "Xyce" : "HSPICE";
}

struct DifferentForm {
    std::string_view text;  // in an expression
    Dialect dialect;
    std::string_view here, there, remedy;
};
constexpr DifferentForm different_forms[] = {
    {"^", Dialect::ltspice, "is the power |x|^y", "is the exclusive or of two truth values", "write ** for the power"},
    {"^", Dialect::xyce, "is the power |x|^y", "is the exclusive or of two truth values", "write ** for the power"},
    {"pwr(", Dialect::ltspice, "has the sign of its first argument", "is |x|^y", "write pow(abs(x),y)"},
    {"pwr(", Dialect::xyce, "has the sign of its first argument", "is |x|^y", "write pow(abs(x),y)"},
};

/// The offset of the form in an expression of the statement; npos if there is none.
std::size_t find_form(const Statement& s, std::string_view form) {
    const std::string_view text = s.line.text;
    bool is_quoted = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '"') is_quoted = !is_quoted;
        const bool is_part_of_name = form != "^" && at > 0 && is_name_character(text[at - 1]);
        if (!is_quoted && !is_part_of_name && text.substr(at, form.size()) == form) return at;
    }
    return std::string::npos;
}

}  // namespace

Dialect recognise_dialect(const ParsedNetlist& parsed) {
    if (parsed.marks.contains(".backanno")) return Dialect::ltspice;
    if (parsed.marks.contains(".global_param")) return Dialect::xyce;
    for (const auto* s : parsed.options) {
        if (s->words.size() > 1 && xyce_package(s->text(1)) != XycePackage::none) return Dialect::xyce;
        if (s->find("runlvl") != nullptr || s->find("ingold") != nullptr) return Dialect::hspice;
    }
    return Dialect::unknown;
}

void warn_about_dialect(ParsedNetlist& parsed) {
    const auto dialect = recognise_dialect(parsed);
    if (dialect == Dialect::unknown) return;
    for (const auto& form : different_forms) {
        if (form.dialect != dialect) continue;
        const auto uses = [&](const Statement& s) { return find_form(s, form.text) != std::string::npos; };
        const auto found = std::ranges::find_if(parsed.statements, uses);
        if (found == parsed.statements.end()) continue;
        const auto name = form.text.substr(0, form.text.find('('));
        parsed.warnings.push_back(error_at(found->line.location(find_form(*found, form.text)), "'{}' {}; in {} it {}: {}", name, form.here,
                                           name_of(dialect), form.there, form.remedy));
    }
    const bool has_temperature =
        !parsed.temperatures.empty() || std::ranges::any_of(parsed.options, [](const Statement* s) { return s->find("temp"); });
    if (dialect == Dialect::hspice && !has_temperature)
        parsed.warnings.push_back(error_at({parsed.file}, "the temperature is 27 C; the default of HSPICE is 25 C: write .temp 25"));
}

}  // namespace corpuscle::circuit
