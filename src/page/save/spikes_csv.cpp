#include <map>

#include "core/text/csv_field.hpp"
#include "page/save/saved_spikes.hpp"
#include "run/sinks/spike_lines.hpp"

namespace corpuscle::page {

UnitNames unit_names(const SavedSpikes& saved) {
    UnitNames out;
    std::map<std::string, int> count;
    for (const auto& row : saved.rows) {
        const auto& name = row.plan().name;
        const int number = ++count[name];
        out.afferents.push_back(number > 1 ? fmt::format("{}#{}", name, number) : name), out.channels.emplace_back("force");
    }
    const auto* skin = saved.skin;
    for (std::size_t u = 0; skin && u < skin->afferents.size(); ++u)
        out.afferents.push_back(skin->afferent_name(u)), out.channels.push_back(skin->plan.sites.regions[skin->afferents[u].region]);
    return out;
}

std::string spikes_csv(const SavedSpikes& saved) {
    const auto names = unit_names(saved);
    std::vector<std::string> fields;
    for (std::size_t u = 0; u < names.afferents.size(); ++u)
        fields.push_back(quote_csv_field(names.afferents[u]) + "," + quote_csv_field(names.channels[u]));
    fmt::memory_buffer text;
    text.append(spike_lines_heading);
    for (const auto& s : saved.spikes) append_spike_line(text, fields[s.afferent_index], s, saved.clock);
    return fmt::to_string(text);
}

}  // namespace corpuscle::page
