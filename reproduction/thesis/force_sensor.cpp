#include "reproduction/thesis/force_sensor.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {

double ForceSensor::conductance(double gf) const { return 1 / R_0 + std::pow(gf, m) / a; }
double ForceSensor::slope(double gf) const { return m * std::pow(gf, m - 1) / a; }

StudyCurve ForceSensor::conductance_curve(double from, double to, double step) const {
    StudyCurve out;
    for (double gf = from; gf <= to; gf += step) out.x.push_back(gf), out.y.push_back(conductance(gf));
    return out;
}

std::string improved_cell_with_bulks(const std::string& bulk, const std::string& drain) {
    return fmt::format(
        "mn1 {1} vz vx {0} nch w=1.5u l=0.5u m=4 stack=4\n"
        "mn2 vdd vz vx {0} nch w=1.5u l=0.5u m=16\n",
        bulk, drain);
}

std::string improved_cell(const std::string& drain) {
    return improved_cell_with_bulks("tb", drain) + "mn3 vz vdd tb tb nch w=1.5u l=0.5u m=8\n";
}

std::string improved_cell_with_diode() { return improved_cell("d") + "mp3a d d if if pch w=6u l=0.5u m=8 stack=2\n"; }

std::string single_transistor_cell(int columns) { return fmt::format("mn1 if vz vx 0 nch w=1.5u l=0.5u m={}\n", columns); }

std::string voltage_cell(double R_F) {
    return fmt::format(
        "mn1 vdd vz z tb nch w=1.5u l=0.5u m=64\n"
        "mn3 vz vdd tb tb nch w=1.5u l=0.5u m=8\n"
        "rf z vx {}\n",
        R_F);
}

std::string transducer_netlist(std::span<const TransducerCell> cells, const std::string& force, const std::string& parts) {
    std::string out = fmt::format(
        "Transducers in a row\n.lib '../process/tsmc180.lib' tt\n{}\nvdd vdd 0 0.7\nvy vy 0 0.1\nvforce force 0 {}\n", parts, force);
    for (const auto& cell : cells)
        out += fmt::format(
            ".subckt cell_{0} vdd vy force\nxfsr force vx 0 fsr\niba pg 0 100n\nxamp vy vx vz pg vdd amplifier\nvif vdd if 0\n{1}.ends\n"
            "x{0} vdd vy force cell_{0}\n",
            cell.name, cell.lines);
    return out;
}

Result<std::vector<double>> find_lowest_supplies(std::span<const TransducerCell> cells, double newtons,
                                                 const std::vector<std::string>& settings, const std::string& parts) {
    const auto found = run_study_netlist({transducer_netlist(cells, fmt::format("{}", newtons), parts), settings, ".dc vdd 0.3 1 5m"});
    if (!found) return found.error();
    std::vector<double> out;
    for (const auto& cell : cells) out.push_back(found->curve("dc", fmt::format("v(x{}.vx)", cell.name)).crossing(0.95 * 0.1));
    return out;
}

}  // namespace corpuscle
