#include "reproduction/thesis/isolated_oscillator.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {
namespace {

constexpr auto netlist = R"(The oscillator under a constant current
.lib '../process/tsmc180.lib' tt
.include 'parts/trigger.inc'
.include 'parts/oscillator.inc'
.param i_in=20p hv=0 until=0.2 i_leak=2p i_charge=1n c_u=1.8p
vdd vdd 0 0.7
x u s gl gc vdd oscillator c_u={c_u} hv_switch={hv}
ilk gl 0 {i_leak}
ich gc 0 {i_charge}
iin u 0 pwl(0 0 10m 0 10.1m {i_in})
.options spikecheck=0
.op
.tran 10u {until} 0 5m
.spike v(s) 0.35
)";

}  // namespace

Result<NetlistResult> simulate_oscillator(const IsolatedOscillator& o) {
    return run_study_netlist({netlist,
                              {fmt::format("i_in={}", o.current), fmt::format("until={}", o.stop_time),
                               fmt::format("hv={}", o.has_high_threshold_switches ? 0.15 : 0), fmt::format("i_leak={}", o.leak)}});
}

Hysteresis find_hysteresis(const NetlistResult& found, const std::string& output) {
    const auto [x, y] = found.curve("dc", output);
    const auto turning_point = std::max_element(x.begin(), x.end()) - x.begin();
    Hysteresis out{{{x.begin(), x.begin() + turning_point + 1}, {y.begin(), y.begin() + turning_point + 1}},
                   {{x.rbegin(), x.rend() - turning_point}, {y.rbegin(), y.rend() - turning_point}},
                   0,
                   0};
    out.V_H = out.rising.crossing(0.35), out.V_L = out.falling.crossing(0.35);
    return out;
}

Result<Hysteresis> simulate_trigger() {
    const auto found = run_study_netlist({"schmitt", {}, ".dc vin 0 0.7 1m updown"});
    if (!found) return found.error();
    return find_hysteresis(*found, "v(out)");
}

}  // namespace corpuscle
