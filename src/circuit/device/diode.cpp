// The junction diode of SPICE, level 1.

#include "circuit/device/device_kind.hpp"
#include "circuit/device/junction.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

/// Parameters of a .model line; see `fields`.
struct DiodeCard {
    double is = 1e-14, n = 1, rs = 0, cjo = 0, vj = 1, m = 0.5, fc = 0.5, tt = 0, bv = 0, ibv = 1e-3, eg = 1.11, xti = 3, kf = 0, af = 1,
           tnom = 27, jsw = 0, cjsw = 0, vjsw = 1, mjsw = 0.33, fcs = 0.5, ns = 0, nbv = 0, ikf = 0, ikr = 0, isr = 0, nr = 2, trs1 = 0,
           trs2 = 0, tcv = 0, tbv1 = 0, tbv2 = 0, tikf = 0, ttt1 = 0, ttt2 = 0, tm1 = 0, tm2 = 0;
};

constexpr ParameterDef<DiodeCard> fields[] = {
    {"is", &DiodeCard::is, "A", 1e-40, 1e3, "saturation current"},
    {"n", &DiodeCard::n, "", 0.1, 100, "emission coefficient"},
    {"rs", &DiodeCard::rs, "ohm", 0, 1e12, "series resistance"},
    {"cjo", &DiodeCard::cjo, "F", 0, 1, "junction capacitance at 0 V"},
    {"vj", &DiodeCard::vj, "V", 0.1, 10, "junction potential"},
    {"m", &DiodeCard::m, "", 0, 0.95, "grading coefficient"},
    {"fc", &DiodeCard::fc, "", 0, 0.95, "fraction of vj above which the capacitance is extrapolated linearly"},
    {"tt", &DiodeCard::tt, "s", 0, 1, "transit time"},
    {"bv", &DiodeCard::bv, "V", 0, 1e6, "breakdown voltage; 0: none"},
    {"ibv", &DiodeCard::ibv, "A", 1e-15, 1e3, "current at the breakdown voltage"},
    {"eg", &DiodeCard::eg, "eV", 0.1, 10, "band gap"},
    {"xti", &DiodeCard::xti, "", -100, 100, "temperature exponent of the saturation current"},
    {"kf", &DiodeCard::kf, "", 0, 1, "flicker noise coefficient"},
    {"af", &DiodeCard::af, "", 0.1, 10, "flicker noise exponent"},
    {"tnom", &DiodeCard::tnom, "C", -273, 1000, "temperature at which the parameters were measured"},
    {"jsw", &DiodeCard::jsw, "A", 0, 1e3, "saturation current of the sidewall, for a perimeter of 1"},
    {"cjsw", &DiodeCard::cjsw, "F", 0, 1, "sidewall capacitance at 0 V, for a perimeter of 1"},
    {"vjsw", &DiodeCard::vjsw, "V", 0.1, 10, "junction potential of the sidewall"},
    {"mjsw", &DiodeCard::mjsw, "", 0, 0.95, "grading coefficient of the sidewall"},
    {"ns", &DiodeCard::ns, "", 0, 100, "emission coefficient of the sidewall; 0: n"},
    {"nbv", &DiodeCard::nbv, "", 0, 100, "emission coefficient of the breakdown; 0: n"},
    {"fcs", &DiodeCard::fcs, "", 0, 0.95, "fraction of vjsw above which the sidewall capacitance is extrapolated linearly"},
    {"ikf", &DiodeCard::ikf, "A", 0, 1e6, "knee of the forward current, from which injection is high; 0: none"},
    {"ikr", &DiodeCard::ikr, "A", 0, 1e6, "knee of the reverse current; 0: none"},
    {"isr", &DiodeCard::isr, "A", 0, 1e3, "saturation current of the recombination in the depletion layer"},
    {"nr", &DiodeCard::nr, "", 0.1, 100, "emission coefficient of the recombination"},
    {"trs1", &DiodeCard::trs1, "1/K", -1, 1, "linear temperature coefficient of rs"},
    {"trs2", &DiodeCard::trs2, "1/K^2", -1, 1, "quadratic temperature coefficient of rs"},
    {"tcv", &DiodeCard::tcv, "V/K", -100, 100, "decrease of bv with the temperature"},
    {"tbv1", &DiodeCard::tbv1, "1/K", -1, 1, "linear temperature coefficient of bv"},
    {"tbv2", &DiodeCard::tbv2, "1/K^2", -1, 1, "quadratic temperature coefficient of bv"},
    {"tikf", &DiodeCard::tikf, "1/K", -1, 1, "linear temperature coefficient of ikf"},
    {"ttt1", &DiodeCard::ttt1, "1/K", -1, 1, "linear temperature coefficient of tt"},
    {"ttt2", &DiodeCard::ttt2, "1/K^2", -1, 1, "quadratic temperature coefficient of tt"},
    {"tm1", &DiodeCard::tm1, "1/K", -1, 1, "linear temperature coefficient of m"},
    {"tm2", &DiodeCard::tm2, "1/K^2", -1, 1, "quadratic temperature coefficient of m"},
};

/// Other names of parameters, as in ngspice and Xyce.
constexpr std::pair<std::string_view, std::string_view> aliases[] = {{"cj0", "cjo"},   {"cj", "cjo"},   {"js", "is"},    {"pb", "vj"},
                                                                     {"mj", "m"},      {"cjp", "cjsw"}, {"php", "vjsw"}, {"isw", "jsw"},
                                                                     {"tref", "tnom"}, {"vb", "bv"},    {"ik", "ikf"},   {"trs", "trs1"}};

/// Names that are read apart from `fields`.
constexpr std::string_view other_fields[] = {"level", "cj0", "cj", "js", "pb", "mj", "cjp", "php", "isw", "tref", "vb", "ik", "trs", "rsw"};

/// Parameters of ngspice, PSpice and LTspice that have no effect here: a second reverse exponential, tunnel currents, the knee of the
/// sidewall, other laws of temperature, recovery, self-heating, ratings, and the sizes of overlapping layers.
constexpr std::string_view ignored_fields[] = {"ibvl",   "nbvl",   "jtun",   "jtunsw", "ntun", "xtitun", "keg",  "ikp",  "tlev", "tlevc",
                                               "cta",    "ctc",    "ctp",    "tpb",    "tphp", "tcjo",   "vp",   "rth0", "cth0", "fv_max",
                                               "bv_max", "id_max", "te_max", "pd_max", "lm",   "lp",     "wm",   "wp",   "xom",  "xoi",
                                               "xm",     "xp",     "xw",     "l",      "w",    "sw_et",  "vjmax"};

/// Changes the card to its values at another temperature, after SPICE.
void adjust_to_temperature(DiodeCard& c, double kelvin) {
    const double nominal = c.tnom + zero_celsius, ratio = kelvin / nominal, vt = thermal_voltage(kelvin);  // nominal: K
    const double growth = num::exp((ratio - 1) * c.eg / (c.n * vt) + c.xti / c.n * num::log(ratio));
    c.is *= growth, c.jsw *= growth;
    c.isr *= num::exp((ratio - 1) * c.eg / (c.nr * vt) + c.xti / c.nr * num::log(ratio));
    const double dT = kelvin - nominal;
    const auto factor = [dT](double linear, double quadratic) { return 1 + linear * dT + quadratic * dT * dT; };
    c.rs *= std::max(factor(c.trs1, c.trs2), 1e-6), c.ikf *= std::max(factor(c.tikf, 0), 1e-6);
    c.tt *= std::max(factor(c.ttt1, c.ttt2), 0.0), c.m = std::clamp(c.m * factor(c.tm1, c.tm2), 0.0, 0.95);
    if (c.bv > 0) c.bv = std::max(c.bv * factor(c.tbv1, c.tbv2) - c.tcv * dT, 1e-3);
    adjust_junction(c.cjo, c.vj, c.m, nominal, kelvin);
    adjust_junction(c.cjsw, c.vjsw, c.mjsw, nominal, kelvin);
}

/// Current from anode to cathode: i = is (exp(v / (n V_t)) - 1), nearly constant below -3 n V_t as in SPICE, and the same with jsw and ns
/// for the sidewall. Breakdown at -bv: i = -is exp(-(v + bv') / (nbv V_t)), where bv' is such that the current at -bv is -ibv.
/// Recombination adds isr (exp(v / (nr V_t)) - 1) ((1 - v/vj)^2 + 0.005)^(m/2). High injection reduces the sum i of the area to
/// i / (1 + sqrt(i / ikf)), and the reverse one with ikr. These are the equations of ngspice 39. It has no recombination below -3 n V_t,
/// where its current jumps.
/// Charge: depletion charge (the integral of cjo / (1 - v/vj)^m, continued as a parabola above fc vj) plus transit charge tt i.
/// Unknowns: anode, cathode and, if rs > 0, the node between rs and the junction.
class Diode final : public Device {
    DiodeCard c_;
    double area_, perimeter_;
    double is_;                                  // A: saturation current of area and sidewall, where they have one emission coefficient
    double is_sidewall_ = 0;                     // A: that of a sidewall with its own emission coefficient
    double n_vt_, v_crit_;                       // V: see limit_junction()
    double n_vt_sidewall_ = 0, n_vt_breakdown_;  // V: the same of sidewall and breakdown
    double v_breakdown_;                         // V: breakdown below -v_breakdown_

    /// Current and conductance at the junction voltage v.
    ValueSlope current(double v) const {
        auto out = current_of_area(v);
        if (is_sidewall_ == 0) return out;
        const auto sidewall = junction_current(v, is_sidewall_, n_vt_sidewall_);
        return {out.value + sidewall.value, out.slope + sidewall.slope};
    }
    ValueSlope current_of_area(double v) const {
        auto out = exponential_current(v);
        if (c_.isr > 0) {
            const auto recombination = recombination_current(v);
            out.value += recombination.value, out.slope += recombination.slope;
        }
        const double knee = (out.value > 0 ? c_.ikf : c_.ikr) * area_;
        if (knee == 0 || out.value == 0) return out;
        const double root = std::sqrt(std::abs(out.value) / knee);
        return {out.value / (1 + root), out.slope * (1 + root / 2) / ((1 + root) * (1 + root))};
    }
    ValueSlope recombination_current(double v) const {
        const double n_vt = c_.nr * n_vt_ / c_.n, e = std::exp(v / n_vt), barrier = 1 - v / c_.vj, square = barrier * barrier + 0.005;
        const double width = std::pow(square, c_.m / 2), widening = -c_.m / c_.vj * barrier * width / square;
        return {c_.isr * area_ * (e - 1) * width, c_.isr * area_ * (e / n_vt * width + (e - 1) * widening)};
    }
    ValueSlope exponential_current(double v) const {
        if (c_.bv == 0 || v >= -v_breakdown_ || v >= -3 * n_vt_) return junction_current(v, is_, n_vt_);
        const double e = std::exp(-(v_breakdown_ + v) / n_vt_breakdown_);
        return {-is_ * e, is_ * e / n_vt_breakdown_};
    }
    /// Charge and capacitance of the depletion layers of area and sidewall at the junction voltage v.
    ValueSlope depletion(double v) const {
        auto out = depletion_charge(v, c_.cjo * area_, c_.vj, c_.m, c_.fc);
        if (perimeter_ == 0) return out;
        const auto sidewall = depletion_charge(v, c_.cjsw * perimeter_, c_.vjsw, c_.mjsw, c_.fcs);
        return {out.value + sidewall.value, out.slope + sidewall.slope};
    }
    /// Index of the junction's anode among the unknowns; the cathode is unknown 1.
    std::size_t junction_anode() const { return c_.rs > 0 ? 2 : 0; }

public:
    Diode(DiodeCard card, double area, double perimeter, double kelvin) : c_(card), area_(area), perimeter_(perimeter) {
        adjust_to_temperature(c_, kelvin);
        const double vt = thermal_voltage(kelvin);
        if (c_.ns == 0) c_.ns = c_.n;
        const bool is_one_junction = c_.ns == c_.n && c_.ikf == 0 && c_.ikr == 0;
        is_ = c_.is * area_ + (is_one_junction ? c_.jsw * perimeter_ : 0);
        is_sidewall_ = is_one_junction ? 0 : c_.jsw * perimeter_, n_vt_sidewall_ = c_.ns * vt;
        n_vt_ = c_.n * vt, n_vt_breakdown_ = (c_.nbv > 0 ? c_.nbv : c_.n) * vt;
        v_crit_ = critical_voltage(is_, n_vt_);
        v_breakdown_ = c_.bv;
        if (c_.bv > 0 && c_.ibv > is_)  // so that the current at bv is ibv
            v_breakdown_ = c_.bv - n_vt_breakdown_ * std::log(c_.ibv / is_);
    }
    bool is_linear() const override { return false; }
    std::size_t limiting_state_size() const override { return 1; }
    bool limit(std::span<double> v, std::span<double> state) const override {
        double u = v[junction_anode()] - v[1];
        const double unlimited = u;
        bool shortened = false;
        if (c_.bv > 0 && u < std::min(0.0, -c_.bv + 10 * n_vt_)) {
            double mirrored = -(u + c_.bv);  // forward voltage of the breakdown exponential
            shortened = limit_junction(mirrored, -(state[0] + c_.bv), n_vt_breakdown_, v_crit_);
            u = -(mirrored + c_.bv);
        } else {
            shortened = limit_junction(u, state[0], n_vt_, v_crit_);
        }
        state[0] = u;
        v[junction_anode()] += u - unlimited;
        return shortened;
    }
    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        const std::size_t a = junction_anode();
        const double u = v[a] - v[1];
        auto [i, g] = current(u);
        auto [q, c] = depletion(u);
        q += c_.tt * i, c += c_.tt * g;
        i += context.gmin * u, g += context.gmin;
        Stamp::add_between(out.f, a, 1, i), Stamp::add_between(out.q, a, 1, q);
        out.add_conductance(a, 1, g), out.add_capacitance(a, 1, c);
        if (a == 0) return;
        const double series = area_ / c_.rs;
        Stamp::add_between(out.f, 0, 2, series * (v[0] - v[2]));
        out.add_conductance(0, 2, series);
    }
    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const double i = std::abs(current(v[junction_anode()] - v[1]).value);
        std::vector<NoiseSource> out = {{"shot", junction_anode(), 1, 2 * electron_charge * i, 0}};
        if (c_.kf > 0) out.push_back({"flicker", junction_anode(), 1, 0, c_.kf * std::pow(i, c_.af), true});
        if (c_.rs > 0) out.push_back({"thermal", 0, 2, 4 * electron_charge * (n_vt_ / c_.n) * area_ / c_.rs, 0});  // 4 k T / R
        return out;
    }
    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const double u = v[junction_anode()] - v[1];
        const auto [i, g] = current(u);
        return {{"v", "V", u}, {"i", "A", i}, {"g", "S", g}, {"c", "F", depletion(u).slope + c_.tt * g}};
    }
};

Result<std::unique_ptr<Device>> make_diode(const Element& e, DeviceSetup& setup) {
    const auto& model = *setup.circuit().model_of(e);
    if (const double area = value_or(e.values, "area", 1); !(area > 0))
        return error_at(e.location, "{}: area = {:g} must be positive", e.name, area);
    const double perimeter = value_or(e.values, "pj", 0);
    if (!(perimeter >= 0)) return error_at(e.location, "{}: pj = {:g} must not be negative", e.name, perimeter);
    if (const double level = value_or(model.values, "level", 1); level != 1)
        return error_at(model.location, "{}: diode level {:g} is not supported; use level=1", model.name, level);
    auto c = TRY(read_model_card<DiodeCard>(fields, model, other_fields));
    for (const auto& [alias, name] : aliases)
        if (const auto given = model.values.find(alias); given != model.values.end())
            TRY(read_field(*std::ranges::find(fields, name, &ParameterDef<DiodeCard>::name), c, model.name, given->second, model.location));
    if (value_or(model.values, "rsw", 0) != 0)
        return error_at(model.location, "{}: rsw is not supported (the sidewall of this diode has no resistance of its own); remove it",
                        model.name);
    auto unknowns = setup.ends(e);
    if (c.rs > 0) unknowns.push_back(setup.add_unknown(e.name + "#junction"));
    return make_device<Diode>(std::move(unknowns), c, value_or(e.values, "area", 1) * value_or(e.values, "m", 1),
                              perimeter * value_or(e.values, "m", 1), setup.temperature(e));
}

Result<void> read_diode(ElementReader& line) {
    TRY(line.nodes(2, "anode, cathode, then the model"));
    if (line.word_count() < 4) return line.error_at(3, "its model is missing");
    TRY(line.model(3, {"d"}));
    line.drop_unknown_model_values(model_value_names(fields, other_fields), ignored_fields);
    for (std::size_t k = 4; k < line.word_count(); ++k) {
        if (line.text(k) == "off") {
            line.element.values["off"] = 1;
            continue;
        }
        if (k > 4 || line.find("area")) return line.too_many(k);
        line.element.values["area"] = TRY(line.number(k));
    }
    return {};
}

Result<std::string> write_diode(const ElementExport& e) {
    for (const std::string_view name : {"tbv2", "tikf"})
        if (value_or(e.model()->values, name, 0) != 0)
            return error_at(e.model()->location, "{}: ngspice has no {}, so it cannot be exported", e.model()->name, name);
    const double perimeter = e.value("pj", 0) * e.value("m", 1);
    return fmt::format("{} {} area={}{}{}\n", e.head, e.names.model(e.element.model), e.value("area", 1) * e.value("m", 1),
                       perimeter > 0 ? fmt::format(" pj={}", perimeter) : "", e.temperature());
}

constexpr ElementParameter diode_parameters[] = {{"area", "", above_zero, unlimited, 1}, parameter_m, parameter_temp, parameter_dtemp};
constexpr std::string_view diode_names[] = {"pj", "ic", "off"};

}  // namespace

extern constexpr DeviceKind diode_kind = {.letter = 'd',
                                          .description = "junction diode",
                                          .gmin = 1e-12,
                                          .read = read_diode,
                                          .make = make_diode,
                                          .parameters = diode_parameters,
                                          .other_names = diode_names,
                                          .saves_terminal_current = true,
                                          .write_spice = write_diode};

}  // namespace corpuscle::circuit
