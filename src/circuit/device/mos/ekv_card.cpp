#include "circuit/device/mos/ekv_card.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double eps_silicon = 11.7 * 8.8541878128e-12;  // F/m

/// The rise of the threshold of short transistors by the charge at the ends of the channel, V.
double reverse_short_channel_shift(const EkvCard& c, double l) {
    const double v = 0.28 * (l / c.lk - 0.1), root = 1 + 0.5 * (v + std::sqrt(v * v + 1.936e-3));
    return 2 * c.q0 / c.cox / (root * root);
}

/// phi at the temperature, smoothly limited to 0.2 V.
double surface_potential(const EkvCard& c, double kelvin, double nominal) {
    const double vt = thermal_voltage(kelvin), ratio = kelvin / nominal;
    const double phi = c.phi * ratio - 3 * vt * std::log(ratio) - silicon_band_gap(nominal) * ratio + silicon_band_gap(kelvin);
    const double above = phi - 0.2;
    return 0.2 + 0.5 * (above + std::sqrt(above * above + vt * vt));
}

}  // namespace

Result<EkvCard> read_ekv_card(const Model& model) {
    static constexpr std::string_view others[] = {"level", "lmin", "lmax", "wmin", "wmax", "update"};
    auto c = TRY(read_model_card<EkvCard>(EkvCard::fields, model, others));
    if (model.values.contains("theta") && !model.values.contains("e0")) c.e0 = 0;
    return c;
}

Result<EkvConstants> ekv_constants(const EkvCard& c, const MosSize& size, double kelvin, bool pmos) {
    const double l = size.L + c.dl, w = size.W + c.dw, nominal = c.tnom + zero_celsius, ratio = kelvin / nominal, change = kelvin - nominal;
    if (!(l > 0)) return bad_input(fmt::format("l + dl = {:g} m must be positive", l));
    if (!(w > 0)) return bad_input(fmt::format("w + dw = {:g} m must be positive", w));
    EkvConstants out{};
    out.vt = thermal_voltage(kelvin), out.kelvin = kelvin;
    out.vto = (pmos ? -1 : 1) * (c.vto - c.tcv * change) + reverse_short_channel_shift(c, l);
    out.gamma = c.gamma, out.phi = surface_potential(c, kelvin, nominal);
    out.kp_w = c.kp * std::pow(ratio, c.bex) * w;
    out.l = l, out.w = w, out.m = size.m, out.cox = c.cox;
    out.l_c = std::sqrt(eps_silicon / c.cox * c.xj);
    out.ucrit = c.ucrit * std::pow(ratio, c.ucex), out.v_c = out.ucrit * l, out.lambda = c.lambda;
    out.short_term = eps_silicon / c.cox * c.leta / l, out.narrow_term = 3 * eps_silicon / c.cox * c.weta / w;
    out.field = c.e0 > 0 ? c.cox / (eps_silicon * c.e0) : 0;
    out.theta = c.theta, out.eta = pmos ? 1.0 / 3 : 0.5;
    out.iba = c.iba, out.ibb = c.ibb * (1 + c.ibbt * change), out.ibn = c.ibn;
    out.kf = c.kf;
    return out;
}

MosSurroundings ekv_surroundings(const EkvCard& c, const Model& model, const Element& e, const MosSize& size, double kelvin) {
    const double w = size.W + c.dw, l = size.L + c.dl, nominal = c.tnom + zero_celsius;
    const double vt = thermal_voltage(kelvin), vt_nominal = thermal_voltage(nominal);
    const double growth =
        std::exp((silicon_band_gap(nominal) / vt_nominal - silicon_band_gap(kelvin) / vt + c.xti * std::log(kelvin / nominal)) / c.n);
    const auto given = [&](std::string_view name) { return model.values.contains(name); };
    const auto junction = [&](bool cap_given, double cap, double area, double perimeter) {
        BulkJunction out;
        out.n_vt = c.n * vt;
        out.i_sat = size.m * growth * (c.js > 0 || c.jsw > 0 ? c.js * area + c.jsw * perimeter : c.is);
        out.bottom = {size.m * (cap_given ? cap : c.cj * area), c.pb, c.mj, c.fc};
        out.sidewall = {size.m * c.cjsw * perimeter, c.pbsw, c.mjsw, c.fc};
        adjust_layer(out.bottom, nominal, kelvin), adjust_layer(out.sidewall, nominal, kelvin);
        return out;
    };
    const auto value = [&](std::string_view name, double otherwise) { return value_or(e.values, name, otherwise); };
    const auto conductance = [&](bool is_given, double r, std::string_view squares) {
        const double ohm = is_given ? r : c.rsh * value(squares, c.hdif / size.W);
        return ohm > 0 ? size.m / ohm : 0;
    };
    MosSurroundings out;
    out.pmos = model.type == "pmos", out.kelvin = kelvin;
    out.g_drain = conductance(given("rd"), c.rd, "nrd"), out.g_source = conductance(given("rs"), c.rs, "nrs");
    out.C_gd = c.cgdo * w * size.m, out.C_gs = c.cgso * w * size.m, out.C_gb = c.cgbo * l * size.m;
    const double area = 2 * c.hdif * w, perimeter = c.hdif > 0 ? 4 * c.hdif + w : 0;  // of a source or drain whose size is not given
    out.drain = junction(given("cbd"), c.cbd, value("ad", area), value("pd", perimeter));
    out.source = junction(given("cbs"), c.cbs, value("as", area), value("ps", perimeter));
    return out;
}

}  // namespace corpuscle::circuit
