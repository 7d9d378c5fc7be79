#include "study/thesis/inverters.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

Line relative_to_half_supply(Line line, double half) {
    for (double& x : line.x) x -= half;
    return line;
}

}  // namespace

Result<Inverters> Inverters::swept(double step, double supply) {
    auto found = found_in({"inverters", {fmt::format("supply={}", supply)}, fmt::format(".dc vin 0 {} {}", supply, step)});
    if (!found) return found.error();
    return Inverters{std::move(*found), supply};
}

Result<Inverters> Inverters::ordered(const std::string& directives, std::vector<std::string> settings) {
    auto found = found_in({"inverters", std::move(settings), directives});
    if (!found) return found.error();
    return Inverters{std::move(*found), 0.7};
}

Line Inverters::current(char which) const { return relative_to_half_supply(found.line("dc", fmt::format("i(vh{})", which)), supply / 2); }
Line Inverters::transconductance(char which) const { return current(which).slope().times(1, -1); }

Line Inverters::characteristic(char which) const {
    auto out = relative_to_half_supply(found.line("dc", fmt::format("v(o{})", which)), supply / 2);
    for (double& y : out.y) y -= supply / 2;
    return out;
}

Line Inverters::gain(char which) const {
    const auto curve = characteristic(which), slope = curve.slope().absolute();
    Line out;
    for (std::size_t k = slope.x.size(); k-- > 0;) out.x.push_back(curve.y[k + 1]), out.y.push_back(slope.y[k]);
    return out;
}

Line Inverters::taken(char which) const { return relative_to_half_supply(found.line("dc", fmt::format("i(vs{})", which)), supply / 2); }

}  // namespace corpuscle
