#include "circuit/netlist/script/script_words.hpp"

#include <algorithm>
#include <utility>

#include "circuit/expression/spice_number.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

bool is_vector_name(std::string_view text) { return text.find_first_of("+-*/^()[]<>&|!%?:,{}'\"= ") == std::string_view::npos; }

/// The offset after the word at `from`. A quoted text or a list in parentheses is one word, and so is an '='.
std::size_t end_of_word(std::string_view text, std::size_t from) {
    constexpr std::string_view open = "('\"", close = ")'\"";
    if (const auto group = open.find(text[from]); group != std::string_view::npos)
        return std::min(text.find(close[group], from + 1), text.size() - 1) + 1;
    return text[from] == '=' ? from + 1 : std::min(text.find_first_of(" \t=", from), text.size());
}

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

std::vector<ScriptVariable> read_variables(std::string_view text) {
    std::vector<std::string_view> words;
    for (auto at = text.find_first_not_of(" \t"); at < text.size(); at = text.find_first_not_of(" \t", at)) {
        const auto end = end_of_word(text, at);
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    std::vector<ScriptVariable> out;
    for (std::size_t k = 0; k < words.size(); ++k) {
        auto& variable = out.emplace_back(ScriptVariable{std::string(words[k]), {}});
        if (k + 2 >= words.size() || words[k + 1] != "=") continue;
        k += 2;
        const auto value = unquoted(words[k]);
        if (value.find_first_of("($") == std::string_view::npos) variable.value = std::string(value);
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
