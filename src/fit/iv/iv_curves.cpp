// Polarity and curves of the points that were read.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "fit/iv/iv_data.hpp"

namespace corpuscle {
namespace {

/// The point of the largest current, whose signs tell the polarity.
const IvPoint& point_of_largest_current(const IvData& data) {
    return *std::max_element(data.points.begin(), data.points.end(),
                             [](const IvPoint& a, const IvPoint& b) { return std::abs(a.I_D) < std::abs(b.I_D); });
}

/// An error if a transistor of the other polarity conducts in some points: a large current with the gate beyond drain and source.
Result<void> check_one_polarity(const IvData& data, double largest, const std::string& path) {
    constexpr double of_largest = 0.01;
    const double sign = data.is_pmos ? -1 : 1;
    const auto is_other = [&](const IvPoint& p) {
        return std::abs(p.I_D) > of_largest * largest && sign * p.v[1] < std::min(sign * p.v[0], sign * p.v[2]);
    };
    const auto other = std::find_if(data.points.begin(), data.points.end(), is_other);
    if (other == data.points.end()) return {};
    return bad_input(fmt::format("{} points conduct as {} and others as {}, for example {:g} A at V_GS = {:g} V; fit each transistor by "
                                 "itself, from a file of its own",
                                 std::count_if(data.points.begin(), data.points.end(), is_other), data.is_pmos ? "an NMOS" : "a PMOS",
                                 data.is_pmos ? "a PMOS" : "an NMOS", other->I_D, other->v[1] - other->v[2]),
                     {path});
}

}  // namespace

Result<void> set_polarity(IvData& data, std::optional<bool> is_pmos, const std::string& path) {
    const auto& p = point_of_largest_current(data);
    const double V_DS = p.v[0] - p.v[2], V_GS = p.v[1] - p.v[2];
    if (p.I_D == 0)
        return bad_input("every drain current is 0; is the column of I_D the right one? --column i_d=HEAD names another", {path});
    if (p.I_D * V_DS < 0)
        return bad_input(fmt::format("the largest current, {:g} A at V_DS = {:g} V, flows out of the drain; if it is measured with the "
                                     "opposite sign, write --column i_d=-HEAD",
                                     p.I_D, V_DS),
                         {path});
    data.is_pmos = is_pmos.value_or(p.I_D < 0);
    if (data.is_pmos == (p.I_D < 0)) return check_one_polarity(data, std::abs(p.I_D), path);
    if (!data.is_pmos || V_GS < 0)
        return bad_input(fmt::format("--type {}: but the largest current is {:g} A at V_GS = {:g} V; use --type {}",
                                     data.is_pmos ? "pmos" : "nmos", p.I_D, V_GS, data.is_pmos ? "nmos" : "pmos"),
                         {path});
    for (auto& one : data.points) {
        for (auto& v : one.v) v = -v;
        one.I_D = -one.I_D, one.I_B = -one.I_B;
    }
    data.notes.emplace_back("voltages and currents of the PMOS are taken as magnitudes");
    return {};
}

void divide_into_curves(IvData& data) {
    data.curves.clear();
    for (std::size_t k = 0; k < data.points.size(); ++k) {
        auto& p = data.points[k];
        int swept = 0, falling = 0;
        const IvPoint* before = k > 0 ? &data.points[k - 1] : nullptr;
        for (int t = 0; before && t < 4; ++t) {
            const double step = p.v[static_cast<std::size_t>(t)] - before->v[static_cast<std::size_t>(t)];
            if (std::abs(step) > 1e-7) swept |= 1 << t, falling |= step < 0 ? 1 << t : 0;
        }
        const int direction = swept | falling << 4;
        const bool is_same = before && before->device == p.device && before->file == p.file && before->temperature == p.temperature;
        auto* last = data.curves.empty() ? nullptr : &data.curves.back();
        const bool is_second = last && last->end - last->begin == 1;
        if (!is_same || swept == 0 || !(is_second || last->swept == direction))
            data.curves.push_back({k, k + 1, 0});
        else
            last->end = k + 1, last->swept = direction;
        p.curve = static_cast<std::uint32_t>(data.curves.size() - 1);
    }
    for (auto& c : data.curves) c.swept &= 15;
}

}  // namespace corpuscle
