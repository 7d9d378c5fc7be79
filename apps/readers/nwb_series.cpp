#include "nwb_series.hpp"

#include <fmt/format.h>

#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

struct Series {
    std::size_t index = 0;  // of its data among the arrays
    std::string unit{};     // "" if it states none
};

/// True for a unit of force: N, mN, newtons.
bool is_force_unit(const std::string& unit) {
    if (unit == "newton" || unit == "newtons" || unit == "Newton" || unit == "Newtons") return true;
    return !unit.empty() && parse_quantity("1 " + unit, "N");
}

/// All time series whose data can be a recording: groups with a type of NWB and numbers in one or two dimensions called `data`.
std::vector<Series> series_in(hid_t file, std::span<const ArrayInfo> arrays) {
    std::vector<Series> out;
    for (std::size_t k = 0; k < arrays.size(); ++k) {
        const auto& a = arrays[k];
        if (!a.name.ends_with("/data") || !a.is_numeric || a.shape.empty() || a.shape.size() > 2) continue;
        const hdf5::Handle group(H5Oopen(file, a.name.substr(0, a.name.size() - 5).c_str(), H5P_DEFAULT), H5Oclose);
        if (!group || !hdf5::text_attribute(group, "neurodata_type")) continue;
        const auto data = hdf5::open_dataset(file, a.name);
        out.push_back({k, data ? hdf5::text_attribute(data, "unit").value_or("") : ""});
    }
    return out;
}

std::string list_of(const std::vector<Series>& all, std::span<const ArrayInfo> arrays) {
    constexpr std::size_t limit = 24;
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < all.size() && k < limit; ++k) {
        auto group = arrays[all[k].index];
        group.name.resize(group.name.size() - 5);
        texts.push_back(fmt::format("{}{}", describe(group), all[k].unit.empty() ? "" : fmt::format(" in {}", all[k].unit)));
    }
    return fmt::format("{}{}", fmt::join(texts, ", "), all.size() > limit ? " ..." : "");
}

}  // namespace

bool is_nwb(hid_t file) { return hdf5::text_attribute(file, "neurodata_type") == "NWBFile"; }

Result<std::optional<std::size_t>> choose_force_series(hid_t file, std::span<const ArrayInfo> arrays, const std::string& path) {
    const auto all = series_in(file, arrays);
    std::vector<Series> forces;
    for (const auto& s : all)
        if (is_force_unit(s.unit)) forces.push_back(s);
    if (forces.size() == 1) return std::optional(forces[0].index);
    if (forces.size() > 1)
        return bad_input(fmt::format("several time series are in newtons; select one with --dataset NAME: {}", list_of(forces, arrays)),
                         {path});
    if (all.size() == 1) return std::optional(all[0].index);
    if (all.size() > 1)
        return bad_input(
            fmt::format("no time series is in newtons; select one with --dataset NAME, and give its unit with --unit or --scale: "
                        "{}",
                        list_of(all, arrays)),
            {path});
    return std::optional<std::size_t>();
}

}  // namespace corpuscle
