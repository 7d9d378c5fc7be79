#include "circuit/own_currents.hpp"

namespace corpuscle::circuit {

OwnCurrents::OwnCurrents(const System& system, std::span<const Saved> all) : system_(system) {
    for (const auto& s : all)
        if (s.device >= 0) currents_.push_back(s);
}

void OwnCurrents::add_to(Plot& head) const {
    for (const auto& s : currents_) head.curves.push_back({s.name, "current", {}});
}

std::span<const double> OwnCurrents::point(std::span<const double> row) {
    if (currents_.empty()) return row;
    row_.assign(row.begin(), row.end());
    for (const auto& s : currents_)
        row_.push_back(s.seen(system_, [&](int u) { return u < 0 ? 0 : row[static_cast<std::size_t>(u) + 1]; }));
    return row_;
}

bool OwnCurrents::has_all_unknowns(const Plot& plot) const {
    const auto& names = system_.names();
    if (plot.is_complex || plot.curves.size() != names.size() + plot.swept) return false;
    if (plot.swept && plot.curves[0].name == "temp-sweep") return false;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (plot.curves[k + plot.swept].name != names[k]) return false;
    return true;
}

bool OwnCurrents::complete(Plot& plot) const {
    if (currents_.empty()) return true;
    if (!has_all_unknowns(plot)) return false;
    const auto points = plot.points();
    std::vector<Curve> more;
    for (const auto& s : currents_) {
        Curve curve{s.name, "current", {}};
        for (std::size_t p = 0; p < points; ++p)
            curve.values.emplace_back(
                s.seen(system_, [&](int u) { return u < 0 ? 0 : plot.curves[static_cast<std::size_t>(u) + plot.swept].values[p].real(); }));
        more.push_back(std::move(curve));
    }
    plot.curves.insert(plot.curves.end(), more.begin(), more.end());
    return true;
}

}  // namespace corpuscle::circuit
