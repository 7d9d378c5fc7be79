#include "study/orders.hpp"

#include <algorithm>

#include "circuit/analyses.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

bool is_order(std::string_view line) {
    if (!line.starts_with('.')) return false;
    const auto word = lower(line.substr(1, line.find_first_of(" \t\r") - 1));
    constexpr std::string_view others[] = {"meas", "measure", "print", "plot", "save", "step", "mc", "expect", "end"};
    return circuit::analysis_of(word) != nullptr || std::find(std::begin(others), std::end(others), word) != std::end(others);
}

}  // namespace

std::string with_orders(const std::string& text, const std::string& orders) {
    std::string out;
    bool left_out = false, first = true;
    for (std::size_t at = 0; at < text.size();) {
        const auto end = std::min(text.find('\n', at), text.size());
        const auto line = std::string_view(text).substr(at, end - at);
        if (!line.starts_with('+')) left_out = !first && is_order(line);
        if (!left_out) out += line;
        out += '\n';
        first = false, at = end + 1;
    }
    return out + orders + "\n.end\n";
}

}  // namespace corpuscle
