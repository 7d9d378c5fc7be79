#include "run/summary/grouped_notes.hpp"

#include <fmt/format.h>
#include <map>

#include "core/text/ascii_text.hpp"

namespace corpuscle {

std::vector<std::string> grouped_notes(std::span<const std::string> notes) {
    std::vector<std::string> out;
    std::vector<std::size_t> counts, name_ends;
    std::map<std::string, std::size_t> index_of;  // by text, with its colon
    for (const auto& note : notes) {
        const auto colon = note.find(": ");
        const auto [at, is_new] = colon == note.npos ? index_of.try_emplace(note, out.size()) : index_of.try_emplace(note.substr(colon), out.size());
        if (is_new || colon == note.npos)
            out.push_back(note), counts.push_back(1), name_ends.push_back(colon);
        else
            ++counts[at->second];
    }
    for (std::size_t k = 0; k < out.size(); ++k)
        if (counts[k] > 1) out[k].insert(name_ends[k], fmt::format(" and {} more", counts[k] - 1));
    return out;
}

std::string short_list(std::span<const std::string> names) {
    constexpr std::size_t shown = 3;
    if (names.size() <= shown + 1) return joined(names);
    return joined(names.first(shown)) + fmt::format(" and {} more", names.size() - shown);
}

}  // namespace corpuscle
