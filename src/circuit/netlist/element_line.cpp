#include "circuit/netlist/element_line.hpp"

#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/definition_reader.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The device that other simulators have for a letter that is unknown here; "" if there is none.
std::string_view foreign_device(char letter) {
    constexpr std::pair<char, std::string_view> names[] = {{'a', "code model of XSPICE"},
                                                           {'j', "junction field-effect transistor"},
                                                           {'n', "compiled Verilog-A model"},
                                                           {'o', "lossy line"},
                                                           {'p', "coupled lines"},
                                                           {'t', "lossless line"},
                                                           {'u', "RC line or gate"},
                                                           {'y', "device of Xyce"},
                                                           {'z', "MESFET"}};
    const auto* found = std::ranges::find(names, letter, &std::pair<char, std::string_view>::first);
    return found == std::end(names) ? "" : found->second;
}

bool is_element_letter(char letter) { return letter == 'x' || find_device_kind(letter) != nullptr; }

/// True for the values that may contain blanks: the expressions of sources and of a capacitor's charge. See split_element().
bool is_long_value(char letter, std::string_view name) {
    const auto* kind = find_device_kind(letter);
    return kind != nullptr && std::find(kind->expression_names.begin(), kind->expression_names.end(), name) != kind->expression_names.end();
}

void refuse_letter(const LogicalLine& line, Refusals& refusals) {
    const std::string name = line.text.substr(0, std::min<std::size_t>(line.text.find_first_of(" \t"), 20));
    const auto device = foreign_device(name[0]);
    refusals.add_device(error_at(line.location(), "'{}': unknown element letter {}{}; known are {}", name, name[0],
                                 device.empty() ? "" : fmt::format(" ({})", device), element_letters()),
                        fmt::format("letter {}", name[0]), name);
}

}  // namespace

Result<std::optional<Statement>> split_element_line(LogicalLine line, Refusals& refusals) {
    if (!is_element_letter(line.text[0])) {
        refuse_letter(line, refusals);
        return std::optional<Statement>();
    }
    auto read = TRY(split_element(std::move(line), is_long_value));
    TRY(check_duplicates(read));
    return std::optional(std::move(read));
}

bool looks_like_statement(std::string_view title) {
    std::vector<std::string> words;
    for (std::size_t at = title.find_first_not_of(" \t"); at != std::string_view::npos && words.size() < 5;) {
        const auto end = std::min(title.find_first_of(" \t", at), title.size());
        words.push_back(lower(title.substr(at, end - at)));
        at = title.find_first_not_of(" \t", end);
    }
    if (words.empty()) return false;
    if (words[0][0] == '.') return true;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const auto is_in_name = [&](char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || c == '_'; };
    if (words.size() < 4 || words[0].size() < 2 || !is_element_letter(words[0][0])) return false;
    if (!std::ranges::all_of(words[0], is_in_name) || !std::ranges::any_of(words[0], is_digit)) return false;
    if (parse_number(words[3]) || words[3].find_first_of("{'=") != std::string::npos) return true;
    // A device with a model: several of its nodes are numbers or ground, or it has name=value.
    const auto is_element_word = [&](const std::string& word) {
        return is_digit(word[0]) || is_ground(word) || word.find_first_of("={") != std::string::npos;
    };
    const bool is_source = words[3] == "dc" || words[3] == "ac" || words[3].starts_with("pulse") || words[3].starts_with("sin(");
    return is_source || std::count_if(words.begin() + 1, words.end(), is_element_word) >= 2;
}

}  // namespace corpuscle::circuit
