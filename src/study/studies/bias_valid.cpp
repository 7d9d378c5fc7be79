// How much of the printed ranges of current, supply and temperature the bias generator covers, by a measure fixed beforehand; what ends
// it; and what thresholds lower than the card's would do.

#include <fmt/format.h>
#include <cmath>

#include "signal/quantity.hpp"
#include "study/studies.hpp"
#include "study/thesis/bias_figure.hpp"

namespace corpuscle::studies::bias_valid {

using Range = BiasSweep::Range;

/// A range that is printed; of a current its share is taken in decades.
struct Printed {
    BiasAxis axis;
    const char *name, *unit, *tried;
    double typical[2], corners[2];
};
constexpr Printed printed[] = {
    {BiasAxis::current, "I_BIAS", "A", "5n 4u 1n", {100e-9, 2e-6}, {100e-9, 700e-9}},
    {BiasAxis::supply, "V_DD", "V", "0.4 1 2m", {0.55, 0.8}, {0.65, 0.75}},
    {BiasAxis::temperature, "temperature", "C", "-100 150 5", {-55, 95}, {Claim::none, Claim::none}},
};
constexpr double lower = 35e-3;  // V: the shift of the thresholds that is tried

double covered(const Printed& p, const Range& r, const double (&range)[2]) {
    if (p.axis != BiasAxis::current) return 100 * r.share_of(range[0], range[1]);
    return 100 * Range{std::log(r.from), std::log(r.to), false, false}.share_of(std::log(range[0]), std::log(range[1]));
}

Result<BiasSweep> sweep(const Printed& p, std::vector<std::string> settings) {
    return BiasSweep::along(p.axis, p.tried, std::move(settings));
}

std::string words(const Printed& p, const Range& r) {
    const auto text = [&](double v) { return p.axis == BiasAxis::temperature ? fmt::format("{:.0f} C", v) : format_quantity(v, p.unit); };
    return fmt::format("{} to {}", text(r.from), text(r.to));
}

/// The share of a printed range, and beside it what stops the generator at both ends of ours.
Result<void> claim_share(Outcome& out, const std::string& what, const Printed& p, const Range& r, const BiasSweep& low,
                         const BiasSweep& high, const double (&range)[2]) {
    auto& c =
        out.claim(fmt::format("{}: share of the printed {} covered{}", what, p.name, p.axis == BiasAxis::current ? " (in decades)" : ""),
                  covered(p, r, range), "%")
            .held_to(100, fmt::format("thesis E.2: {}", words(p, {range[0], range[1], false, false})));
    std::string note = "ours is " + words(p, r);
    for (const bool below : {true, false}) {
        const double end = below ? r.from : r.to, wanted = below ? range[0] : range[1];
        if (below ? end <= wanted : end >= wanted) continue;
        const auto why = why_it_ends(below ? low : high, end, false);
        if (!why) return why.error();
        note += fmt::format("; {}: {}", below ? "below" : "above", *why);
    }
    c.because(note);
    return {};
}

Result<void> claim_axis(Outcome& out, const Printed& p) {
    std::vector<BiasSweep> sweeps;
    std::vector<Range> works;
    for (const char* corner : {"tt", "ss", "ff"}) {
        auto s = sweep(p, {fmt::format("corner={}", corner)});
        if (!s) return s.error();
        works.push_back(s->works()), sweeps.push_back(std::move(*s));
    }
    if (auto ok = claim_share(out, "typical", p, works[0], sweeps[0], sweeps[0], p.typical); !ok) return ok;
    const auto all = common(common(works[0], works[1]), works[2]);
    const auto where = [&](bool low) {
        for (std::size_t k = 0; k < 3; ++k)
            if ((low ? works[k].from : works[k].to) == (low ? all.from : all.to)) return k;
        return std::size_t{0};
    };
    if (!std::isnan(p.corners[0])) return claim_share(out, "all corners", p, all, sweeps[where(true)], sweeps[where(false)], p.corners);
    out.finds("FF is the corner that leaves the printed temperatures first", where(false) == 2, "thesis E.2: in special for the FF corner");
    return claim_share(out, "FF", p, works[2], sweeps[2], sweeps[2], p.typical);
}

/// What stops it beyond both ends of the typical current, by the run.
Result<void> claim_causes(Outcome& out) {
    const auto s = sweep(printed[0], {});
    if (!s) return s.error();
    const auto r = s->works();
    const auto low = bias_state({bias_setting(BiasAxis::current, r.from)}), high = bias_state({bias_setting(BiasAxis::current, r.to)}),
               printed_high = bias_state({"i_bias=2u"});
    for (const auto* state : {&low, &high, &printed_high})
        if (!*state) return state->error();
    out.finds("at the lower end M4A is linear and the bulks take nothing (a thousandth)",
              low->V_M4A < low->needs_M4A && low->bulks < 1e-3 * low->asked,
              "thesis E.2: below, these transistors operate in the linear region");
    out.finds("at the upper end M3B is linear", high->V_M3B < high->needs_M3B, "thesis E.2: as above");
    out.claim("at the upper end the bulks' junctions take of I_BIAS", 100 * high->bulks / high->asked, "%");
    out.claim("at 2 uA they take", 100 * printed_high->bulks / printed_high->asked, "%");
    out.claim("V_BN at 2 uA", printed_high->V_BN, "V").printed_as(0.6, "thesis E.2: up to 600 mV");
    out.claim("I_Q at 2 uA", printed_high->I_Q, "A").held_to(2e-6, "thesis E.2: I_Q = I_BIAS up to there").because(printed_high->words());
    return {};
}

/// Bulk current over I_BIAS, and both drains' room.
Result<void> draw(Outcome& out) {
    auto found = found_in({"bias", {}, ".dc ibias 50n 3u 10n\n.save i(m3b) i(m4a)"});
    if (!found) return found.error();
    const auto I_P = found->line("dc", "i(m3b)"), I_N = found->line("dc", "i(m4a)"), V_BN = found->line("dc", "v(bn)");
    Line bulks;
    for (std::size_t k = 0; k < I_P.x.size(); ++k)
        bulks.x.push_back(1e9 * I_P.x[k]), bulks.y.push_back(-100 * (I_P.y[k] + I_N.y[k]) / I_P.x[k]);
    auto& shares = out.plot("What the bulks' junctions take from BN, typical", "I_BIAS (nA)", "% of I_BIAS");
    shares.log_x = shares.log_y = true;
    shares.add("at BN", bulks);
    auto& room = out.plot("Drain to source, typical", "I_BIAS (nA)", "V");
    room.log_x = true;
    auto of_M3B = V_BN.times(1e9, -1);
    for (double& v : of_M3B.y) v += 0.7;
    Line needed;
    for (const double I : {50e-9, 100e-9, 300e-9, 1e-6, 3e-6}) {
        const auto state = bias_state({bias_setting(BiasAxis::current, I)});
        if (!state) return state.error();
        needed.x.push_back(1e9 * I), needed.y.push_back(state->needs_M4A);
    }
    room.add("M4A", V_BN.times(1e9, 1)).add("M3B", of_M3B).add("from where they are saturated", needed);
    return {};
}

/// All thresholds lower by the shift: the printed ranges, but not the printed current without biasing.
Result<void> claim_trade(Outcome& out) {
    const std::vector<std::string> shift = {fmt::format("vtn_shift={}", -lower), fmt::format("vtp_shift={}", -lower)};
    const auto what = fmt::format("thresholds {:g} mV lower", 1e3 * lower);
    for (const auto& p : printed) {
        const auto s = sweep(p, shift);
        if (!s) return s.error();
        const auto r = s->works();
        for (const bool low : {true, false}) {
            auto& c = out.claim(fmt::format("{}, typical: works {}, {}", what, low ? "from" : "to", p.name), low ? r.from : r.to, p.unit);
            if (low && r.open_below) {
                c.at_most(p.typical[0], "thesis E.2; ours is the end of what was tried");
                continue;
            }
            c.printed_as(p.typical[low ? 0 : 1], "thesis E.2");
            auto why = why_it_ends(*s, low ? r.from : r.to, low ? r.open_below : r.open_above);
            if (!why) return why.error();
            if (c.needs_reason()) c.because(std::move(*why));
        }
    }
    const auto unbiased = found_in({"quiescent", shift, ".op"});
    if (!unbiased) return unbiased.error();
    out.claim(what + ": I_Q without biasing", unbiased->at_rest("i(visa)"), "A")
        .printed_as(17.5e-9, "thesis table 18")
        .because("this is what speaks against lower thresholds: with the card's they carry what is printed");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    double done = 0;
    for (const auto& p : printed) {
        if (auto ok = claim_axis(out, p); !ok) return ok.error();
        if (auto ok = options.at(done += 0.2); !ok) return ok.error();
    }
    if (auto ok = claim_causes(out); !ok) return ok.error();
    if (auto ok = claim_trade(out); !ok) return ok.error();
    if (auto ok = draw(out); !ok) return ok.error();
    out.note(
        "Valid: V_Q within 5 mV of half the supply and I_Q within a tenth of I_BIAS; fixed beforehand, as the thesis has no measure. "
        "Corners are three deviations of the process's spread that tables 17 and 18 give without biasing, 40 mV and 9 %.");
    out.note(
        "A saturated transistor has more than phi_t (sqrt(1 + i_f) + 3) between drain and source. M3B stands at V_DD - V_BN, M4A at V_BN.");
    return out;
}

const Study study{
    "bias-valid", "How much of the printed ranges the bias generator covers",
    "It works over currents, supplies and temperatures, typically and in corners (thesis E.2): by one measure, how much of that is "
    "ours, and what ends it?",
    work};

}  // namespace corpuscle::studies::bias_valid
