#include "circuit/device/gummel_poon/card.hpp"

#include "circuit/device/junction.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "core/number/elementary.hpp"

namespace corpuscle::circuit {
namespace {

constexpr ParameterDef<BipolarCard> bipolar_fields[] = {
    {"is", &BipolarCard::is, "A", 1e-40, 1e3, "saturation current of the transport between collector and emitter"},
    {"bf", &BipolarCard::bf, "", 1e-6, 1e12, "forward current gain"},
    {"nf", &BipolarCard::nf, "", 0.1, 100, "emission coefficient of the base-emitter junction"},
    {"vaf", &BipolarCard::vaf, "V", 0, 1e100, "forward Early voltage; 0: infinite"},
    {"ikf", &BipolarCard::ikf, "A", 0, 1e100, "collector current at which the forward gain falls; 0: none"},
    {"nkf", &BipolarCard::nkf, "", 0.01, 1, "exponent of the fall of the gain at high currents"},
    {"ise", &BipolarCard::ise, "A", 0, 1e3, "saturation current of the base-emitter leakage"},
    {"ne", &BipolarCard::ne, "", 0.1, 100, "emission coefficient of the base-emitter leakage"},
    {"br", &BipolarCard::br, "", 1e-6, 1e12, "reverse current gain"},
    {"nr", &BipolarCard::nr, "", 0.1, 100, "emission coefficient of the base-collector junction"},
    {"var", &BipolarCard::var, "V", 0, 1e100, "reverse Early voltage; 0: infinite"},
    {"ikr", &BipolarCard::ikr, "A", 0, 1e100, "emitter current at which the reverse gain falls; 0: none"},
    {"isc", &BipolarCard::isc, "A", 0, 1e3, "saturation current of the base-collector leakage"},
    {"nc", &BipolarCard::nc, "", 0.1, 100, "emission coefficient of the base-collector leakage"},
    {"rb", &BipolarCard::rb, "ohm", 0, 1e12, "base resistance at low currents"},
    {"irb", &BipolarCard::irb, "A", 0, 1e100,
     "base current at which the base resistance has fallen halfway to rbm; 0: it follows the base charge"},
    {"rbm", &BipolarCard::rbm, "ohm", 0, 1e12, "base resistance at high currents; default: rb"},
    {"re", &BipolarCard::re, "ohm", 0, 1e12, "emitter resistance"},
    {"rc", &BipolarCard::rc, "ohm", 0, 1e12, "collector resistance"},
    {"cje", &BipolarCard::cje, "F", 0, 1, "base-emitter capacitance at 0 V"},
    {"vje", &BipolarCard::vje, "V", 0.1, 10, "base-emitter potential"},
    {"mje", &BipolarCard::mje, "", 0, 0.999, "base-emitter grading coefficient"},
    {"cjc", &BipolarCard::cjc, "F", 0, 1, "base-collector capacitance at 0 V"},
    {"vjc", &BipolarCard::vjc, "V", 0.1, 10, "base-collector potential"},
    {"mjc", &BipolarCard::mjc, "", 0, 0.999, "base-collector grading coefficient"},
    {"xcjc", &BipolarCard::xcjc, "", 0, 1, "fraction of the base-collector capacitance that is connected behind rb"},
    {"cjs", &BipolarCard::cjs, "F", 0, 1, "substrate capacitance at 0 V"},
    {"vjs", &BipolarCard::vjs, "V", 0.1, 10, "substrate potential"},
    {"mjs", &BipolarCard::mjs, "", 0, 0.999, "substrate grading coefficient"},
    {"fc", &BipolarCard::fc, "", 0, 0.9999, "fraction of vje and vjc above which the capacitances are extrapolated linearly"},
    {"tf", &BipolarCard::tf, "s", 0, 1, "forward transit time"},
    {"xtf", &BipolarCard::xtf, "", 0, 1e6, "coefficient of the dependence of tf on the bias"},
    {"vtf", &BipolarCard::vtf, "V", 0, 1e100, "dependence of tf on the base-collector voltage; 0: none"},
    {"itf", &BipolarCard::itf, "A", 0, 1e100, "current at which tf rises; 0: at every current"},
    {"ptf", &BipolarCard::ptf, "deg", 0, 1e3, "excess phase at 1 / (2 pi tf); ignored with a warning"},
    {"tr", &BipolarCard::tr, "s", 0, 1, "reverse transit time"},
    {"iss", &BipolarCard::iss, "A", 0, 1e3, "saturation current of the substrate junction"},
    {"ns", &BipolarCard::ns, "", 0.1, 100, "emission coefficient of the substrate junction"},
    {"ibe", &BipolarCard::ibe, "A", 0, 1e3, "with ibc: saturation current of the base-emitter junction instead of is"},
    {"ibc", &BipolarCard::ibc, "A", 0, 1e3, "with ibe: saturation current of the base-collector junction instead of is"},
    {"kf", &BipolarCard::kf, "", 0, 1, "flicker noise coefficient"},
    {"af", &BipolarCard::af, "", 0.1, 10, "flicker noise exponent"},
    {"xtb", &BipolarCard::xtb, "", -100, 100, "temperature exponent of the current gains"},
    {"eg", &BipolarCard::eg, "eV", 0.1, 10, "band gap for the temperature dependence of the currents"},
    {"xti", &BipolarCard::xti, "", -100, 100, "temperature exponent of the saturation current"},
    {"tnom", &BipolarCard::tnom, "C", -273, 1000, "temperature at which the parameters were measured"},
};

/// Other names of parameters, as in ngspice.
constexpr std::pair<std::string_view, std::string_view> bipolar_aliases[] = {
    {"va", "vaf"}, {"ik", "ikf"}, {"vb", "var"},  {"pe", "vje"},   {"me", "mje"},    {"pc", "vjc"}, {"mc", "mjc"},
    {"ps", "vjs"}, {"ms", "mjs"}, {"ccs", "cjs"}, {"csub", "cjs"}, {"tref", "tnom"}, {"nk", "nkf"}};

/// Parameters of ngspice that have no effect here: temperature coefficients, the choice of other temperature laws, and rco, which turns on
/// the collector's quasi-saturation.
constexpr std::string_view absent_parameters[] = {
    "rco",   "tlev",  "tlevc", "tbf1",  "tbf2",  "tbr1", "tbr2",  "tikf1", "tikf2", "tikr1", "tikr2", "tirb1", "tirb2",
    "tnc1",  "tnc2",  "tne1",  "tne2",  "tnf1",  "tnf2", "tnr1",  "tnr2",  "trb",   "trb1",  "trb2",  "trc",   "trc1",
    "trc2",  "tre",   "tre1",  "tre2",  "trm1",  "trm2", "tvaf1", "tvaf2", "tvar1", "tvar2", "ctc",   "cte",   "cts",
    "tvjc",  "tvje",  "tvjs",  "titf1", "titf2", "ttf1", "ttf2",  "ttr1",  "ttr2",  "tmje1", "tmje2", "tmjc1", "tmjc2",
    "tmjs1", "tmjs2", "tns1",  "tns2",  "tis1",  "tis2", "tise1", "tise2", "tisc1", "tisc2", "tiss1", "tiss2"};

/// Names without effect on the simulation: ratings, and further parameters of quasi-saturation.
constexpr std::string_view ignored_parameters[] = {"vbe_max", "vbc_max", "vce_max",  "pd_max", "ic_max", "ib_max",
                                                   "te_max",  "vceo",    "icrating", "rth0",   "cth0",   "vo",
                                                   "gamma",   "qco",     "quasimod", "vg",     "cn",     "d"};

/// Names that are read apart from `bipolar_fields`.
constexpr std::string_view other_parameters[] = {"level", "subs", "c2", "c4", "va",  "ik",   "vb",   "pe", "me",
                                                 "pc",    "mc",   "ps", "ms", "ccs", "csub", "tref", "nk"};

Result<void> check_unsupported(const Model& model) {
    if (const double level = value_or(model.values, "level", 1); level != 1)
        return error_at(model.location, "{}: bipolar transistor level {:g} is not supported; use level=1", model.name, level);
    const double subs = value_or(model.values, "subs", 1);
    if (subs != 1 && subs != -1) return error_at(model.location, "{}: subs = {:g} must be 1 (vertical) or -1 (lateral)", model.name, subs);
    return {};
}

/// The rows of the card with the parameters of the model; see read_model_card().
Result<BipolarCard> read_rows(const Model& model) {
    Model known = model;
    for (const auto& names : {std::span<const std::string_view>(absent_parameters), std::span<const std::string_view>(ignored_parameters)})
        for (const auto name : names)
            if (const auto at = known.values.find(name); at != known.values.end()) known.values.erase(at);
    auto c = TRY(read_model_card<BipolarCard>(bipolar_fields, known, other_parameters));
    for (const auto& [alias, name] : bipolar_aliases)
        if (const auto given = model.values.find(alias); given != model.values.end())
            TRY(read_field(*std::ranges::find(bipolar_fields, name, &ParameterDef<BipolarCard>::name), c, model.name, given->second,
                           model.location));
    return c;
}

}  // namespace

std::vector<std::string_view> bipolar_parameter_names() {
    auto out = model_value_names(bipolar_fields, other_parameters);
    out.insert(out.end(), std::begin(ignored_parameters), std::end(ignored_parameters));
    return out;
}

std::span<const std::string_view> absent_bipolar_parameters() { return absent_parameters; }

Result<BipolarCard> read_bipolar_card(const Model& model) {
    TRY(check_unsupported(model));
    auto c = TRY(read_rows(model));
    const auto has = [&](std::string_view name) { return model.values.contains(name); };
    if (!has("rbm")) c.rbm = c.rb;
    if (c.rbm > c.rb && c.rb > 0)
        return error_at(model.location, "{}: rbm = {:g} ohm must not exceed rb = {:g} ohm", model.name, c.rbm, c.rb);
    if (!has("ise")) c.ise = value_or(model.values, "c2", 0) * c.is;
    if (!has("isc")) c.isc = value_or(model.values, "c4", 0) * c.is;
    if (c.ibe == 0 || c.ibc == 0) c.ibe = c.ibc = c.is;
    c.is_pnp = model.type == "pnp";
    c.is_lateral = value_or(model.values, "subs", c.is_pnp ? -1 : 1) < 0;
    return c;
}

BipolarCard adjust_bipolar_card(BipolarCard c, double area, double kelvin) {
    const double nominal = c.tnom + zero_celsius, ratio = kelvin / nominal;  // nominal: K
    const double exponent = (ratio - 1) * c.eg / thermal_voltage(kelvin) + c.xti * num::log(ratio);
    const double gain = num::exp(c.xtb * num::log(ratio));
    for (double* current : {&c.is, &c.ibe, &c.ibc, &c.iss}) *current *= num::exp(exponent);
    c.bf *= gain, c.br *= gain;
    c.ise *= num::exp(exponent / c.ne) / gain, c.isc *= num::exp(exponent / c.nc) / gain,
        adjust_junction(c.cje, c.vje, c.mje, nominal, kelvin);
    adjust_junction(c.cjc, c.vjc, c.mjc, nominal, kelvin);
    adjust_junction(c.cjs, c.vjs, c.mjs, nominal, kelvin);
    for (double* scaled : {&c.is, &c.ibe, &c.ibc, &c.ikf, &c.ise, &c.ikr, &c.isc, &c.irb, &c.iss, &c.itf, &c.cje, &c.cjc, &c.cjs})
        *scaled *= area;
    for (double* resistance : {&c.rb, &c.rbm, &c.re, &c.rc}) *resistance /= area;
    return c;
}

}  // namespace corpuscle::circuit
