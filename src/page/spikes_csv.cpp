#include "page/spikes_csv.hpp"

#include <map>

#include "core/text/csv_field.hpp"
#include "run/sinks/spike_lines.hpp"

namespace corpuscle::page {
namespace {

/// Names of afferent and channel of each unit. A second row of the same afferent is called "sa1#2".
std::vector<std::string> unit_names(std::span<const Row> rows, const Innervation* skin) {
    std::vector<std::string> out;
    std::map<std::string, int> count;
    for (const auto& row : rows) {
        const auto& name = row.plan().name;
        const int number = ++count[name];
        out.push_back(quote_csv_field(number > 1 ? fmt::format("{}#{}", name, number) : name) + ",force");
    }
    for (std::size_t u = 0; skin && u < skin->afferents.size(); ++u)
        out.push_back(quote_csv_field(skin->afferent_name(u)) + "," + quote_csv_field(skin->plan.sites.regions[skin->afferents[u].region]));
    return out;
}

}  // namespace

std::string spikes_csv(std::span<const Row> rows, const Innervation* skin, std::span<const Spike> spikes, const Clock& clock) {
    const auto names = unit_names(rows, skin);
    fmt::memory_buffer text;
    text.append(spike_lines_heading);
    for (const auto& s : spikes) append_spike_line(text, names[s.afferent_index], s, clock);
    return fmt::to_string(text);
}

}  // namespace corpuscle::page
