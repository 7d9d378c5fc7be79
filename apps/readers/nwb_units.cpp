// Reads the units of an NWB file (Neurodata Without Borders): the spike times of each, and a name from one of the columns.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "hdf5_file.hpp"
#include "helper_main.hpp"
#include "io/nwb/hdf5_messages.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"
#include "nwb_series.hpp"

namespace corpuscle {
namespace {

using hdf5::Handle;

constexpr std::uint64_t max_spikes = std::uint64_t{1} << 26;  // of all units: 512 MB
constexpr std::uint64_t max_units = std::uint64_t{1} << 24;

/// Reads the columns of /units.
class UnitsReader {
    const Handle& file_;
    const std::string& path_;
    std::vector<ArrayInfo> columns_;  // the datasets in /units, with their complete paths

    Error bad(std::string message) const { return bad_input(std::move(message), {path_}); }
    Error damaged(const std::string& name) const { return bad(fmt::format("cannot read {}; the file may be damaged", name)); }

    const ArrayInfo* find(const std::string& column) const {
        for (const auto& c : columns_)
            if (c.name == "/units/" + column) return &c;
        return nullptr;
    }

    /// A column of one dimension, with at most `limit` elements; its data exist.
    Result<Handle> open(const std::string& column, std::uint64_t limit) const {
        const auto* info = find(column);
        if (!info) return bad(fmt::format("/units has no column '{}'", column));
        if (info->shape.size() != 1) return bad(fmt::format("{} must have one dimension", describe(*info)));
        if (info->shape[0] > limit) return bad(fmt::format("{}: more than {} elements", describe(*info), limit));
        auto dataset = hdf5::open_dataset(file_, info->name);
        if (!dataset) return damaged(info->name);
        if (info->shape[0] > 0) TRY(hdf5::check_storage(dataset, *info, path_));
        return dataset;
    }

    template <class T>
    Result<std::vector<T>> numbers(const std::string& column, hid_t memory, std::uint64_t limit) const {
        const auto dataset = TRY(open(column, limit));
        if (!find(column)->is_numeric) return bad(fmt::format("{}: numbers are expected", describe(*find(column))));
        std::vector<T> out(find(column)->shape[0]);
        const Handle type(H5Dget_type(dataset), H5Tclose);
        if (!hdf5::is_number(type) || (!out.empty() && H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0))
            return damaged(find(column)->name);
        return out;
    }

    /// The texts of a column of texts or numbers.
    Result<std::vector<std::string>> texts(const std::string& column) const {
        if (find(column) && find(column)->is_numeric) {
            std::vector<std::string> out;
            for (const double x : TRY(numbers<double>(column, H5T_NATIVE_DOUBLE, max_units))) out.push_back(fmt::format("{}", x));
            return out;
        }
        const auto dataset = TRY(open(column, max_units));
        auto out = hdf5::strings_in(dataset);
        if (out.size() != find(column)->shape[0]) return damaged(find(column)->name);
        return out;
    }

    std::vector<std::string> column_names() const {
        std::vector<std::string> out;
        for (const auto& c : columns_)
            if (!c.name.ends_with("_index") && c.shape.size() == 1 && c.name != "/units/spike_times")
                out.push_back(c.name.substr(std::string_view("/units/").size()));
        return out;
    }

    /// The spike times of each unit. The index has the end of each unit in the list of all times.
    Result<std::vector<NwbUnit>> trains() const {
        if (!find("spike_times")) return bad("the units of this file have no spike_times");
        const auto times = TRY(numbers<double>("spike_times", H5T_NATIVE_DOUBLE, max_spikes));
        const auto ends = TRY(numbers<std::int64_t>("spike_times_index", H5T_NATIVE_INT64, max_units));
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
        const auto names = TRY(texts(column)), places = channels.empty() ? std::vector<std::string>() : TRY(texts(channels));
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
    UnitsReader(const Handle& file, const std::string& path) : file_(file), path_(path) {
        for (auto& array : hdf5::datasets_in(file))
            if (array.name.starts_with("/units/") && array.name.find('/', 7) == std::string::npos) columns_.push_back(std::move(array));
    }

    /// `label`: the column that names the units. "": the columns of Corpuscle (afferent, channel), or unit_name, or id.
    Result<std::vector<NwbUnit>> read(const std::string& label) const {
        if (columns_.empty()) return bad("this NWB file has no units, and so no spikes");
        auto units = TRY(trains());
        if (!label.empty() && !find(label))
            return bad(fmt::format("--train {}: there is no such column of units. Columns: {}", label, fmt::join(column_names(), ", ")));
        if (!label.empty())
            TRY(name_units(units, label, ""));
        else if (find("afferent") && find("channel"))
            TRY(name_units(units, "afferent", "channel"));
        else if (!find("unit_name") || !name_units(units, "unit_name", ""))
            TRY(name_units(units, "id", ""));
        TRY(check_times(units));
        return units;
    }
};

}  // namespace

Result<std::vector<NwbUnit>> read_nwb_units(int descriptor, const UnitsRequest& request) {
    const auto file = TRY(hdf5::open_file(descriptor, request.path));
    if (!is_nwb(file))
        return bad_input(
            "this HDF5 file is not an NWB file, the only HDF5 format with spikes that is read: its root has no attribute neurodata_type = "
            "NWBFile",
            {request.path});
    return UnitsReader(file, request.path).read(request.label);
}

namespace {

void serve_units(int socket, int file) {
    std::string m;
    UnitsRequest request;
    if (!next_request(socket, m) || !decode(m, request)) return;
    reply_safely(socket, request.path, [&] {
        const auto units = read_nwb_units(file, request);
        return units ? encode(*units) : encode(units.error());
    });
}

}  // namespace

HelperService units_service() { return {HelperProcess::units_protocol, FileAccess::read, serve_units}; }

}  // namespace corpuscle
