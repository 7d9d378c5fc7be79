#include "circuit/export/orders.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

namespace corpuscle::circuit {
namespace {

class Orders {
    const Circuit& circuit_;
    const ExportNames& names_;
    std::vector<Error>& left_out_;

public:
    Orders(const Circuit& circuit, const ExportNames& names, std::vector<Error>& left_out)
        : circuit_(circuit), names_(names), left_out_(left_out) {}

    std::string text(const Command& c) const {
        if (c.name == "dc") return dc(c);
        if (c.name == "noise") return noise(c);
        if (c.name == "print") return print(c);
        if (c.name == "force") return "";  // it stands in the sources
        for (const std::string_view own : {"expect", "step", "mc", "spike", "within", "probe"})
            if (c.name == own)
                return left_out(
                    c, own == "step" || own == "mc" ? "ngspice has no such line; here are the plain values" : "ngspice has no such line");
        return line(c.name, renamed(c));
    }

private:
    bool any(char letter) const {
        return std::any_of(circuit_.elements.begin(), circuit_.elements.end(), [&](const Element& e) { return e.letter == letter; });
    }
    static std::string line(std::string_view name, const std::vector<std::string>& words) {
        return fmt::format(".{}{}{}\n", name, words.empty() ? "" : " ", fmt::join(words, " "));
    }
    std::string left_out(const Command& c, std::string_view why) const {
        auto said = line(c.name, c.words);
        said.pop_back();
        left_out_.push_back(bad_input(fmt::format("left out: {} ({})", said, why), c.place));
        return fmt::format("* left out: {} ({})\n", said, why);
    }
    std::vector<std::string> renamed(const Command& c) const {
        std::vector<std::string> out;
        for (const auto& w : c.words) out.push_back(names_.word(w));
        if (c.name == "tf" && out.size() > 1) out[1] = element(out[1]);
        return out;
    }
    /// An element by its name, or what else stands there.
    std::string element(const std::string& name) const {
        const auto known = names_.element(name);
        return known.empty() ? name : known;
    }

    std::string dc(const Command& c) const {
        auto words = c.words;
        const bool both = !words.empty() && words.back() == "updown";
        if (both) words.pop_back();
        for (std::size_t k = 0; k < words.size(); k += 4) {
            if (words[k] == "temp") {
                if (any('m')) return left_out(c, "the transistors' numbers below are those of one temperature");
                continue;
            }
            if (words[k].find_first_of("vir") != 0) return left_out(c, "ngspice sweeps sources, resistors and temp alone");
            words[k] = element(words[k]);
        }
        std::string out = both ? "* left out: updown; ngspice sweeps one way\n" : "";
        if (both) left_out_.push_back(bad_input("left out: updown of a .dc (ngspice sweeps one way)", c.place));
        return out + line("dc", words);
    }

    std::string noise(const Command& c) const {
        auto words = c.words;
        if (!words.empty()) words[0] = names_.word(words[0]);
        if (words.size() > 1) words[1] = element(words[1]);
        if (!any('m')) return line("noise", words);
        const std::string why = "the transistors' own noise is not in what ngspice gives: its formulas are silent";
        left_out_.push_back(bad_input(".noise: " + why, c.place));
        return fmt::format("* {}\n{}", why, line("noise", words));
    }

    /// ngspice wants to know of which analysis: without a word, of each.
    std::string print(const Command& c) const {
        constexpr std::string_view printed[] = {"op", "dc", "ac", "noise", "tran"};
        const auto is_kind = [&](const std::string& w) {
            return std::find(std::begin(printed), std::end(printed), w) != std::end(printed);
        };
        auto words = renamed(c);
        if (words.empty() || is_kind(words[0])) return line("print", words);
        words.insert(words.begin(), "");
        std::string out;
        for (const auto kind : printed) {
            const bool asked =
                std::any_of(circuit_.commands.begin(), circuit_.commands.end(), [&](const Command& other) { return other.name == kind; });
            words[0] = kind;
            if (asked) out += line("print", words);
        }
        return out;
    }
};

}  // namespace

namespace {

/// In the order in which ngspice runs them, whatever that of their lines; of one kind, the last line first.
constexpr std::string_view kinds[] = {"ac", "dc", "op", "tran", "noise", "sens", "tf"};
std::ptrdiff_t rank(std::string_view kind) { return std::find(std::begin(kinds), std::end(kinds), kind) - std::begin(kinds); }
bool is_analysis(const Command& c) { return rank(c.name) < std::ssize(kinds); }

}  // namespace

std::string orders_text(const Circuit& circuit, const ExportNames& names, std::vector<Error>& left_out) {
    const Orders orders(circuit, names, left_out);
    std::string analyses, others;
    std::string_view last = kinds[0];
    for (const auto& c : circuit.commands)
        if (is_analysis(c) && rank(c.name) > rank(last)) last = c.name;
    for (const auto& c : circuit.commands) {
        if (is_analysis(c)) {
            analyses.insert(0, orders.text(c));
            continue;
        }
        if (c.name.starts_with("meas") && !c.words.empty() && c.words[0] != last) {
            const auto why = fmt::format(".meas {}: ngspice measures only what it runs last, here .{}", c.words[0], last);
            left_out.push_back(bad_input(why, c.place));
            others += fmt::format("* {}\n", why);
        }
        others += orders.text(c);
    }
    return analyses + others;
}

}  // namespace corpuscle::circuit
