#include "fit/transistor/curve_misfit.hpp"

#include <cmath>

namespace corpuscle {
namespace {

constexpr double above_floor = 10;     // times the noise floor: smaller currents are not judged
constexpr double gm_distance = 25e-3;  // V, between the points of a slope: less would show the noise

struct MeanSquare {
    double sum = 0;
    std::size_t count = 0;
    void add(double x) { sum += x * x, ++count; }
    double root() const { return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0; }
};

/// The relative difference of g_m/I_D along the sweeps of V_G.
MeanSquare slope_errors(const IvData& data, const std::vector<circuit::DrainBulkCurrents>& computed, double least) {
    MeanSquare out;
    for (const auto& c : data.curves) {
        if (c.swept != 1 << 1) continue;
        for (std::size_t i = c.begin, j = i; i < c.end; ++i) {
            const auto V = [&](std::size_t k) { return data.points[k].v[1]; };
            while (j < c.end && std::abs(V(j) - V(i)) < gm_distance) ++j;
            if (j >= c.end) break;
            const auto ratio = [](double a, double b) { return num::log(a / b); };
            const double a = data.points[i].I_D, b = data.points[j].I_D, x = computed[i].I_D, y = computed[j].I_D;
            if (!(a * b > 0 && x * y > 0 && std::abs(a) > least && std::abs(b) > least)) continue;
            if (const double expected = ratio(b, a); expected != 0) out.add(ratio(y, x) / expected - 1);
        }
    }
    return out;
}

}  // namespace

CurveMisfit curve_misfit(const IvData& data, const std::vector<circuit::DrainBulkCurrents>& computed, const CurveResiduals& residuals) {
    const double least = above_floor * residuals.drain_noise.floor;
    MeanSquare drain, scatter, bulk;
    CurveMisfit out;
    const auto relative = [&](std::size_t k) { return data.points[k].I_D / computed[k].I_D - 1; };
    const auto is_above_floor = [&](std::size_t k) { return std::abs(computed[k].I_D) > least && std::abs(data.points[k].I_D) > least; };
    for (const auto& c : data.curves)
        for (std::size_t k = c.begin; k < c.end; ++k) {
            if (!is_above_floor(k)) continue;
            drain.add(relative(k)), out.largest = std::max(out.largest, std::abs(relative(k)));
            // A second difference of independent values has six times their variance.
            if (k > c.begin && k + 1 < c.end && is_above_floor(k - 1) && is_above_floor(k + 1))
                scatter.add((relative(k - 1) - 2 * relative(k) + relative(k + 1)) / std::sqrt(6.0));
        }
    for (const auto k : residuals.bulk_points())
        if (std::abs(computed[k].I_B) > above_floor * residuals.bulk_noise.floor) bulk.add(data.points[k].I_B / computed[k].I_B - 1);
    out.points = drain.count, out.rms = drain.root(), out.scatter = scatter.root();
    if (bulk.count > 0) out.bulk_rms = bulk.root();
    if (const auto slopes = slope_errors(data, computed, least); slopes.count > 0) out.gm_over_ID = slopes.root();
    return out;
}

}  // namespace corpuscle
