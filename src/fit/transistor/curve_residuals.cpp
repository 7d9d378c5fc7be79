#include "fit/transistor/curve_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace corpuscle {

using namespace circuit;

namespace {

/// A junction conducts above this voltage, V: below it, its current is less than that of other leakage.
constexpr double forward_voltage = 0.1;

UicmInstance shifted(UicmInstance instance, const DeviceShift& shift) {
    instance.delvto = shift.V_T, instance.mulu0 = num::exp(shift.log_I_S);
    return instance;
}

}  // namespace

std::vector<PointGroup> group_points(const IvData& data) {
    std::map<std::pair<std::uint32_t, double>, std::size_t> known;
    std::vector<PointGroup> out;
    for (std::size_t k = 0; k < data.points.size(); ++k) {
        const auto& p = data.points[k];
        const auto [at, is_new] = known.try_emplace({p.device, p.temperature}, out.size());
        if (is_new) out.push_back({p.device, p.temperature, {}, {}});
        out[at->second].points.push_back(k), out[at->second].voltages.push_back(p.v);
    }
    return out;
}

bool has_junction_current(const IvData& data, const IvPoint& p) {
    const double polarity = data.is_pmos ? -1 : 1, forward = std::max(polarity * (p.v[3] - p.v[0]), polarity * (p.v[3] - p.v[2]));
    return !std::isnan(p.I_B) && forward > forward_voltage;
}

CurveResiduals::CurveResiduals(const IvData& data)
    : data_(data), groups_(group_points(data)), groups_of_device_(data.devices.size()), shifts(data.devices.size()) {
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_of_device_[groups_[g].device].push_back(g);
    for (std::size_t k = 0; k < data.points.size(); ++k)
        if (has_junction_current(data, data.points[k])) bulk_points_.push_back(k);
    std::vector<DrainBulkCurrents> measured;
    for (const auto& p : data.points) measured.push_back({p.I_D, std::isnan(p.I_B) ? 0 : p.I_B});
    set_deviations(measured);
}

UicmInstance CurveResiduals::instance(std::uint32_t device) const {
    UicmInstance out;
    out.W = data_.devices[device].W, out.L = data_.devices[device].L;
    return shifted(out, shifts[device]);
}

std::vector<DrainBulkCurrents> CurveResiduals::currents(const UicmCard& card) const {
    std::vector<DrainBulkCurrents> out(data_.points.size()), group;
    for (const auto& g : groups_) {
        group.resize(g.points.size());
        uicm_currents(uicm_constants(card, instance(g.device), g.temperature, data_.is_pmos), g.voltages, group);
        for (std::size_t k = 0; k < g.points.size(); ++k) out[g.points[k]] = group[k];
    }
    return out;
}

void CurveResiduals::set_deviations(const std::vector<DrainBulkCurrents>& currents) {
    drain_deviation.clear(), bulk_deviation.clear();
    for (const auto& i : currents) {
        drain_deviation.push_back(std::sqrt(drain_noise.variance(i.I_D)));
        bulk_deviation.push_back(std::sqrt(bulk_noise.variance(i.I_B)));
    }
}

SlopedResiduals CurveResiduals::residuals(const UicmCard& base, std::span<const CardParameter* const> parameters, const Vector& x,
                                          bool with_slopes) const {
    const auto n = data_.points.size(), all = n + bulk_points_.size();
    SlopedResiduals out;
    out.values.resize(all);
    const auto card = card_at(base, parameters, x);
    const auto put = [&](const std::vector<DrainBulkCurrents>& of, Vector& to, double sign, bool is_value) {
        for (std::size_t k = 0; k < n; ++k) to[k] = ((is_value ? data_.points[k].I_D : 0) + sign * of[k].I_D) / drain_deviation[k];
        for (std::size_t b = 0; b < bulk_points_.size(); ++b) {
            const auto k = bulk_points_[b];
            to[n + b] = ((is_value ? data_.points[k].I_B : 0) + sign * of[k].I_B) / bulk_deviation[k];
        }
    };
    put(currents(card), out.values, -1, true);
    if (!with_slopes) return out;
    std::vector<DrainBulkCurrents> slopes(n), group;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        const double h = parameters[j]->difference;
        auto below = x, above = x;
        below[j] -= h, above[j] += h;
        const auto low = card_at(base, parameters, below), high = card_at(base, parameters, above);
        for (const auto& g : groups_) {
            const auto constants = [&](const UicmCard& one) {
                return uicm_constants(one, instance(g.device), g.temperature, data_.is_pmos);
            };
            group.resize(g.points.size());
            uicm_slopes(constants(low), constants(card), constants(high), 2 * h, g.voltages, group);
            for (std::size_t k = 0; k < g.points.size(); ++k) slopes[g.points[k]] = group[k];
        }
        out.slopes.emplace_back(all);
        put(slopes, out.slopes.back(), -1, false);
    }
    return out;
}

SlopedResiduals CurveResiduals::device_residuals(const UicmCard& card, std::uint32_t device, const Vector& shift, bool with_slopes) const {
    SlopedResiduals out;
    if (with_slopes) out.slopes.resize(2);
    std::vector<DrainBulkCurrents> group;
    for (const auto index : groups_of_device_[device]) {
        const auto& g = groups_[index];
        group.resize(g.points.size());
        const auto constants = [&](double V_T, double log_I_S) {
            return uicm_constants(card, shifted(instance(device), {V_T, log_I_S}), g.temperature, data_.is_pmos);
        };
        const auto at = constants(shift[0], shift[1]);
        uicm_currents(at, g.voltages, group);
        for (std::size_t k = 0; k < g.points.size(); ++k)
            out.values.push_back((data_.points[g.points[k]].I_D - group[k].I_D) / drain_deviation[g.points[k]]);
        for (std::size_t j = 0; j < 2 && with_slopes; ++j) {
            constexpr double h = 1e-4;
            const double V = j == 0 ? h : 0, I = j == 1 ? h : 0;
            uicm_slopes(constants(shift[0] - V, shift[1] - I), at, constants(shift[0] + V, shift[1] + I), 2 * h, g.voltages, group);
            for (std::size_t k = 0; k < g.points.size(); ++k) out.slopes[j].push_back(-group[k].I_D / drain_deviation[g.points[k]]);
        }
    }
    return out;
}

}  // namespace corpuscle
