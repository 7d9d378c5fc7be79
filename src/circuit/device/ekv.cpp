// The MOS transistor EKV 2.6.

#include <cmath>

#include "circuit/device/inversion_charge.hpp"
#include "circuit/device/mos/ekv_card.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

/// y(v), the solution of 2 y + ln y = v. The normalized current is y (1 + y).
MosNumber normalized_charge(const MosNumber& v) {
    const double q = inversion_charge(v.v + 0.6931471805599453);
    return v.mapped(0.5 * q, 0.5 * q / (1 + q));
}

/// (x + sqrt(x^2 + width)) / 2, which is positive and nearly max(x, 0).
template <class T>
T smooth_positive(const T& x, double width) {
    return T(0.5) * (x + num::sqrt(x * x + T(width)));
}

/// All voltages are above the bulk; d is the end of the higher one.
template <class T>
struct EkvValues {
    T v_p, n, i_f, i_r, v_dss;  ///< V, slope factor, normalized currents, half of the saturation voltage in V
    T beta, q_i;                ///< A/V^2 and V: inversion charge over C_ox W L
    T i, i_impact;              ///< A: drain to source, drain to bulk
    T q_d, q_s, q_b;            ///< C
};

/// Bucher, Lallement, Enz, Theodoloz and Krummenacher, "The EPFL-EKV MOSFET Model Equations for Simulation, Model Version 2.6", EPFL, June
/// 1997, revision II July 1998, and its later revisions. U_T = kT/q, Phi = phi, L_c = sqrt(eps_si xj / cox), C = eps_si / cox.
///
/// - Effective gate voltage: V_G* = V_G - vto - shift(q0, lk) + Phi + gamma sqrt(Phi), V_G' = V_G* smoothly limited to positive values
/// - Charge sharing: gamma' = gamma - C leta / L (sqrt(Phi + V_S) + sqrt(Phi + V_D)) + 3 C weta / W sqrt(Phi + V_P0)
/// - Pinch-off voltage: V_P = V_G' - Phi - gamma' (sqrt(V_G' + (gamma'/2)^2) - gamma'/2); V_P0 is the same with gamma
/// - Slope factor: n = 1 + gamma / (2 sqrt(Phi + V_P + 4 U_T))
/// - Currents: i = F(v) = y (1 + y) with 2 y + ln y = v; i_f = F((V_P - V_S) / U_T), i_r = F((V_P - V_D) / U_T), and i_r', below
///
///     I_D = 2 n beta U_T^2 (i_f - i_r'),   beta = kp W / L_eq, reduced by the vertical field
///
/// Velocity saturation, with V_C = ucrit L and V_DS' = V_DS / 2:
///
///     V_DSS  = V_C (sqrt(1/4 + U_T / V_C sqrt(i_f)) - 1/2)
///     V_DSS' = V_C (sqrt(1/4 + U_T / V_C (sqrt(i_f) - 3/4 ln i_f)) - 1/2) + U_T (ln(V_C / (2 U_T)) - 0.6)
///     dV^2   = 16 U_T^2 (lambda (sqrt(i_f) - V_DSS / U_T) + 1/64)
///     V_ip   = sqrt(V_DSS^2 + dV^2) - sqrt((V_DS' - V_DSS)^2 + dV^2)
///     i_r'   = F((V_P - V_DS' - V_S - sqrt(V_DSS'^2 + dV^2) + sqrt((V_DS' - V_DSS')^2 + dV^2)) / U_T)
///     L_eq   = L - lambda L_c ln(1 + (V_DS' - V_ip) / (L_c ucrit)) + (V_DS' + V_ip) / ucrit, smoothly limited to L / 10
///
/// Charges of the quasi-static model, with x = sqrt(1/4 + i_f), z = sqrt(1/4 + i_r) and n_q = 1 + gamma' / (2 sqrt(Phi + V_P / 2)):
///
///     Q_D = -n_q U_T C_ox (4/15 (3 z^3 + 6 z^2 x + 4 z x^2 + 2 x^3) / (x + z)^2 - 1/2),   Q_S with x and z exchanged
///     Q_B = -C_ox gamma' sqrt(V_P + Phi) - (n_q - 1) / n_q (Q_D + Q_S), and C_ox (V_G' - V_G*) in accumulation
struct EkvEquations {
    const EkvConstants& c;

    template <class T>
    T pinch_off(const T& v_g, const T& gamma) const {
        return v_g - T(c.phi) - gamma * (num::sqrt(v_g + T(0.25) * gamma * gamma) - T(0.5) * gamma);
    }
    /// Smooth root of Phi + V.
    template <class T>
    T end_root(const T& v) const {
        return num::sqrt(smooth_positive(T(c.phi) + v, 16 * c.vt * c.vt));
    }
    /// Mobility at the vertical field of the charges, or at the pinch-off voltage, relative to that at V_P = 0 without inversion.
    template <class T>
    T mobility(const T& v_p, const T& q_i) const {
        if (c.field == 0) return T(1.0) / (T(1.0) + T(c.theta) * smooth_positive(v_p, 2 * c.vt * c.vt));
        const T root = num::sqrt(v_p + T(c.phi + 1e-6)), share = T(c.gamma) / (T(2.0) * root + T(c.gamma));
        const T q_b = -(T(c.gamma) * root) - share * q_i;
        return T(1 + c.field * c.gamma * std::sqrt(c.phi)) / (T(1.0) + T(c.field) * num::abs(q_b + T(c.eta) * q_i));
    }
    template <class T>
    EkvValues<T> operator()(const T& d, const T& g, const T& s) const {
        const double U = c.vt, width = 16 * U * U;
        EkvValues<T> out;
        const T star = g - T(c.vto - c.phi - c.gamma * std::sqrt(c.phi)), v_g = smooth_positive(star, 2 * width);
        const T root_p0 = num::sqrt(pinch_off(v_g, T(c.gamma)) + T(c.phi + 0.1 * U));
        const T sharing = T(c.gamma) - T(c.short_term) * (end_root(s) + end_root(d)) + T(c.narrow_term) * root_p0;
        const T gamma = smooth_positive(sharing, 0.1 * U), v_p = out.v_p = pinch_off(v_g, gamma);
        // normalized currents and saturation voltage
        const T y_f = normalized_charge((v_p - s) / T(U)), y_r = normalized_charge((v_p - d) / T(U));
        const T i_f = out.i_f = y_f * (T(1.0) + y_f), root_f = num::sqrt(i_f);
        out.i_r = y_r * (T(1.0) + y_r);
        // V_C (sqrt(1/4 + x / V_C) - 1/2) without the difference of large numbers
        const auto saturation = [&](const T& x) { return x / (num::sqrt(T(0.25) + x / T(c.v_c)) + T(0.5)); };
        const T v_dss = out.v_dss = saturation(T(U) * root_f);
        const T v_dss2 = saturation(T(U) * (root_f - T(0.75) * num::log(i_f))) + T(U * (std::log(0.5 * c.v_c / U) - 0.6));
        const T half = T(0.5) * (d - s), dv = T(width) * (T(c.lambda) * (root_f - v_dss / T(U)) + T(1.0 / 64));
        const auto from_zero = [&](const T& at) { return num::sqrt(at * at + dv) - num::sqrt((half - at) * (half - at) + dv); };
        const T v_ip = from_zero(v_dss), y = normalized_charge((v_p - half - s - from_zero(v_dss2)) / T(U));
        // channel length, mobility and current
        const T shortening = T(c.lambda * c.l_c) * num::log(T(1.0) + (half - v_ip) / T(c.l_c * c.ucrit));
        const T length = smooth_positive(T(c.l) - shortening + (half + v_ip) / T(c.ucrit), 0.01 * c.l * c.l);
        const T slope_p = T(1.0) + T(0.5 * c.gamma) / num::sqrt(v_p + T(c.phi + 1e-6));
        out.q_i = -(slope_p * T(U) * (y_f + y_r + T(4.0 / 3) * (y_f * y_f + y_f * y_r + y_r * y_r)) / (T(1.0) + y_f + y_r));
        out.beta = T(c.m * c.kp_w) / length * mobility(v_p, out.q_i);
        out.n = T(1.0) + T(0.5 * c.gamma) / num::sqrt(v_p + T(c.phi + 4 * U));
        out.i = T(2 * U * U) * out.n * out.beta * (y_f - y) * (T(1.0) + y_f + y);
        out.i_impact = impact(d - s - T(2 * c.ibn) * v_dss) * out.i;
        charges(y_f, y_r, gamma, v_g - star, out);
        return out;
    }
    /// Current to the bulk relative to the channel current, at the voltage v between the drain and the end of the channel.
    template <class T>
    T impact(const T& v) const {
        if (c.iba == 0 || !(v > T(0.01 * c.l_c * c.ibb / 7))) return T(0.0);  // e^-700 below
        return T(c.iba / c.ibb) * v * num::exp(T(-c.l_c * c.ibb) / v);
    }
    template <class T>
    void charges(const T& y_f, const T& y_r, const T& gamma, const T& accumulation, EkvValues<T>& out) const {
        const double C = c.m * c.w * c.l * c.cox;
        const T n_1 = T(0.5) * gamma / num::sqrt(T(c.phi) + T(0.5) * out.v_p), sum = T(1.0) + y_f + y_r;
        const T scale = T(-c.vt * C) * (T(1.0) + n_1) / (sum * sum);
        // with x = 1/2 + y_f and z = 1/2 + y_r in the formula above, so that small charges are not the difference of large numbers
        const auto end = [&](const T& a, const T& b) {
            return scale * (T(2.0 / 3) * a + T(1.0 / 3) * b + T(1.5) * a * a + T(5.0 / 3) * a * b + T(5.0 / 6) * b * b +
                            T(4.0 / 15) * (T(3.0) * a * a * a + T(6.0) * a * a * b + T(4.0) * a * b * b + T(2.0) * b * b * b));
        };
        out.q_s = end(y_f, y_r), out.q_d = end(y_r, y_f);
        out.q_b = T(C) * (accumulation - gamma * num::sqrt(out.v_p + T(c.phi + 1e-6))) - n_1 / (T(1.0) + n_1) * (out.q_s + out.q_d);
    }
};

class Ekv final : public MosDevice {
    EkvConstants c_;

    /// With source and drain exchanged if the source has the higher voltage.
    EkvValues<MosNumber> ordered(const MosVoltages& v) const {
        return v.d.v >= v.s.v ? EkvEquations{c_}(v.d, v.g, v.s) : EkvEquations{c_}(v.s, v.g, v.d);
    }
    MosChannelValues channel(const MosVoltages& v, bool) const override {
        const auto e = ordered(v);
        if (v.d.v >= v.s.v) return {e.i, e.i_impact, MosNumber(), e.q_d, e.q_s, e.q_b};
        return {-e.i, MosNumber(), e.i_impact, e.q_s, e.q_d, e.q_b};
    }

public:
    Ekv(const EkvConstants& c, const MosSurroundings& s) : MosDevice(s), c_(c) {}

    /// Channel: 4kT beta |Q_I| / (C_ox W L), and kf g_m^2 / (W L C_ox f).
    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const auto e = ordered(voltages(v));
        std::vector<NoiseSource> out = {{"thermal", drain_, source_, 4 * boltzmann * c_.kelvin * e.beta.v * std::abs(e.q_i.v), 0}};
        if (c_.kf > 0) out.push_back({"flicker", drain_, source_, 0, c_.kf * e.i.d[G] * e.i.d[G] / (c_.m * c_.w * c_.l * c_.cox), true});
        add_resistor_noise(out);
        return out;
    }
    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const auto at = voltages(v);
        const auto e = ordered(at);
        const double low = std::fmin(at.s.v, at.d.v), root = std::sqrt(std::fmax(c_.phi + low, 0));
        auto out = common_info(v, c_.vto + c_.gamma * (root - std::sqrt(c_.phi)), c_.vt * (2 * std::sqrt(e.i_f.v) + 4));
        out.push_back({"i_f", "", e.i_f.v}), out.push_back({"i_r", "", e.i_r.v});
        out.push_back({"v_p", "V", sign_ * e.v_p.v}), out.push_back({"n", "", e.n.v});
        return out;
    }
    std::string operating_region(std::span<const double> v) const override {
        const auto at = voltages(v);
        const auto e = ordered(at);
        const std::string_view inversion = e.i_f.v < 0.1 ? "weak" : e.i_f.v > 10 ? "strong" : "moderate";
        const bool saturated = std::abs(at.d.v - at.s.v) > c_.vt * (2 * std::sqrt(e.i_f.v) + 4);
        return fmt::format("{}, {}", inversion, saturated ? "saturation" : "triode");
    }
};

Result<std::unique_ptr<Device>> make_ekv(const Element& e, DeviceSetup& setup) {
    const auto& model = *setup.circuit().model_of(e);
    const auto card = TRY(read_ekv_card(model));
    const auto size = TRY(read_mos_size(e));
    const auto constants = ekv_constants(card, size, setup.temperature(e), model.type == "pmos");
    if (!constants) return error_at(e.location, "{}: {}", e.name, constants.error().message);
    const auto surroundings = ekv_surroundings(card, model, e, size, setup.temperature(e));
    return make_device<Ekv>(mos_unknowns(e, setup, surroundings), *constants, surroundings);
}

Result<std::string> write_ekv(const ElementExport& e) {
    return error_at(e.element.location, "{}: EKV 2.6 cannot be exported, because Debian's ngspice does not have it; level 1 and UICM can",
                    e.element.name);
}

constexpr double other_ekv_levels[] = {55, 260};

}  // namespace

extern constexpr DeviceKind ekv_kind = {.letter = 'm',
                                        .level = 44,
                                        .other_levels = other_ekv_levels,
                                        .description = "MOS transistor, EKV 2.6",
                                        .gmin = 1e-15,
                                        .read = read_mos_line,
                                        .make = make_ekv,
                                        .parameters = mos_parameters,
                                        .other_names = mos_names,
                                        .conducting_nodes = mos_conducting_nodes,
                                        .saves_terminal_current = true,
                                        .area = mos_area,
                                        .write_spice = write_ekv};

}  // namespace corpuscle::circuit
