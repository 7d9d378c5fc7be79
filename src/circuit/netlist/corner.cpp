#include "circuit/netlist/corner.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/netlist/statement.hpp"
#include "signal/field.hpp"
#include "signal/text.hpp"

namespace corpuscle::circuit {
namespace {

/// The sections that a library's text has, but for those that only others of it read.
std::vector<std::string> sections_in(std::string_view text) {
    std::vector<std::string> out;
    Lines lines(text, std::make_shared<const std::string>());
    Line line;
    for (auto more = lines.next(line); more && *more; more = lines.next(line)) {
        if (lower(std::string_view(line.text).substr(0, 4)) != ".lib") continue;
        const auto head = command_statement(std::move(line));
        if (head && head->words.size() == 2) out.push_back(lower(unquoted(head->text(1))));
    }
    return out;
}

}  // namespace

std::string Corner::in_place_of(const std::string& section, std::string_view library, std::string_view text) {
    if (wanted_.empty()) return section;
    const auto known = sections_in(text);
    if (std::find(known.begin(), known.end(), wanted_) != known.end()) return found_ = true, wanted_;
    const std::vector<std::string_view> names(known.begin(), known.end());
    libraries_.push_back(fmt::format("'{}' has {}{}", library, fmt::join(known, ", "), did_you_mean(wanted_, names)));
    return section;
}

Result<void> Corner::found(const std::string& netlist) const {
    if (wanted_.empty() || found_) return {};
    if (libraries_.empty())
        return bad_input(fmt::format("no line .lib 'file' section, so there is no corner '{}' to be had", wanted_), {netlist});
    return bad_input(fmt::format("no corner '{}': library {}", wanted_, fmt::join(libraries_, "; ")), {netlist});
}

}  // namespace corpuscle::circuit
