#include "circuit/device/mos/mos_device.hpp"

#include <cmath>

#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {

MosDevice::MosDevice(const MosSurroundings& s)
    : s_(s), sign_(s.pmos ? -1 : 1), critical_drain_(s.drain.critical_voltage()), critical_source_(s.source.critical_voltage()) {
    std::size_t count = 4;
    if (s.g_drain > 0) drain_ = count++;
    if (s.g_source > 0) source_ = count++;
}

std::vector<int> mos_unknowns(const Element& e, DeviceSetup& setup, const MosSurroundings& s) {
    std::vector<int> out;
    for (const int node : e.nodes) out.push_back(setup.node_unknown(node));
    if (s.g_drain > 0) out.push_back(setup.add_unknown(e.name + "#drain"));
    if (s.g_source > 0) out.push_back(setup.add_unknown(e.name + "#source"));
    return out;
}

MosVoltages MosDevice::voltages(std::span<const double> v) const {
    const auto above_bulk = [&](std::size_t unknown, int direction) {
        MosNumber out(sign_ * (v[unknown] - v[B]));
        out.d[static_cast<std::size_t>(direction)] = sign_, out.d[B] = -sign_;
        return out;
    };
    return {above_bulk(drain_, D), above_bulk(G, G), above_bulk(source_, S)};
}

/// The drain-source voltage (V) that a Newton step from `before` to v may reach, as in SPICE2. Far from the present voltage the linearized
/// current is wrong, so that without a limit the iterations may alternate between saturation and the linear region.
static double limited_drain_voltage(double v, double before) {
    constexpr double high = 3.5, above_low = 4, below_high = 2, reverse = -0.5;
    const double sign = before < 0 ? -1 : 1, from = std::abs(before), to = sign * v;
    if (from >= high) return sign * (to > from ? std::fmin(to, 3 * from + 2) : std::fmax(to, below_high));
    return sign * (to > from ? std::fmin(to, above_low) : std::fmax(to, reverse));
}

/// Both junctions are limited by a shift of the bulk, so that the voltages of the channel's ends and the gate remain those of the step. Then
/// the drain-source voltage is limited by a shift of the drain.
bool MosDevice::limit(std::span<double> v, std::span<double> state) const {
    const double drain = sign_ * (v[B] - v[drain_]), source = sign_ * (v[B] - v[source_]);
    const double shift = std::fmax(drain - limited_junction_voltage(drain, state[0], s_.drain.n_vt, critical_drain_),
                                   source - limited_junction_voltage(source, state[1], s_.source.n_vt, critical_source_));
    state[0] = drain - shift, state[1] = source - shift;
    if (shift > 0) v[B] -= sign_ * shift;
    const double across = sign_ * (v[drain_] - v[source_]), limited = limited_drain_voltage(across, state[2]);
    state[2] = limited;
    if (limited != across) v[drain_] = v[source_] + sign_ * limited;
    return shift > 0 || limited != across;
}

namespace {

/// Adds a current or a charge of the channel, which flows into unknown `from` and out of unknown `to`, with its slopes.
struct ChannelAdder {
    std::span<double> values, slopes;
    double sign;
    std::size_t columns[4];
    void add(std::size_t row, const MosNumber& x, double factor) const {
        values[row] += factor * sign * x.v;
        for (std::size_t k = 0; k < 4; ++k) slopes[row * values.size() + columns[k]] += factor * sign * x.d[k];
    }
    void add_between(std::size_t from, std::size_t to, const MosNumber& x) const { add(from, x, 1), add(to, x, -1); }
};

}  // namespace

void MosDevice::eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const {
    const auto c = channel(voltages(v), context.with_charges);
    const ChannelAdder currents{out.f, out.df, sign_, {drain_, G, source_, B}}, charges{out.q, out.dq, sign_, {drain_, G, source_, B}};
    currents.add_between(drain_, source_, c.i), currents.add_between(drain_, B, c.i_db), currents.add_between(source_, B, c.i_sb);
    const auto add_junction = [&](const BulkJunction& junction, std::size_t end) {
        const double u = sign_ * (v[B] - v[end]);
        const auto j = junction.at(u);
        Stamp::add_between(out.f, B, end, sign_ * (j.i + context.gmin * u)), out.add_conductance(B, end, j.g + context.gmin);
        Stamp::add_between(out.q, B, end, sign_ * j.q), out.add_capacitance(B, end, j.c);
    };
    add_junction(s_.drain, drain_), add_junction(s_.source, source_);
    const auto add_resistance = [&](double g, std::size_t outer, std::size_t inner) {
        if (g > 0) Stamp::add_between(out.f, outer, inner, g * (v[outer] - v[inner])), out.add_conductance(outer, inner, g);
    };
    add_resistance(s_.g_drain, D, drain_), add_resistance(s_.g_source, S, source_);
    if (!context.with_charges) return;
    // Each charge is that of one plate; the gate has the other.
    charges.add_between(drain_, G, c.q_d), charges.add_between(source_, G, c.q_s), charges.add_between(B, G, c.q_b);
    const auto add_overlap = [&](double C, std::size_t end) {
        Stamp::add_between(out.q, G, end, C * (v[G] - v[end])), out.add_capacitance(G, end, C);
    };
    add_overlap(s_.C_gd, drain_), add_overlap(s_.C_gs, source_), add_overlap(s_.C_gb, B);
}

void MosDevice::add_resistor_noise(std::vector<NoiseSource>& out) const {
    if (s_.g_drain > 0) out.push_back({"drain resistance", D, drain_, 4 * boltzmann * s_.kelvin * s_.g_drain, 0});
    if (s_.g_source > 0) out.push_back({"source resistance", S, source_, 4 * boltzmann * s_.kelvin * s_.g_source, 0});
}

std::vector<OperatingValue> MosDevice::common_info(std::span<const double> v, double v_th, double v_dsat) const {
    const auto at = voltages(v);
    const auto c = channel(at, true);
    const auto q_g = -(c.q_d + c.q_s + c.q_b);
    const auto drain = s_.drain.at(-at.d.v), source = s_.source.at(-at.s.v);
    return {{"i_d", "A", sign_ * c.i.v},
            {"v_gs", "V", sign_ * (at.g.v - at.s.v)},
            {"v_ds", "V", sign_ * (at.d.v - at.s.v)},
            {"v_bs", "V", sign_ * -at.s.v},
            {"v_th", "V", sign_ * v_th},
            {"v_dsat", "V", sign_ * v_dsat},
            {"g_m", "S", sign_ * c.i.d[G]},
            {"g_ds", "S", sign_ * c.i.d[D]},
            {"g_mbs", "S", sign_ * c.i.d[B]},
            {"i_bd", "A", sign_ * (drain.i - c.i_db.v)},
            {"i_bs", "A", sign_ * (source.i - c.i_sb.v)},
            {"c_gs", "F", -sign_ * q_g.d[S] + s_.C_gs},
            {"c_gd", "F", -sign_ * q_g.d[D] + s_.C_gd},
            {"c_gb", "F", -sign_ * q_g.d[B] + s_.C_gb},
            {"c_bd", "F", drain.c},
            {"c_bs", "F", source.c}};
}

}  // namespace corpuscle::circuit
