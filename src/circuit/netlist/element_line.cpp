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
    if (words.size() < 4 || words[0].size() < 2 || !is_element_letter(words[0][0])) return false;
    if (!std::any_of(words[0].begin(), words[0].end(), [](char c) { return c >= '0' && c <= '9'; })) return false;
    return words.size() == 5 || parse_number(words[3]) || words[3].find_first_of("{'=") != std::string::npos;
}

}  // namespace corpuscle::circuit
