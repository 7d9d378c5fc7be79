#include "circuit/device/mos/mos1_card.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double oxide = 3.9 * 8.854214871e-12, silicon = 11.7 * 8.854214871e-12;  // F/m, as SPICE has them
constexpr double intrinsic = 1.45e16;                                              // 1/m^3: carriers in silicon, as SPICE has it

/// Other names of parameters.
constexpr std::pair<std::string_view, std::string_view> aliases[] = {{"vt0", "vto"}, {"uo", "u0"}};
/// Parameters of levels 2 and 3, which some cards of level 1 contain.
constexpr std::string_view higher_levels[] = {"nfs",   "xj",   "delta", "theta", "eta",  "kappa",
                                              "ucrit", "uexp", "utra",  "vmax",  "neff", "xqc"};

/// Names that are read apart from the fields. l and w have no effect.
constexpr std::string_view others[] = {"level", "vt0",   "uo",    "l",    "w",    "nfs",  "xj",   "delta", "theta",
                                       "eta",   "kappa", "ucrit", "uexp", "utra", "vmax", "neff", "xqc"};

/// Work function of the gate less that of the bulk, V, after SPICE. sign: 1 for NMOS, -1 for PMOS. gap: band gap, V.
double work_function(const Mos1Card& c, double sign, double phi, double gap) {
    const double gate = c.tpg == 0 ? 3.2 : 3.25 + gap / 2 - sign * c.tpg * gap / 2;
    return gate - (3.25 + gap / 2 + sign * phi / 2);
}

/// Computes what is not given from the process, as SPICE does if tox is given.
Result<void> derive(Mos1Card& c, const Model& model) {
    const auto given = [&](std::string_view name) { return model.values.contains(name); };
    if (!(c.tox > 0)) return {};
    const double C = oxide / c.tox, nominal = c.tnom + zero_celsius;  // F/m^2, K
    if (!given("kp")) c.kp = c.u0 * 1e-4 * C;
    if (!given("nsub")) return {};
    if (!(c.nsub * 1e6 > intrinsic))
        return error_at(model.location, "{}: nsub = {:g} must be above the intrinsic carrier density, {:g} 1/cm^3", model.name, c.nsub,
                        intrinsic * 1e-6);
    const double sign = model.type == "pmos" ? -1 : 1;
    if (!given("phi")) c.phi = std::fmax(0.1, 2 * thermal_voltage(nominal) * std::log(c.nsub * 1e6 / intrinsic));
    if (!given("gamma")) c.gamma = std::sqrt(2 * silicon * electron_charge * c.nsub * 1e6) / C;
    if (given("vto") || given("vt0")) return {};
    const double flat_band = work_function(c, sign, c.phi, silicon_band_gap(nominal)) - c.nss * 1e4 * electron_charge / C;
    c.vto = flat_band + sign * (c.gamma * std::sqrt(c.phi) + c.phi);
    return {};
}

/// The junction of one end. cap: cbd or cbs.
BulkJunction junction(const Mos1Card& c, bool cap_given, double cap, double area, double perimeter, bool by_area, double m, double kelvin) {
    const double nominal = c.tnom + zero_celsius;
    BulkJunction out;
    out.n_vt = thermal_voltage(kelvin);
    const double growth =
        std::exp(silicon_band_gap(nominal) / thermal_voltage(nominal) - silicon_band_gap(kelvin) / thermal_voltage(kelvin));
    out.i_sat = m * growth * (by_area ? c.js * area : c.is);
    out.bottom = {m * (cap_given ? cap : c.cj * area), c.pb, c.mj, c.fc};
    out.sidewall = {m * c.cjsw * perimeter, c.pb, c.mjsw, c.fc};
    adjust_layer(out.bottom, nominal, kelvin), adjust_layer(out.sidewall, nominal, kelvin);
    return out;
}

}  // namespace

std::vector<std::string_view> mos1_parameter_names() { return model_value_names(Mos1Card::fields, others); }
std::span<const std::string_view> parameters_of_higher_levels() { return higher_levels; }

Result<Mos1Card> read_mos1_card(const Model& model) {
    auto c = TRY(read_model_card<Mos1Card>(Mos1Card::fields, model, others));
    for (const auto& [alias, name] : aliases)
        if (const auto given = model.values.find(alias); given != model.values.end())
            TRY(read_field(*std::ranges::find(Mos1Card::fields, name, &ParameterDef<Mos1Card>::name), c, model.name, given->second,
                           model.location));
    TRY(derive(c, model));
    return c;
}

/// The mobility falls as T^-1.5. The threshold follows the band gap and the surface potential, which changes as a built-in potential does.
Result<Mos1Constants> mos1_constants(const Mos1Card& c, const MosSize& size, double kelvin, bool pmos) {
    const double length = size.L - 2 * c.ld, nominal = c.tnom + zero_celsius, sign = pmos ? -1 : 1;
    if (!(length > 0)) return bad_input(fmt::format("l = {:g} m is not longer than 2 ld = {:g} m", size.L, 2 * c.ld));
    const double base = (c.phi - potential_part(nominal)) / (nominal / 300.15);
    const double phi = kelvin / 300.15 * base + potential_part(kelvin);
    if (!(phi > 0)) return bad_input(fmt::format("phi is {:g} V at {:g} C; it must be positive", phi, kelvin - zero_celsius));
    Mos1Constants out{};
    out.vbi =
        sign * c.vto - c.gamma * std::sqrt(c.phi) + sign * (silicon_band_gap(nominal) - silicon_band_gap(kelvin)) / 2 + (phi - c.phi) / 2;
    out.beta = c.kp / std::pow(kelvin / nominal, 1.5) * size.W * size.m / length;
    out.gamma = c.gamma, out.phi = phi, out.lambda = c.lambda, out.kelvin = kelvin;
    const double C = c.tox > 0 ? oxide / c.tox : 0, noise_C = C > 0 ? C : oxide / 1e-7;  // SPICE assumes 0.1 um for the noise
    out.C_ox = C * size.W * length * size.m;
    out.flicker = c.kf / (size.W * size.m * length * noise_C * noise_C), out.af = c.af;
    return out;
}

/// ngspice takes tox = 0 for an error, and does not know the parameters of higher levels.
std::string mos1_model_line(const Model& model, std::string_view name) {
    std::string out = fmt::format(".model {} {}(level=1", name, model.type);
    for (const auto& [parameter, value] : model.values) {
        const bool is_left_out = parameter == "level" || parameter == "l" || parameter == "w" || (parameter == "tox" && value == 0) ||
                                 std::ranges::find(higher_levels, std::string_view(parameter)) != std::end(higher_levels);
        if (!is_left_out) out += fmt::format(" {}={}", parameter, value);
    }
    return out + ")\n";
}

MosSurroundings mos1_surroundings(const Mos1Card& c, const Model& model, const MosSize& size, double kelvin) {
    MosSurroundings out;
    out.pmos = model.type == "pmos", out.kelvin = kelvin;
    const auto given = [&](std::string_view name) { return model.values.contains(name); };
    const auto conductance = [&](bool is_given, double r, double squares) {
        const double ohm = is_given ? r : c.rsh * squares;
        return ohm > 0 ? size.m / ohm : 0;
    };
    out.g_drain = conductance(given("rd"), c.rd, size.NRD), out.g_source = conductance(given("rs"), c.rs, size.NRS);
    out.C_gd = c.cgdo * size.W * size.m, out.C_gs = c.cgso * size.W * size.m, out.C_gb = c.cgbo * (size.L - 2 * c.ld) * size.m;
    const bool by_area = c.js > 0 && size.AD > 0 && size.AS > 0;
    out.drain = junction(c, given("cbd"), c.cbd, size.AD, size.PD, by_area, size.m, kelvin);
    out.source = junction(c, given("cbs"), c.cbs, size.AS, size.PS, by_area, size.m, kelvin);
    return out;
}

}  // namespace corpuscle::circuit
