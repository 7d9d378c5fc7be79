#include "circuit/export/element_text.hpp"

#include <algorithm>
#include <iterator>

#include "circuit/analyses.hpp"
#include "circuit/devices.hpp"

namespace corpuscle::circuit {
namespace {

/// Writes directives one by one. Appends a message to `warnings` for each one that is left out, or whose results differ.
class DirectiveExporter {
    const Circuit& circuit_;
    const ExportNames& names_;
    std::vector<Error>& warnings_;

public:
    DirectiveExporter(const Circuit& circuit, const ExportNames& names, std::vector<Error>& warnings)
        : circuit_(circuit), names_(names), warnings_(warnings) {}

    std::string text(const Directive& c) const {
        if (c.name == "dc") return dc(c);
        if (c.name == "noise") return noise(c);
        if (c.name == "print") return print(c);
        if (c.name == "force") return "";  // the sources contain it
        for (const std::string_view name : {"expect", "step", "mc", "spike", "assert", "probe"})
            if (c.name == name)
                return comment_out(c, name == "step" || name == "mc" ? "ngspice has no such directive; the nominal values are exported"
                                                                     : "ngspice has no such directive");
        if (const auto* analysis = find_analysis(c.name); analysis != nullptr && analysis->ngspice_order == 0)
            return comment_out(c, "ngspice has no such directive");
        return line(c.name, renamed(c));
    }

private:
    bool has_transistors() const {
        return std::any_of(circuit_.elements.begin(), circuit_.elements.end(),
                           [](const Element& e) { return has_role(e, Role::transistor); });
    }
    static std::string line(std::string_view name, const std::vector<std::string>& words) {
        return fmt::format(".{}{}{}\n", name, words.empty() ? "" : " ", fmt::join(words, " "));
    }
    std::string comment_out(const Directive& c, std::string_view why) const {
        auto text = line(c.name, c.words);
        text.pop_back();
        warnings_.push_back(error_at(c.location, "left out: {} ({})", text, why));
        return fmt::format("* left out: {} ({})\n", text, why);
    }
    /// The words with the exported names of nodes and elements.
    std::vector<std::string> renamed(const Directive& c) const {
        std::vector<std::string> out;
        for (const auto& w : c.words) out.push_back(names_.word(w));
        if (c.name == "tf" && out.size() > 1) out[1] = element(out[1]);
        return out;
    }
    /// The exported name of an element; any other word is returned as it is.
    std::string element(const std::string& name) const {
        const auto known = names_.element(name);
        return known.empty() ? name : known;
    }

    std::string dc(const Directive& c) const {
        auto words = c.words;
        const bool is_updown = !words.empty() && words.back() == "updown";
        if (is_updown) words.pop_back();
        for (std::size_t k = 0; k < words.size(); k += 4) {
            if (words[k] == "temp") {
                if (has_transistors()) return comment_out(c, "the parameters of the transistors below are valid at one temperature only");
                continue;
            }
            if (words[k].find_first_of("vir") != 0) return comment_out(c, "ngspice sweeps only sources, resistors and temp");
            words[k] = element(words[k]);
        }
        std::string out = is_updown ? "* left out: updown; ngspice sweeps in one direction only\n" : "";
        if (is_updown) warnings_.push_back(error_at(c.location, "left out: updown of .dc (ngspice sweeps in one direction only)"));
        return out + line("dc", words);
    }

    std::string noise(const Directive& c) const {
        auto words = c.words;
        if (!words.empty()) words[0] = names_.word(words[0]);
        if (words.size() > 1) words[1] = element(words[1]);
        if (!has_transistors()) return line("noise", words);
        const std::string why = "ngspice's result lacks the noise of the transistors, because its expressions have none";
        warnings_.push_back(error_at(c.location, ".noise: {}", why));
        return fmt::format("* {}\n{}", why, line("noise", words));
    }

    /// ngspice requires the name of an analysis in .print. One without a name is written for each analysis of the netlist.
    std::string print(const Directive& c) const {
        constexpr std::string_view printed[] = {"op", "dc", "ac", "noise", "tran"};
        const auto is_kind = [&](const std::string& w) {
            return std::find(std::begin(printed), std::end(printed), w) != std::end(printed);
        };
        auto words = renamed(c);
        if (words.empty() || is_kind(words[0])) return line("print", words);
        words.insert(words.begin(), "");
        std::string out;
        for (const auto kind : printed) {
            words[0] = kind;
            if (circuit_.has_directive(kind)) out += line("print", words);
        }
        return out;
    }
};

/// The position at which ngspice runs an analysis, which does not depend on the order of the lines; 0 for any other directive. It runs
/// several lines of one analysis in reverse order.
int run_rank(std::string_view kind) {
    const auto* analysis = find_analysis(kind);
    return analysis == nullptr ? 0 : analysis->ngspice_order;
}
bool is_analysis(const Directive& c) { return run_rank(c.name) > 0; }

}  // namespace

std::string directives_text(const Circuit& circuit, const ExportNames& names, std::vector<Error>& warnings) {
    const DirectiveExporter exporter(circuit, names, warnings);
    std::string analysis_lines, others;
    std::string_view last_analysis = ac_analysis.name;  // that ngspice runs
    for (const auto& c : circuit.directives)
        if (is_analysis(c) && run_rank(c.name) > run_rank(last_analysis)) last_analysis = c.name;
    for (const auto& c : circuit.directives) {
        if (is_analysis(c)) {
            analysis_lines.insert(0, exporter.text(c));  // in reverse order, so that ngspice runs them in that of the netlist
            continue;
        }
        if (c.name.starts_with("meas") && !c.words.empty() && c.words[0] != last_analysis) {
            const auto why =
                fmt::format(".meas {}: ngspice measures only the analysis that it runs last, here .{}", c.words[0], last_analysis);
            warnings.push_back(bad_input(why, c.location));
            others += fmt::format("* {}\n", why);
        }
        others += exporter.text(c);
    }
    return analysis_lines + others;
}

}  // namespace corpuscle::circuit
