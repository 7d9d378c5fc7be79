#include "circuit/variant/analysis_selection.hpp"

#include "circuit/analyses.hpp"
#include "circuit/measure/measure_line.hpp"
#include "circuit/netlist/statement.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The directive with the given words, as a netlist would have it.
Result<Directive> directive_of(const AnalysisSelection& selection, const std::string& file) {
    const auto text = joined(selection.words, " ");
    // A line reader would take what follows these characters for a comment or another line.
    if (const auto at = text.find_first_of("\n\r;$"); at != std::string::npos)
        return error_at({file}, ".{}: the character '{}' is not allowed here", selection.name,
                        text[at] == '\n'   ? "\\n"
                        : text[at] == '\r' ? "\\r"
                                           : text.substr(at, 1));
    const auto directive = fmt::format(".{} {}", selection.name, text);  // the reader refers to it
    LogicalLineReader reader(directive, std::make_shared<const std::string>(file));
    LogicalLine line;
    TRY(reader.next(line));
    auto statement = split_directive(std::move(line));
    if (!statement) return error_at({file}, "{}: {}", directive, statement.error().message);
    Directive out{selection.name, {}, {}, {file}};
    for (std::size_t k = 1; k < statement->words.size(); ++k) out.words.emplace_back(statement->text(k));
    return out;
}

/// True if a directive is an analysis, or the output of one, of another kind than `name`.
bool concerns_other_analysis(const Circuit& circuit, const Directive& c, std::string_view name) {
    if (find_analysis(c.name)) return c.name != name;
    if (c.name == "four") return name != "tran";
    if (c.name == "plot" || c.name == "expect") return true;
    if (c.name == "print") return !c.words.empty() && find_analysis(c.words[0]) && c.words[0] != name;
    if (!is_measure(c)) return false;
    const auto line = normalized_measure(c, circuit);
    return line && line->words[0] != name;  // the run reports an ill-formed line
}

}  // namespace

Result<Circuit> select_analysis(const Circuit& circuit, const AnalysisSelection& selection) {
    const auto* analysis = find_analysis(selection.name);
    if (!analysis) {
        const auto names = std::vector(std::begin(analyses), std::end(analyses)) | std::views::transform(&Analysis::name);
        return error_at({circuit.file}, "there is no analysis '{}'{}", selection.name, did_you_mean(selection.name, names));
    }
    Circuit out = circuit;
    std::erase_if(out.directives, [&](const Directive& c) { return concerns_other_analysis(circuit, c, selection.name); });
    if (!selection.words.empty()) {
        const auto is_analysis = [&](const Directive& c) { return c.name == selection.name; };
        std::erase_if(out.directives, is_analysis);
        out.directives.push_back(TRY(directive_of(selection, circuit.file)));
    } else if (!out.has_directive(selection.name)) {
        if (analysis != &op_analysis)
            return error_at({circuit.file}, "the netlist has no .{0}; add one, or give the words of {1}", selection.name, analysis->usage);
        out.directives.push_back({selection.name, {}, {}, {circuit.file}});
    }
    return out;
}

}  // namespace corpuscle::circuit
