#include "run/export/equation_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>

#include "core/version.hpp"
#include "run/afferent_plan.hpp"

namespace corpuscle {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The end of the number at the beginning of the text: "5e3*x" has 3.
std::size_t number_end(std::string_view text) {
    std::size_t end = 0;
    while (end < text.size()) {
        const bool is_sign = (text[end] == '+' || text[end] == '-') && end > 0 && (text[end - 1] == 'e' || text[end - 1] == 'E');
        if (!is_word(text[end]) && text[end] != '.' && !is_sign) break;
        ++end;
    }
    return end;
}

/// Splits the arguments of a call, whose text begins after the opening parenthesis. Returns them and the position after the closing one.
std::pair<std::vector<std::string_view>, std::size_t> arguments_of(std::string_view text) {
    std::vector<std::string_view> arguments;
    std::size_t start = 0;
    for (std::size_t k = 0, depth = 0; k < text.size(); ++k) {
        const bool ends = depth == 0 && (text[k] == ',' || text[k] == ')');
        if (ends) arguments.push_back(text.substr(start, k - start)), start = k + 1;
        if (ends && text[k] == ')') return {arguments, k + 1};
        depth += text[k] == '(', depth -= text[k] == ')';
    }
    return {arguments, text.size()};
}

std::string_view without_spaces(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    return text;
}

/// "k_d = 1e-07 A s/N, dynamic gain"
std::string parameter_line(const ParameterNumber& p) {
    return fmt::format("{} = {:g}{}{}: {}", p.name, p.value, p.unit.empty() ? "" : " ", p.unit, p.description);
}

std::vector<std::string> heading_of(const AfferentPlan& plan, const AfferentEquations& equations, const std::string& command) {
    const auto arguments = command.substr(std::string_view("corpuscle export ").size());
    std::vector<std::string> lines = {fmt::format("{}{}', version {}.", export_mark, arguments, version)};
    lines.push_back(fmt::format("{} ({}+{}): {}.", plan.name, plan.receptor, plan.neuron, plan.description));
    lines.push_back("The equations and values are those of Corpuscle, in SI units. Forces are in N, times in s.");
    if (!equations.receptor->smoothing.empty()) lines.emplace_back(equations.receptor->smoothing);
    lines.emplace_back("Parameters:");
    for (const auto& p : equations.parameters) lines.push_back("  " + parameter_line(p));
    return lines;
}

}  // namespace

std::string EquationDialect::name(std::string_view text) const {
    for (const auto& n : names)
        if (n.name == text) return std::string(n.text);
    return std::string(text);
}

std::string EquationDialect::expression(std::string_view text) const {
    std::string out;
    while (!text.empty()) {
        if (!is_word(text[0])) {
            out += text[0], text.remove_prefix(1);
            continue;
        }
        std::size_t end = number_end(text);
        if (std::isdigit(static_cast<unsigned char>(text[0])) == 0)
            end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_word) - text.begin());
        const auto word = text.substr(0, end);
        text.remove_prefix(end);
        if (!text.starts_with('(')) {
            out += name(word);
            continue;
        }
        const auto [arguments, length] = arguments_of(text.substr(1));
        text.remove_prefix(length + 1);
        std::string call;
        for (std::size_t k = 0; k < arguments.size(); ++k) call += fmt::format("{}${}", k == 0 ? "" : ", ", k + 1);
        call = fmt::format("{}({})", word, call);
        for (const auto& f : functions)
            if (f.name == word) call = f.text;
        for (std::size_t k = 0; k < call.size(); ++k) {
            const bool is_argument = call[k] == '$' && k + 1 < call.size();
            out += is_argument ? expression(without_spaces(arguments[static_cast<std::size_t>(call[++k] - '1')])) : std::string(1, call[k]);
        }
    }
    return out;
}

std::string number_text(double x) {
    auto text = fmt::format("{}", x);
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return text;
}

std::string fill_template(std::string_view text, const std::vector<TemplateValue>& values) {
    std::string out;
    for (auto at = text.find('@'); at != text.npos; at = text.find('@')) {
        const auto end = text.find('@', at + 1), begin = at + 1;
        const auto name = text.substr(begin, end == text.npos ? 0 : end - begin);
        const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.name == name; });
        out += text.substr(0, at);
        out += value == values.end() ? "@" : value->text;
        text.remove_prefix(value == values.end() ? begin : end + 1);
    }
    return out + std::string(text);
}

std::string identifier_of(std::string_view name) {
    std::string out;
    for (const char c : name) out += is_word(c) ? c : '_';
    return out.empty() || std::isalpha(static_cast<unsigned char>(out[0])) == 0 ? "afferent_" + out : out;
}

std::string ExportedAfferent::initial(const StateEquation& state) const {
    for (const auto& number : equations.initial)
        if (number.name == state.name) return number_text(number.value);
    return std::string(state.initial);
}

Result<ExportedAfferent> exported_afferent(const ExportRequest& request, const ExportTarget& target) {
    if (nir::names_graph(request.subject))
        return bad_input(fmt::format("{}: a NIR graph is not exported; Python's nir library and the simulators of NIR read it", request.subject));
    auto planned = TRY(plan_any_afferent(request.subject, request.settings));
    const std::string name = planned.result.name;
    TRY(check_all_used(planned.unused, std::array<std::string_view, 1>{name}));
    ExportedAfferent out{std::move(planned.result), {}, {}, {}};
    out.equations = TRY(equations_of(out.plan));
    out.command = fmt::format("corpuscle export {} --for {}", request.subject, target.name);
    for (const auto& s : request.settings) out.command += fmt::format(" --set {}", s.text());
    out.heading = heading_of(out.plan, out.equations, out.command);
    return out;
}

std::string prefixed_lines(const std::vector<std::string>& lines, std::string_view prefix) {
    std::string out;
    for (const auto& line : lines) out += fmt::format("{}{}\n", prefix, line);
    return out;
}

bool has_export_mark(std::string_view beginning) { return beginning.substr(0, 400).find(export_mark) != beginning.npos; }

}  // namespace corpuscle
