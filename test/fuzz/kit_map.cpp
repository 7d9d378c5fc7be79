// Arbitrary text as the map of a kit, and the text after a line of only '=' as the kit's file. Expected: a map whose lines are single lines
// of allowed directives and whose names are words, or an error with a message.

#include <cstdint>
#include <cstdlib>

#include "circuit/export/kit_card.hpp"
#include "require.hpp"

using namespace corpuscle;
using namespace corpuscle::circuit;
using corpuscle::fuzz::require;

namespace {

void check_lines(const std::vector<std::string>& lines) {
    for (const auto& line : lines) {
        const auto filled = fill_kit_line(line, {"a card.lib", ".", "tt"});
        require(filled && filled->find('\n') == std::string::npos && (line[0] == '.' || line[0] == '*'));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto divider = std::min(text.find("\n=\n"), size);
    const auto map = parse_kit_map(text.substr(0, divider), "kit.toml");
    if (!map) {
        require(!map.error().message.empty());
        return 0;
    }
    require(map->length_unit > 0);
    for (const auto* lines : {&map->lines, &map->mismatch_lines, &map->last_lines}) check_lines(*lines);
    for (const auto& name : map->devices) require(name.find_first_of(" \t\n\r'\"") == std::string::npos);
    const auto found = check_devices_in_card(*map, text.substr(divider), "card.lib");
    require(found || !found.error().message.empty());
    return 0;
}
