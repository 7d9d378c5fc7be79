// Reads the units of an NWB file (Neurodata Without Borders): the spike times of each, and a name from one of the columns.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "helper_main.hpp"
#include "io/nwb/nwb_messages.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"
#include "nwb_table.hpp"

namespace corpuscle {
namespace {

constexpr std::uint64_t max_spikes = std::uint64_t{1} << 26;  // of all units: 512 MB
constexpr std::uint64_t max_units = std::uint64_t{1} << 24;

/// Reads the columns of /units.
class UnitsReader {
    NwbTable table_;

    Error bad(std::string message) const { return table_.bad(std::move(message)); }

    /// The names of the columns that can name units.
    std::vector<std::string> column_names() const {
        auto names = table_.column_names();
        std::erase_if(names, [&](const auto& name) { return name == "spike_times" || table_.find(name)->shape.size() != 1; });
        return names;
    }

    /// The spike times of each unit. The index has the end of each unit in the list of all times.
    Result<std::vector<NwbUnit>> trains() const {
        if (!table_.find("spike_times")) return bad("the units of this file have no spike_times");
        const auto times = TRY(table_.reals("spike_times", max_spikes));
        const auto ends = TRY(table_.integers("spike_times_index", max_units));
        std::vector<NwbUnit> units(ends.size());
        std::int64_t begin = 0;
        for (std::size_t u = 0; u < ends.size(); ++u) {
            if (ends[u] < begin || ends[u] > static_cast<std::int64_t>(times.size()))
                return bad(fmt::format("/units/spike_times_index: element {} is {}, which is not between {} and {}", u, ends[u], begin,
                                       times.size()));
            units[u].times.assign(times.begin() + begin, times.begin() + ends[u]);
            begin = ends[u];
        }
        return units;
    }

    Result<void> check_times(const std::vector<NwbUnit>& units) const {
        for (const auto& u : units)
            for (const double t : u.times)
                if (!std::isfinite(t)) return bad(fmt::format("unit {} has a spike time that is not finite: {}", u.name, t));
        return {};
    }

    /// Names the units after a column, and after `channels` if it is not "". Returns an error if two units have the same names.
    Result<void> name_units(std::vector<NwbUnit>& units, const std::string& column, const std::string& channels) const {
        const auto names = TRY(table_.texts(column, max_units));
        const auto places = channels.empty() ? std::vector<std::string>() : TRY(table_.texts(channels, max_units));
        if (names.size() != units.size() || (!channels.empty() && places.size() != units.size()))
            return bad(fmt::format("/units has {} units, but its column '{}' has {} elements", units.size(),
                                   names.size() != units.size() ? column : channels,
                                   names.size() != units.size() ? names.size() : places.size()));
        std::set<std::pair<std::string_view, std::string_view>> all;
        for (std::size_t u = 0; u < units.size(); ++u) {
            units[u].name = names[u], units[u].channel = channels.empty() ? "" : places[u];
            if (!all.emplace(units[u].name, units[u].channel).second)
                return bad(
                    fmt::format("several units have '{}' in the column '{}'; select a column with different values, such as --train "
                                "id. Columns: {}",
                                names[u], column, fmt::join(column_names(), ", ")));
        }
        return {};
    }

public:
    UnitsReader(const hdf5::Handle& file, const std::string& path) : table_(file, "/units", path) {}

    /// `label`: the column that names the units. "": the columns of Corpuscle (afferent, channel), or unit_name, or id.
    Result<std::vector<NwbUnit>> read(const std::string& label) const {
        if (table_.is_empty()) return bad("this NWB file has no units, and so no spikes");
        auto units = TRY(trains());
        if (!label.empty() && !table_.find(label))
            return bad(fmt::format("--train {}: there is no such column of units. Columns: {}", label, fmt::join(column_names(), ", ")));
        if (!label.empty())
            TRY(name_units(units, label, ""));
        else if (table_.find("afferent") && table_.find("channel"))
            TRY(name_units(units, "afferent", "channel"));
        else if (!table_.find("unit_name") || !name_units(units, "unit_name", ""))
            TRY(name_units(units, "id", ""));
        TRY(check_times(units));
        return units;
    }
};

}  // namespace

Result<std::vector<NwbUnit>> read_nwb_units(int descriptor, const UnitsRequest& request) {
    const auto file = TRY(hdf5::open_file(descriptor, request.path));
    TRY(check_is_nwb(file, "spikes", request.path));
    return UnitsReader(file, request.path).read(request.label);
}

HelperService units_service() { return request_service<UnitsRequest>(HelperProcess::units_protocol, read_nwb_units); }

}  // namespace corpuscle
