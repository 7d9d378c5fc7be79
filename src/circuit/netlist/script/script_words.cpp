#include "circuit/netlist/script/script_words.hpp"

#include <algorithm>
#include <utility>

#include "circuit/expression/spice_number.hpp"

namespace corpuscle::circuit {
namespace {

bool is_vector_name(std::string_view text) { return text.find_first_of("+-*/^()[]<>&|!%?:,{}'\"= ") == std::string_view::npos; }

}  // namespace

std::vector<ScriptWord> split_script_words(std::string_view text, std::size_t from) {
    std::vector<ScriptWord> out;
    int depth = 0;
    bool is_open = false;
    for (std::size_t k = from; k < text.size(); ++k) {
        const char c = text[k];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        const bool separates = c == ' ' || c == '\t' || c == ',';
        if (separates && depth <= 0) {
            is_open = false;
        } else if (!std::exchange(is_open, true)) {
            out.push_back({std::string(1, c), k});
        } else {
            out.back().text += c;
        }
    }
    return out;
}

std::vector<ScriptWord> joined_expressions(std::vector<ScriptWord> words) {
    std::vector<ScriptWord> out;
    for (auto& word : words) {
        constexpr std::string_view operators = "+-*/^";
        const bool continues = !out.empty() && (operators.find(out.back().text.back()) != std::string_view::npos || word.text == "-" ||
                                                std::string_view("+*/^").find(word.text[0]) != std::string_view::npos);
        continues ? void(out.back().text += word.text) : out.push_back(std::move(word));
    }
    return out;
}

bool is_curve_function(std::string_view name) {
    constexpr std::string_view parts[] = {"", "m", "db", "p", "r", "i"};
    return !name.empty() && (name[0] == 'v' || name[0] == 'i') && std::ranges::find(parts, name.substr(1)) != std::end(parts);
}

bool is_plain_curve(std::string_view text) {
    const auto open = text.find('(');
    if (open == std::string_view::npos) return is_vector_name(text) && !parse_number(text);
    return is_curve_function(text.substr(0, open)) && text.find_first_of("()", open + 1) == text.size() - 1;
}

DirectiveText::DirectiveText(const LogicalLine& command, std::string_view name)
    : line_{std::string(name), {}, command.file, {}}, command_(command) {
    locate(0, 1);
}

void DirectiveText::add(std::string_view word, std::size_t at) {
    line_.text += ' ';
    locate(line_.text.size(), at);
    line_.text += word;
}

void DirectiveText::locate(std::size_t offset, std::size_t at) {
    const auto location = command_.location(at);
    line_.segments.push_back({static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(location.line),
                              static_cast<std::uint32_t>(std::max(location.column, 1L))});
}

}  // namespace corpuscle::circuit
