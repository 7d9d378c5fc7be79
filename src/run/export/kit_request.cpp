#include "run/export/kit_request.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "circuit/export/kit_card.hpp"
#include "core/text/printable.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

/// The path of the kit's file in the deck. ngspice takes it as relative to the folder of the deck, wherever it runs; without the name of
/// the deck it is absolute. Folders are resolved, so that ".." leads back through links; the file may be a link.
Result<fs::path> path_in_deck(const std::string& card, const std::string& deck) {
    std::error_code failure;
    const auto folder_of = [&](const fs::path& file) { return fs::weakly_canonical(fs::absolute(file, failure).parent_path(), failure); };
    const fs::path given = card;
    auto out = given;
    if (!given.is_absolute()) out = folder_of(given) / given.filename();
    if (!given.is_absolute() && !deck.empty()) out = out.lexically_relative(folder_of(deck));
    const auto text = out.string();
    if (text.find_first_of("'\"\n\r{};") == std::string::npos && text.find(" $") == std::string::npos) return out;
    return bad_input(
        fmt::format("--card '{}': ngspice reads no path with a quote, a brace, ';', ' $' or a line break; name a link to it, or a copy",
                    printable(text)));
}

/// Sets the devices of a map to those that are named.
Result<void> name_devices(const KitRequest& request, circuit::KitMap& map) {
    const std::pair<std::string_view, const std::string*> given[] = {
        {"--nch", &request.nch}, {"--pch", &request.pch}, {"--hv-nch", &request.hv_nch}, {"--hv-pch", &request.hv_pch}};
    for (std::size_t k = 0; k < std::size(given); ++k) {
        if (given[k].second->empty()) continue;
        TRY(circuit::check_kit_name(given[k].first, *given[k].second));
        map.devices[k] = *given[k].second;
    }
    return {};
}

}  // namespace

std::string_view KitRequest::first_option() const {
    const std::pair<std::string_view, const std::string*> options[] = {{"--card", &card}, {"--map", &map},       {"--nch", &nch},
                                                                       {"--pch", &pch},   {"--hv-nch", &hv_nch}, {"--hv-pch", &hv_pch}};
    for (const auto& [name, value] : options)
        if (!value->empty()) return name;
    return "";
}

Result<circuit::Kit> read_kit(const KitRequest& names, const std::string& deck) {
    if (names.card.empty()) return bad_usage(fmt::format("{} needs --card FILE, the file of the kit", names.first_option()));
    circuit::Kit kit;
    kit.map = TRY(circuit::read_kit_map(names.map.empty() ? "plain" : names.map));
    TRY(name_devices(names, kit.map));
    TRY(circuit::check_card(kit.map, names.card));
    const auto path = TRY(path_in_deck(names.card, deck));
    kit.card = path.string(), kit.folder = path.has_parent_path() ? path.parent_path().string() : ".";
    return kit;
}

}  // namespace corpuscle
