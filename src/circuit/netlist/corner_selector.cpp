#include "circuit/netlist/corner_selector.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/netlist/statement.hpp"
#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The names of the sections that the text of a library defines.
std::vector<std::string> sections_in(std::string_view text) {
    std::vector<std::string> out;
    LogicalLineReader lines(text, std::make_shared<const std::string>());
    LogicalLine line;
    for (auto more = lines.next(line); more && *more; more = lines.next(line)) {
        if (lower(std::string_view(line.text).substr(0, 4)) != ".lib") continue;
        // ".lib section" begins a section; ".lib file section" reads another file.
        const auto head = split_directive(std::move(line));
        if (head && head->words.size() == 2) out.push_back(lower(unquoted(head->text(1))));
    }
    return out;
}

}  // namespace

std::string CornerSelector::select_section(const std::string& section, std::string_view library, std::string_view text) {
    if (corner_.empty()) return section;
    const auto known = sections_in(text);
    if (std::find(known.begin(), known.end(), corner_) != known.end()) return is_found_ = true, corner_;
    const std::vector<std::string_view> names(known.begin(), known.end());
    libraries_.push_back(fmt::format("'{}' has {}{}", library, fmt::join(known, ", "), did_you_mean(corner_, names)));
    return section;
}

Result<void> CornerSelector::check_found(const std::string& netlist) const {
    if (corner_.empty() || is_found_) return {};
    if (libraries_.empty()) return error_at({netlist}, "there is no corner '{}': the netlist has no line .lib 'file' section", corner_);
    return error_at({netlist}, "no corner '{}': library {}", corner_, fmt::join(libraries_, "; "));
}

}  // namespace corpuscle::circuit
