// The MOS transistor of SPICE, level 1.

#include <cmath>

#include "circuit/device/mos/mos1_card.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

/// Shichman and Hodges, "Modeling and simulation of insulated-gate field-effect transistor switching circuits", IEEE J. Solid-State
/// Circuits 3, 1968. With the source the end of the lower voltage, u = v_gs - v_th and v_th = vbi + gamma sqrt(phi - v_bs):
///
///     i = beta (1 + lambda v_ds) (u - v_ds / 2) v_ds     for v_ds < u
///     i = beta (1 + lambda v_ds) u^2 / 2                 for v_ds >= u > 0
///
/// and 0 for u <= 0. For v_bs > 0 the root is continued along its tangent, but not below 0. The slopes are continuous at all of these
/// boundaries except the last, and at v_ds = 0, where drain and source change places.
struct Current {
    const Mos1Constants& c;

    template <class T>
    T threshold(T v_bs) const {
        const double root = std::sqrt(c.phi);
        const T at_end = v_bs <= T(0.0) ? num::sqrt(T(c.phi) - v_bs) : num::positive_part(T(root) - v_bs * T(0.5 / root));
        return T(c.vbi) + T(c.gamma) * at_end;
    }
    template <class T>
    T operator()(const T& d, const T& g, const T& s) const {
        const bool forward = d >= s;
        const T v_ds = forward ? d - s : s - d, low = forward ? s : d, u = g - low - threshold(-low);
        if (!(u > T(0.0))) return T(0.0);
        const T v = num::min(v_ds, u), i = T(c.beta) * (T(1.0) + T(c.lambda) * v_ds) * (u - T(0.5) * v) * v;
        return forward ? i : -i;
    }
};

/// Charges of the channel (Ward and Dutton, "A charge-oriented model for MOS transistor capacitances", IEEE J. Solid-State Circuits 13,
/// 1978), for a density of charge C_ox (v_g - v_th - v) along the channel. With U and W the values of v_g - v_th - v at source and drain,
///
///     Q_D = -(2/15) C_ox (2 U^3 + 4 U^2 W + 6 U W^2 + 3 W^3) / (U + W)^2,    Q_S with U and W exchanged
///
/// Their sum has Meyer's capacitances as derivatives: C_gs = (2/3) C_ox (1 - W^2 / (U + W)^2). Below the threshold Meyer's C_gs of SPICE
/// falls linearly to 0 at v_gs - v_th = -phi/2, which is what ramp() does. It takes the place of max(., 0), so that all capacitances are
/// continuous; the charge then saturates at v_ds = u + phi/2 instead of u.
///
/// The bulk has the depletion charge below the threshold, and that below the channel above it:
///
///     Q_B = -C_ox (min(x, 0) + gamma (sqrt(gamma^2/4 + max(x, 0)) - gamma/2)),   x = v_gb - v_fb - ramp(v_gs - v_th)
///
/// with v_fb = vbi - phi, and ramp() again for max(). v_th is that of the end with the lower voltage. So that the capacitances are
/// continuous at v_ds = 0, it changes smoothly from one end to the other within about `smooth` (V).
///
/// Meyer's model conserves no charge and gives the channel current of a changing charge to the end that has the capacitance. This model
/// conserves charge and divides it 40/60 in saturation. Meyer's C_gb depends on v_gs, this one's on v_gb.
struct Charges {
    const Mos1Constants& c;
    static constexpr double smooth = 0.02;

    /// 0 below -phi/2, x + phi/4 above 0, and between them a parabola.
    template <class T>
    T ramp(const T& x) const {
        if (x.v >= 0) return x + T(c.phi / 4);
        const T y = x + T(c.phi / 2);
        return y.v <= 0 ? T(0.0) : y * y / T(c.phi);
    }
    /// The part of the charge that belongs to the end with the density `own`, in units of C_ox.
    template <class T>
    static T end_charge(const T& own, const T& other) {
        const T larger = num::max(own, other);
        if (!(larger.v > 0)) return T(0.0);
        const T a = own / larger, b = other / larger, sum = a + b;
        return T(2.0 / 15) * larger * (T(3.0) * a * a * a + T(6.0) * a * a * b + T(4.0) * a * b * b + T(2.0) * b * b * b) / (sum * sum);
    }
    template <class T>
    void operator()(const T& d, const T& g, const T& s, T& q_d, T& q_s, T& q_b) const {
        const T half = T(0.5) * (d - s), low = T(0.5) * (d + s) + T(smooth) - num::sqrt(half * half + T(smooth * smooth));
        const T v_th = Current{c}.threshold(-low), U = ramp(g - s - v_th), W = ramp(g - d - v_th), C(-c.C_ox);
        q_s = C * end_charge(U, W), q_d = C * end_charge(W, U);
        const T x = g - T(c.vbi - c.phi) - ramp(g - low - v_th), depletion = ramp(x), accumulation = x - depletion;
        q_b = C * accumulation;
        if (c.gamma > 0) q_b += C * T(c.gamma) * (num::sqrt(T(c.gamma * c.gamma / 4) + depletion) - T(c.gamma / 2));
    }
};

class Mos1 final : public MosDevice {
    Mos1Constants c_;

    MosChannelValues channel(const MosVoltages& v, bool with_charges) const override {
        MosChannelValues out;
        out.i = Current{c_}(v.d, v.g, v.s);
        if (with_charges && c_.C_ox > 0) Charges{c_}(v.d, v.g, v.s, out.q_d, out.q_s, out.q_b);
        return out;
    }
    /// v_gs - v_th at the end of the lower voltage.
    double overdrive(const MosVoltages& v) const {
        const double low = std::fmin(v.d.v, v.s.v);
        return v.g.v - low - Current{c_}.threshold(-low);
    }

public:
    Mos1(const Mos1Constants& c, const MosSurroundings& s) : MosDevice(s), c_(c) {}

    /// As SPICE: 8/3 kT g_m, flicker noise, and the series resistances.
    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const auto at = voltages(v);
        const auto i = Current{c_}(at.d, at.g, at.s);
        std::vector<NoiseSource> out = {{"thermal", drain_, source_, 8.0 / 3 * boltzmann * c_.kelvin * std::abs(i.d[G]), 0}};
        if (c_.flicker > 0) out.push_back({"flicker", drain_, source_, 0, c_.flicker * std::pow(std::abs(i.v), c_.af), true});
        add_resistor_noise(out);
        return out;
    }
    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const auto at = voltages(v);
        const double low = std::fmin(at.d.v, at.s.v);
        return common_info(v, Current{c_}.threshold(-low), std::fmax(overdrive(at), 0));
    }
    std::string operating_region(std::span<const double> v) const override {
        const auto at = voltages(v);
        const double u = overdrive(at);
        return u <= 0 ? "cutoff" : std::abs(at.d.v - at.s.v) < u ? "linear" : "saturation";
    }
};

Result<std::unique_ptr<Device>> make_mos1(const Element& e, DeviceSetup& setup) {
    const auto& model = *setup.circuit().model_of(e);
    const auto card = TRY(read_mos1_card(model));
    const auto size = TRY(read_mos_size(e));
    const auto constants = mos1_constants(card, size, setup.temperature(e), model.type == "pmos");
    if (!constants) return error_at(e.location, "{}: {}", e.name, constants.error().message);
    const auto surroundings = mos1_surroundings(card, model, size, setup.temperature(e));
    return make_device<Mos1>(mos_unknowns(e, setup, surroundings), *constants, surroundings);
}

Result<std::string> write_mos1(const ElementExport& e) {
    std::string out = fmt::format("{} {}", e.head, e.names.model(e.element.model));
    for (const auto& p : MosSize::fields)
        if (e.element.values.contains(p.name)) out += fmt::format(" {}={}", p.name, e.value(p.name, 0));
    return out + e.temperature() + '\n';
}

/// Parameters of other levels have no effect, with a warning, as in ngspice: cards written for level 3 are often run as level 1.
Result<void> read_mos1_line(ElementReader& line) {
    TRY(read_mos_line(line));
    line.drop_unknown_model_values(mos1_parameter_names());
    for (const auto name : {"l", "w"})
        if (line.model_value(name))
            line.warn_about_model(fmt::format("{0} has no effect: a transistor has the {0} of its own line, else the default", name));
    for (const auto name : parameters_of_higher_levels())
        if (line.model_value(name).value_or(0) != 0)
            line.warn_about_model(fmt::format("{} is a parameter of levels 2 and 3, and has no effect", name));
    return {};
}

}  // namespace

extern constexpr DeviceKind mos1_kind = {.letter = 'm',
                                         .level = 1,
                                         .description = "MOS transistor, SPICE level 1",
                                         .gmin = 1e-12,
                                         .read = read_mos1_line,
                                         .make = make_mos1,
                                         .parameters = mos_parameters,
                                         .other_names = mos_names,
                                         .conducting_nodes = mos_conducting_nodes,
                                         .saves_terminal_current = true,
                                         .area = mos_area,
                                         .write_spice = write_mos1};

}  // namespace corpuscle::circuit
