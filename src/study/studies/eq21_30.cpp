// Eq. 21 to 30, the unified current control model: what the simulated transistor does beside what they say, as the errata read them.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/device/constants.hpp"
#include "study/deck.hpp"
#include "study/studies.hpp"
#include "study/thesis/array_text.hpp"

namespace corpuscle::studies::eq21_30 {

constexpr double W_by_L = 3, I_S = plain_I_SQ * W_by_L, V_S = 0.1, same = 1e-6;  // V; %: to what is solved
const double phi_t = circuit::thermal_voltage(300.15);

/// A transistor at many voltages, by its currents, its inversion and the slopes that the solved circuit has.
struct At {
    double V_G, V_D, I_D, i_f, i_r, by_G, by_D, by_S, by_B;
};

/// `alone`: the slopes of the channel without the junctions' beside it.
Result<std::vector<At>> everywhere(std::string_view card, const std::string& model, bool alone = false) {
    const auto found = all_found_in(
        {fmt::format(
             "a transistor\n{}vd d 0 {{vd}}\nvg g 0 {{vg}}\nvs s 0 {}\nvb b 0 0\nm1 d g s b {} w=1.5u l=0.5u\n.param vg=0.5 vd=0.5\n", card,
             V_S, model),
         {},
         ".op\n.tf i(vd) vg\n.tf i(vd) vd\n.tf i(vd) vs\n.tf i(vd) vb\n.step param vg 0.1 1.3 0.1\n.step param vd list 0.12 0.2 0.6"});
    if (!found) return found.error();
    std::vector<At> out;
    for (const auto& f : *found) {
        const auto slope = [&](const char* source, const char* reading) {
            return alone ? f.reading("m1", reading) : -f.by("i(vd)", source);
        };
        out.push_back({f.at_rest("v(g)"), f.at_rest("v(d)"), -f.at_rest("i(vd)"), f.reading("m1", "i_f"), f.reading("m1", "i_r"),
                       slope("vg", "g_mg"), slope("vd", "g_md"), slope("vs", "g_ms") * (alone ? -1 : 1), slope("vb", "g_mb")});
    }
    return out;
}

/// sqrt(1 + i) - 1, for the least i too.
double charge(double i) { return i / (std::sqrt(1 + i) + 1); }
double f_of(double i) { return charge(i) - 1 + std::log(charge(i)); }

/// The largest share, in %, by which something is not what an equation has it to be.
double farthest(const std::vector<At>& all, double (*off)(const At&)) {
    double most = 0;
    for (const auto& at : all) most = std::max(most, std::abs(off(at)));
    return 100 * most;
}

struct Equation {
    const char *what, *source;
    double (*off)(const At&);
};
constexpr Equation equations[] = {
    {"(21): I_D is off I_S (i_f - i_r) at most by", "thesis eq. 21", [](const At& a) { return a.I_D / (I_S * (a.i_f - a.i_r)) - 1; }},
    {"(23) to (25): f(i_f) is off (V_GB - V_T0 - n V_SB)/(n phi_t) at most by, of phi_t", "thesis eq. 23 to 25; errata U4",
     [](const At& a) { return f_of(a.i_f) - (a.V_G - plain_V_T0 - plain_n * V_S) / (plain_n * phi_t); }},
    {"(23) to (25): f(i_r), with V_DB, at most by", "thesis eq. 23 to 25",
     [](const At& a) { return f_of(a.i_r) - (a.V_G - plain_V_T0 - plain_n * a.V_D) / (plain_n * phi_t); }},
    {"(27): g_mg + g_md + g_mb is off g_ms at most by", "thesis eq. 27; g_ms = -dI_D/dV_S",
     [](const At& a) { return (a.by_G + a.by_D + a.by_B) / -a.by_S - 1; }},
    {"(28): g_ms is off 2 I_S/phi_t (sqrt(1 + i_f) - 1) at most by", "thesis eq. 28",
     [](const At& a) { return -a.by_S * phi_t / (2 * I_S * charge(a.i_f)) - 1; }},
    {"(28): g_md, with i_r, of g_ms", "thesis eq. 28", [](const At& a) { return (a.by_D - 2 * I_S / phi_t * charge(a.i_r)) / -a.by_S; }},
    {"(29), corrected: g_mb/g_mg is off n - 1 at most by", "errata U5", [](const At& a) { return a.by_B / a.by_G / (plain_n - 1) - 1; }},
    {"(30): g_mg is off (g_ms - g_md)/n at most by", "thesis eq. 30",
     [](const At& a) { return a.by_G * plain_n / (-a.by_S - a.by_D) - 1; }},
};

void put_errata(Outcome& out, const std::vector<At>& all) {
    out.finds("(26): dI_D/dV_S is negative everywhere; g_ms > 0 of (27) and (28) is its opposite",
              std::all_of(all.begin(), all.end(), [](const At& a) { return a.by_S < 0; }), "errata U2");
    const auto& a = all.back();
    out.claim("g_mb/g_mg", a.by_B / a.by_G).held_to(plain_n - 1, "thesis eq. 29, upside down: errata U5");
    out.finds("g_mg/g_mb, as (29) prints it, is 1/(n - 1) and not n - 1", std::abs(a.by_G / a.by_B * (plain_n - 1) - 1) < 1e-9,
              "errata U5");
}

/// f(i), and what it comes to at its ends.
Plot picture() {
    Plot out{"Eq. 23: inversion along the pinch-off voltage", "(V_P - V_S)/phi_t", "i_f", {}, false, true};
    Line exact, weak, strong;
    for (double u = -2.3; u < 1.4; u += 0.05) {
        const double q = std::pow(10, u), i = q * (q + 2), x = f_of(i);
        exact.x.push_back(x), exact.y.push_back(i);
        if (x < 1) weak.x.push_back(x), weak.y.push_back(2 * std::exp(x + 1));
        if (x > 1) strong.x.push_back(x), strong.y.push_back(x * x);
    }
    return out.add("eq. 23", exact).add("weak: 2 exp(x + 1), as eq. 42", weak).add("strong: x^2", strong);
}

Result<Outcome> work(const StudyOptions&) {
    const auto plain = everywhere(plain_card, "plain"), whole = everywhere(whole_card, "nch"),
               channel = everywhere(whole_card, "nch", true);
    if (!plain || !whole || !channel) return !plain ? plain.error() : !whole ? whole.error() : channel.error();
    Outcome out;
    for (const auto& e : equations) out.claim(e.what, farthest(*plain, e.off), "%").at_most(same, e.source);
    put_errata(out, *plain);
    const auto pinched =
        found_in({fmt::format("pinch-off\n{}vd d 0 1\nvg g 0 {}\nm1 d g 0 0 plain w=1u l=1u\n", plain_card, plain_V_T0), {}, ".op"});
    if (!pinched) return pinched.error();
    out.claim("(23): i_f where V_P = V_S", pinched->reading("m1", "i_f")).held_to(3, "thesis eq. 23; errata U4");
    const auto card = circuit_of({fmt::format("card\n{}m1 0 0 0 0 nch w=1u l=1u\n", whole_card), {}, ".op"});
    if (!card) return card.error();
    for (const auto& m : (*card)->models)
        if (m.name == "nch")
            out.claim("(22): mobility that the card's I_SQ, C_ox and n ask for",
                      2e4 * m.values.at("isq") / (m.values.at("cox") * m.values.at("n") * phi_t * phi_t), "cm^2/(V s)")
                .between(200, 500, "usual for electrons at 0.18 um");
    for (const auto& e : {equations[3], equations[6], equations[7]}) {
        out.claim(fmt::format("With the circuits' card, its channel alone, {}", e.what), farthest(*channel, e.off), "%")
            .at_most(same, e.source);
        out.claim(fmt::format("The same with its junctions, {}", e.what), farthest(*whole, e.off), "%");
    }
    out.claim(fmt::format("With the circuits' card, {}", equations[4].what), farthest(*whole, equations[4].off), "%");
    out.note(
        "The circuits' card adds velocity saturation and length modulation to these equations: (27), (29) and (30) stay, (28) is off by "
        "what they add, most "
        "in strong inversion.");
    out.plots = {picture()};
    return out;
}

const Study study{"eq21-30", "The transistor's equations",
                  "Currents, inversion and slopes of the unified current control model. Thesis app. A, eq. 21 to 30; errata U2, U4, U5",
                  work};

}  // namespace corpuscle::studies::eq21_30
