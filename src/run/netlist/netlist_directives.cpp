#include "run/netlist/netlist_directives.hpp"

#include <algorithm>

#include "circuit/analyses.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

bool is_removed_directive(std::string_view line) {
    if (!line.starts_with('.')) return false;
    const auto name = lower(line.substr(1, line.find_first_of(" \t\r") - 1));
    constexpr std::string_view other_directives[] = {"meas", "measure", "print", "plot", "save", "step", "mc", "expect", "end"};
    return circuit::find_analysis(name) != nullptr ||
           std::find(std::begin(other_directives), std::end(other_directives), name) != std::end(other_directives);
}

}  // namespace

std::string with_directives(const std::string& text, const std::string& directives) {
    std::string out;
    bool removed = false, first = true;
    for (std::size_t at = 0; at < text.size();) {
        const auto end = std::min(text.find('\n', at), text.size());
        const auto line = std::string_view(text).substr(at, end - at);
        // The first line is the title. A line that begins with + continues the line before it.
        if (!line.starts_with('+')) removed = !first && is_removed_directive(line);
        if (!removed) out += line;
        out += '\n';
        first = false, at = end + 1;
    }
    return out + directives + "\n.end\n";
}

}  // namespace corpuscle
