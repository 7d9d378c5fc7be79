#include "circuit/output/device_currents.hpp"

namespace corpuscle::circuit {

DeviceCurrents::DeviceCurrents(const System& system, std::span<const SavedQuantity> all) : system_(system) {
    for (const auto& s : all)
        if (s.device_index >= 0) currents_.push_back(s);
}

void DeviceCurrents::extend_head(Plot& head) const {
    for (const auto& s : currents_) head.curves.push_back({s.name, "current", {}});
}

std::span<const double> DeviceCurrents::extend_point(std::span<const double> row) {
    if (currents_.empty()) return row;
    row_.assign(row.begin(), row.end());  // row[0] is the swept quantity, row[u + 1] the unknown u
    for (const auto& s : currents_)
        row_.push_back(s.value(system_, [&](int u) { return u < 0 ? 0 : row[static_cast<std::size_t>(u) + 1]; }));
    return row_;
}

bool DeviceCurrents::has_all_unknowns(const Plot& plot) const {
    const auto& names = system_.names();
    if (plot.is_complex || plot.curves.size() != names.size() + plot.has_sweep) return false;
    if (plot.has_sweep && plot.curves[0].name == "temp-sweep") return false;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (plot.curves[k + plot.has_sweep].name != names[k]) return false;
    return true;
}

bool DeviceCurrents::extend_plot(Plot& plot) const {
    if (currents_.empty()) return true;
    if (!has_all_unknowns(plot)) return false;
    const auto points = plot.point_count();
    std::vector<Curve> more;
    for (const auto& s : currents_) {
        Curve curve{s.name, "current", {}};
        for (std::size_t p = 0; p < points; ++p)
            curve.values.emplace_back(s.value(
                system_, [&](int u) { return u < 0 ? 0 : plot.curves[static_cast<std::size_t>(u) + plot.has_sweep].values[p].real(); }));
        more.push_back(std::move(curve));
    }
    plot.curves.insert(plot.curves.end(), more.begin(), more.end());
    return true;
}

}  // namespace corpuscle::circuit
