#include "circuit/export/ngspice_deck.hpp"

#include "circuit/analyses.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"
#include "circuit/export/measure_text.hpp"
#include "circuit/export/start_text.hpp"
#include "circuit/export/uicm_subcircuit.hpp"
#include "circuit/measure/measure_line.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The text with spaces instead of newlines.
std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

/// True if the circuit has transistors of this polarity, with a body effect or without.
bool has_transistors(const Circuit& c, bool pmos, bool has_body_effect) {
    return std::any_of(c.elements.begin(), c.elements.end(), [&](const Element& e) {
        const Model* const model = has_role(e, Role::transistor) ? c.model_of(e) : nullptr;
        return model != nullptr && (model->type == "pmos") == pmos && (value_or(model->values, "gamma", 0) > 0) == has_body_effect;
    });
}

std::string header(const Circuit& c, bool transistors, const Kit* kit) {
    std::string out = c.title.empty() ? "exported by corpuscle\n" : one_line(c.title) + '\n';
    out += fmt::format("* Written by 'corpuscle export {} --for ngspice{}' for ngspice 39: flat, all parameters evaluated.\n",
                       one_line(c.file), kit ? " --card" : "");
    out += "* Run it with: ngspice -b DECK -r DECK.raw (without -r it prints and measures)\n";
    out += "* Inside subcircuits x1.m3 is renamed xm_x1_m3, and x1.r1 r_x1_r1; nodes keep their names.\n";
    if (kit)
        out +=
            "* Transistors are those of a kit. Equal arrays share a subcircuit: units in series under one gate, with inner nodes such as\n"
            "* xm1.n1; the columns are the multiplier.\n";
    if (transistors && !kit)
        out +=
            "* Transistors are expressions, so their noise and the table of the operating point are missing. Nodes such as xm1.zs\n"
            "* belong to the transistors; they solve their equations. The parameters of a transistor are valid at one temperature only.\n";
    return out;
}

/// .options and .temp. Tolerances are tighter than in Corpuscle, because ngspice stops iterating one step earlier and its defaults are far
/// too loose for picoamperes. itl2 limits the iterations for each point of a sweep after the first. In transients, ngspice's trapezoidal
/// rule fails at picoamperes ("timestep too small"); Gear's method does not. A transient of a kit's transistors has our own tolerances: it
/// takes a quarter of the time, and its models are less exact than that.
std::string options_text(const Tolerances& t, const Circuit& c, const Kit* kit) {
    const bool is_loose = kit && c.has_directive("tran");
    std::string out =
        fmt::format(".options reltol={} abstol={} vntol={} gmin={} itl1={} itl2={}", is_loose ? t.reltol : std::min(t.reltol, 1e-7),
                    t.abstol, is_loose ? t.vntol : std::min(t.vntol, 1e-10), t.gmin, std::max(t.itl1, 500), std::max(t.itl1, 500));
    for (const std::string_view name : {"chgtol", "trtol", "itl4", "maxord", "tnom"})
        if (const auto option = c.options.find(name); option != c.options.end()) out += fmt::format(" {}={}", name, option->second);
    if (const auto method = c.option_words.find("method"); method != c.option_words.end())
        out += " method=" + method->second;
    else if (c.has_directive("tran"))
        out += " method=gear";
    return fmt::format("{}\n.temp {}\n", out, c.temperature);
}

/// Writes directives one by one. Appends a message to `warnings` for each one that is left out, or whose results differ.
class DirectiveExporter {
    const Circuit& circuit_;
    const ExportNames& names_;
    std::vector<Error>& warnings_;
    bool has_expressions_;  // true: transistors are expressions
    bool has_kit_;          // true: they are those of a kit

public:
    DirectiveExporter(const Circuit& circuit, const ExportNames& names, bool has_kit, std::vector<Error>& warnings)
        : circuit_(circuit), names_(names), warnings_(warnings),
          has_expressions_(!has_kit &&
                           std::ranges::any_of(circuit.elements, [](const Element& e) { return has_role(e, Role::transistor); })),
          has_kit_(has_kit) {}

    std::string text(const Directive& c) const {
        if (c.name == "dc") return dc(c);
        if (c.name == "noise") return noise(c);
        if (c.name == "print") return print(c);
        if (c.name == "pz" && c.words.size() == 2) return comment_out(c, "ngspice needs the form .pz IN+ IN- OUT+ OUT- vol|cur pz");
        if (c.name == "force") return "";  // the sources contain it
        if (c.name == "op" && has_kit_ && circuit_.has_directive("force") && circuit_.has_directive("tran"))
            return comment_out(c, "the .nodeset lines are the start of the .tran, with its force; ngspice searches for minutes from there");
        for (const std::string_view name : {"expect", "step", "mc", "spike", "assert", "probe"})
            if (c.name == name)
                return comment_out(c, name == "step" || name == "mc" ? "ngspice has no such directive; the nominal values are exported"
                                                                     : "ngspice has no such directive");
        if (const auto* analysis = find_analysis(c.name); analysis != nullptr && analysis->ngspice_order == 0)
            return comment_out(c, "ngspice has no such directive");
        return line(c.name, renamed(c));
    }

    std::string comment_out(const Directive& c, std::string_view why) const {
        auto text = line(c.name, c.words);
        text.pop_back();
        warnings_.push_back(error_at(c.location, "left out: {} ({})", text, why));
        return fmt::format("* left out: {} ({})\n", text, why);
    }

private:
    static std::string line(std::string_view name, const std::vector<std::string>& words) {
        return fmt::format(".{}{}{}\n", name, words.empty() ? "" : " ", joined(words, " "));
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
                if (has_expressions_) return comment_out(c, "the parameters of the transistors below are valid at one temperature only");
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
        if (!has_expressions_) return line("noise", words);
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

/// All directives as lines, with analyses first. Directives that ngspice does not have become comments. Appends to `warnings`: a message
/// for each of them, and for each directive whose results differ in ngspice.
std::string directives_text(const Circuit& circuit, const ExportNames& names, bool has_kit, std::vector<Error>& warnings) {
    const DirectiveExporter exporter(circuit, names, has_kit, warnings);
    MeasureExporter measures(circuit, names);
    std::string analysis_lines, others;
    std::string_view last_analysis = ac_analysis.name;  // that ngspice runs
    for (const auto& c : circuit.directives)
        if (is_analysis(c) && run_rank(c.name) > run_rank(last_analysis)) last_analysis = c.name;
    for (const auto& c : circuit.directives) {
        if (is_analysis(c)) {
            analysis_lines.insert(0, exporter.text(c));  // in reverse order, so that ngspice runs them in that of the netlist
            continue;
        }
        if (!is_measure(c)) {
            others += exporter.text(c);
            continue;
        }
        if (!c.words.empty() && c.words[0] != last_analysis) {
            const auto why =
                fmt::format(".meas {}: ngspice measures only the analysis that it runs last, here .{}", c.words[0], last_analysis);
            warnings.push_back(bad_input(why, c.location));
            others += fmt::format("* {}\n", why);
        }
        const auto text = measures.text(c);
        others += text ? *text : exporter.comment_out(c, text.error().message);
    }
    const auto is_of_ac = [](const Directive& c) { return is_measure(c) && !c.words.empty() && c.words[0] == "ac"; };
    if (std::ranges::any_of(circuit.directives, is_of_ac) && !circuit.has_directive("save"))
        others += ".save all\n";  // ngspice finds no curve to save in "find vm(out)", and would not run the .ac
    return analysis_lines + others;
}

/// The subcircuits of expressions that the transistors of the circuit need; "" if it has none.
std::string uicm_subcircuits(const Circuit& c) {
    std::string out;
    for (const bool pmos : {false, true})
        for (const bool has_body_effect : {false, true})
            if (has_transistors(c, pmos, has_body_effect)) out += uicm_subcircuit(pmos, has_body_effect);
    return out.empty() ? out : uicm_functions() + out;
}

/// The elements and models, with the subcircuits that transistors are instances of.
Result<std::string> elements_text(const Circuit& c, const ExportNames& names, const Kit* kit) {
    std::string out;
    std::optional<KitArrays> arrays;
    if (kit) arrays.emplace(c, *kit);
    for (std::size_t k = 0; k < c.elements.size(); ++k)
        out += TRY(arrays && has_role(c.elements[k], Role::transistor) ? arrays->instance(c.elements[k], element_head(c, k, names))
                                                                       : element_text(c, k, names));
    for (std::size_t k = 0; k < c.models.size(); ++k) out += model_text(c, k, names);
    if (arrays) return out + arrays->subcircuits();
    return out + uicm_subcircuits(c);
}

}  // namespace

Result<NgspiceDeck> ngspice_deck(std::shared_ptr<const Circuit> circuit, const Kit* kit) {
    const auto context = TRY(AnalysisContext::make(circuit));
    const Circuit& c = *circuit;
    const ExportNames names(c);
    const bool has_arrays = !uicm_subcircuits(c).empty();
    if (kit && !has_arrays)
        return bad_input(fmt::format("--card: {} has no transistors of level {}, which the kit's would replace; leave --card out", c.file,
                                     UicmCard::level));
    const auto lines = kit ? TRY(kit_lines(c, *kit)) : KitLines{};
    NgspiceDeck deck{header(c, has_arrays, kit) + options_text(context->tolerances, c, kit) + lines.before, {}};
    deck.text += TRY(elements_text(c, names, kit)) + lines.after;
    deck.text += kit ? start_text(*context, names) : node_voltages(".nodeset", c.nodesets, names);
    deck.text += node_voltages(".ic", c.ic, names);
    if (c.options.contains("noisefmax") && c.has_directive("tran"))
        deck.warnings.push_back(error_at({c.file}, "left out: .options noisefmax (ngspice has no noise of devices in a transient)"));
    deck.text += directives_text(c, names, kit != nullptr, deck.warnings) + ".end\n";
    return deck;
}

}  // namespace corpuscle::circuit
