#include "circuit/netlist/dialects.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "circuit/expression/spice_number.hpp"
#include "core/text/ascii_text.hpp"

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

/// True for a line, in small letters, that only a netlist for Spectre has: "parameters vdd=1.8".
bool is_spectre(std::string_view line) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    const auto word = line.substr(0, end), rest = line.substr(end);
    if (word == "simulator") return rest.find("spectre") != std::string_view::npos;
    return (word == "parameters" && rest.find('=') != std::string_view::npos) ||
           ((word == "simulatoroptions" || word == "saveoptions") && trimmed(rest).starts_with("options"));
}

/// True for two or more numbers between commas, semicolons, tabs or blanks, as recordings have them.
bool is_row_of_numbers(std::string_view line) {
    std::size_t numbers = 0;
    for (std::size_t at = line.find_first_not_of(" \t,;"); at != std::string_view::npos; ++numbers) {
        const auto end = std::min(line.find_first_of(" \t,;", at), line.size());
        const auto number = parse_number(line.substr(at, end - at));
        if (!number || !number->suffix.empty()) return false;
        at = line.find_first_not_of(" \t,;", end);
    }
    return numbers >= 2;
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

std::string_view remedy_for_missing(std::string_view directive) {
    static const std::map<std::string_view, std::string_view> all = {{".data", "; write .step param NAME list VALUE ..."},
                                                                     {".machine", ""},
                                                                     {".hb", "; a .tran of many periods with .four gives the harmonics"},
                                                                     {".pss", "; a .tran of many periods with .four gives the harmonics"},
                                                                     {".fft", "; use .four FREQUENCY CURVE"},
                                                                     {".disto", "; use .four FREQUENCY CURVE"},
                                                                     {".sp", "; use .ac"},
                                                                     {".stimulus", "; write the waveform in the line of the source"},
                                                                     {".connect", "; use one name for both nodes, or a 0 V source"},
                                                                     {".sampling", "; use .mc COUNT"}};
    const auto at = all.find(directive);
    return at == all.end() ? "" : at->second;
}

bool is_simulator_line(std::string_view line) {
    constexpr std::string_view word = "simulator";
    return line.starts_with(word) && (line.size() == word.size() || line[word.size()] == ' ' || line[word.size()] == '\t');
}

Result<void> refuse_other_language(const LogicalLine& line, std::string_view title) {
    if (is_spectre(line.text))
        return error_at(line.location(),
                        "'{}' is in the language of Spectre, which is not read; write the netlist in that of SPICE: in Virtuoso, with the "
                        "simulator hspiceD, or as CDL",
                        std::string_view(line.text).substr(0, 40));
    const bool begins_with_number = line.text.find_first_of("+-.0123456789") == 0;  // "0.1;2": the rest is a comment
    if (is_row_of_numbers(line.text) || (begins_with_number && is_row_of_numbers(lower(title))))
        return error_at(line.location(),
                        "'{}' is a line of a recording and not of a netlist; give a recording as the force, and the netlist as the "
                        "afferent: corpuscle respond touch.csv --afferent own.cir",
                        std::string_view(line.text).substr(0, 40));
    return {};
}

Result<void> refuse_title_of_other_language(const ParsedNetlist& parsed) {
    const auto title = lower(parsed.title);
    if (!is_simulator_line(title) || !is_spectre(title)) return {};
    return refuse_other_language({title, {{0, 1, 1}}, std::make_shared<const std::string>(parsed.file), {}}, "");
}

}  // namespace corpuscle::circuit
