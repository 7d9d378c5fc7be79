#include "fit/transistor/data_coverage.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

using namespace circuit;

constexpr double weak_inversion = 0.3, moderate_inversion = 1, strong_inversion = 10;  // inversion coefficients
constexpr double lowest_inversion = 1e-6;                                              // below it, leakage is most of the current
constexpr std::size_t min_weak_points = 3, min_junction_points = 3;
constexpr double min_range = 0.1, min_bulk_range = 0.15, min_temperature_range = 10;  // V, V, K

struct ValueRange {
    double low = 1e300, high = -1e300;
    void add(double x) { low = std::min(low, x), high = std::max(high, x); }
    double width() const { return high > low ? high - low : 0; }
};

struct Need {
    std::string_view card_name, data;
};
constexpr Need needs[] = {
    {"vto", "sweep V_G from weak to strong inversion"},
    {"isq", "sweep V_G from weak inversion to above the threshold"},
    {"n", "sweep V_G from 0.2 V below the threshold, or measure at several V_BS"},
    {"gamma", "measure sweeps of V_G at several V_BS"},
    {"sigmal", "measure saturated currents in weak inversion at two or more V_DS, 0.3 V apart"},
    {"zetal", "sweep V_G to 0.3 V above the threshold or higher, with V_DS in saturation"},
    {"ve", "measure saturated currents in moderate and strong inversion at two or more V_DS, 0.3 V apart"},
    {"js", "measure I_B with the bulk forward biased, V_BS from 0.3 to 0.6 V"},
    {"jssw", "measure I_B with the bulk forward biased, of devices of several widths"},
    {"nj", "measure I_B with the bulk forward biased, V_BS from 0.3 to 0.6 V"},
    {"tcv", "measure sweeps of V_G at several temperatures, such as -20, 27 and 85 C"},
    {"tis", "measure sweeps of V_G at several temperatures, such as -20, 27 and 85 C"},
    {"avt", "measure 10 or more equal devices, and name them in a column 'device'"},
    {"ais", "measure 10 or more equal devices, and name them in a column 'device'"},
};

/// The reason without the remedy; "": none.
std::string reason(const DataCoverage& c, std::string_view name) {
    const auto is = [name](auto... names) { return ((name == names) || ...); };
    if (is("vto") && c.gate_range < min_range) return "V_G hardly varies";
    if (is("isq") && !c.is_geometry_known) return "W and L are unknown, and the current gives only I_SQ W / L";
    if (is("isq") && c.largest_inversion < moderate_inversion)
        return fmt::format(
            "all points are in weak inversion (i_f up to {:.2g}), where a larger I_SQ is like a lower V_T0, so V_T0 belongs to this I_SQ",
            c.largest_inversion);
    if (is("n") && c.gate_range < min_range && c.bulk_range < min_bulk_range) return "V_G and V_BS hardly vary";
    if (is("n") && c.weak_points < min_weak_points && c.bulk_range < min_bulk_range)
        return fmt::format("there are {} points in weak inversion, and V_BS does not vary", c.weak_points);
    if (is("gamma") && c.bulk_range < min_bulk_range) return "V_BS does not vary";
    if (is("sigmal") && c.saturated_range < min_range) return "the saturated points have only one V_DS, and V_T0 contains its effect";
    if (is("zetal") && c.largest_inversion < strong_inversion)
        return fmt::format("no saturated point is in strong inversion (i_f up to {:.2g})", c.largest_inversion);
    if (is("ve") && c.saturated_range < min_range) return "the saturated points have only one V_DS, and I_SQ contains its effect";
    if (is("ve") && c.largest_inversion < moderate_inversion)
        return "all points are in weak inversion, where the Early effect is like DIBL (sigma L)";
    if (is("js", "nj", "jssw") && c.junction_points < min_junction_points)
        return "there are no bulk currents (I_B) of a forward biased junction";
    if (is("jssw") && c.largest_width < 1.5 * c.least_width) return "all devices have one width";
    if (is("tcv", "tis") && c.highest_temperature - c.least_temperature < min_temperature_range) return "all points have one temperature";
    if (is("avt", "ais") && c.devices < min_devices)
        return c.devices == 1 ? "there is one device" : fmt::format("there are {} devices", c.devices);
    return {};
}

}  // namespace

DataCoverage coverage_of(const IvData& data, const CurveResiduals& residuals, const UicmCard& card) {
    DataCoverage out;
    out.devices = data.devices.size(), out.is_geometry_known = data.is_geometry_known, out.junction_points = residuals.bulk_points().size();
    const double polarity = data.is_pmos ? -1 : 1;
    ValueRange gate, bulk, saturated;
    for (const auto& g : residuals.groups()) {
        UicmInstance instance;
        const auto& device = data.devices[g.device];
        instance.W = device.W, instance.L = device.L;
        out.least_width = std::min(out.least_width, device.W), out.largest_width = std::max(out.largest_width, device.W);
        out.least_length = std::min(out.least_length, device.L);
        out.least_temperature = std::min(out.least_temperature, g.temperature);
        out.highest_temperature = std::max(out.highest_temperature, g.temperature);
        const auto constants = uicm_constants(card, instance, g.temperature, data.is_pmos);
        for (const auto& v : g.voltages) {
            const double at[4] = {v[0], v[1], v[2], v[3]};
            const auto p = uicm_operating_point(constants, at);
            gate.add(polarity * (v[1] - v[3])), bulk.add(polarity * (v[2] - v[3]));
            if (p.i_f < lowest_inversion) continue;
            out.least_inversion = std::min(out.least_inversion, p.i_f);
            out.weak_points += p.i_f < weak_inversion;
            if (p.region != "saturation") continue;
            out.largest_inversion = std::max(out.largest_inversion, p.i_f);
            saturated.add(polarity * (v[0] - v[2]));
        }
    }
    out.gate_range = gate.width(), out.bulk_range = bulk.width(), out.saturated_range = saturated.width();
    return out;
}

std::string better_data(std::string_view card_name) {
    for (const auto& n : needs)
        if (n.card_name == card_name) return std::string(n.data);
    return {};
}

std::string missing_data(const DataCoverage& c, std::string_view card_name) {
    const auto why = reason(c, card_name);
    if (why.empty()) return {};
    const bool lacks_size = card_name == "isq" && !c.is_geometry_known;
    return fmt::format("{}; {}", why, lacks_size ? "give --width and --length, or columns W and L" : better_data(card_name));
}

}  // namespace corpuscle
