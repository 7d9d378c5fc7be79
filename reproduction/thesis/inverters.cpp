#include "reproduction/thesis/inverters.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

/// The same curve with x relative to `half`.
StudyCurve relative_to_half_supply(StudyCurve line, double half) {
    for (double& x : line.x) x -= half;
    return line;
}

}  // namespace

Result<InverterSweep> InverterSweep::run(double step, double supply) {
    auto found = run_study_netlist({"inverters", {fmt::format("supply={}", supply)}, fmt::format(".dc vin 0 {} {}", supply, step)});
    if (!found) return found.error();
    return InverterSweep{std::move(*found), supply};
}

Result<InverterSweep> InverterSweep::run_with_directives(const std::string& directives, std::vector<std::string> settings) {
    auto found = run_study_netlist({"inverters", std::move(settings), directives});
    if (!found) return found.error();
    return InverterSweep{std::move(*found), 0.7};
}

StudyCurve InverterSweep::output_current(char letter) const {
    return relative_to_half_supply(netlist_result.curve("dc", fmt::format("i(vh{})", letter)), supply / 2);
}
StudyCurve InverterSweep::transconductance(char letter) const { return output_current(letter).slope().scaled(1, -1); }

StudyCurve InverterSweep::transfer_curve(char letter) const {
    auto out = relative_to_half_supply(netlist_result.curve("dc", fmt::format("v(o{})", letter)), supply / 2);
    for (double& y : out.y) y -= supply / 2;
    return out;
}

StudyCurve InverterSweep::voltage_gain(char letter) const {
    const auto curve = transfer_curve(letter), slope = curve.slope().absolute();
    StudyCurve out;
    // Backwards, because the output falls as the input rises. slope() omits the first pair of the curve, so its pair k belongs to pair k
    // + 1.
    for (std::size_t k = slope.x.size(); k-- > 0;) out.x.push_back(curve.y[k + 1]), out.y.push_back(slope.y[k]);
    return out;
}

StudyCurve InverterSweep::supply_current(char letter) const {
    return relative_to_half_supply(netlist_result.curve("dc", fmt::format("i(vs{})", letter)), supply / 2);
}

}  // namespace corpuscle
