// A UICM card from curves: known cards are found again, the intervals cover them, and what the curves cannot tell is named.

#include "fit/transistor/transistor_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/random.hpp"
#include "fit/transistor/start_values.hpp"

namespace corpuscle {
namespace {

using circuit::UicmCard;

/// Curves of a card with noise.
class Bench {
    UicmCard card_;
    std::uint64_t seed_;
    std::uint64_t drawn_ = 0;

public:
    IvData data;
    double noise = 0.01, floor = 1e-12;  // -, A
    double V_T_shift = 0, log_I_S_shift = 0;

    Bench(const UicmCard& card, std::uint64_t seed) : card_(card), seed_(seed) { add_device("", 1.5e-6, 0.5e-6); }

    void add_device(const std::string& name, double W, double L) { data.devices.push_back({name, W, L}); }

    void add(double V_G, double V_D, double V_B, double celsius, bool has_bulk_current = false) {
        IvPoint p;
        p.v = {V_D, V_G, 0, V_B}, p.temperature = celsius, p.device = static_cast<std::uint32_t>(data.devices.size() - 1);
        circuit::UicmInstance instance;
        instance.W = data.devices.back().W, instance.L = data.devices.back().L;
        instance.delvto = V_T_shift, instance.mulu0 = std::exp(log_I_S_shift);
        const circuit::TerminalVoltages v[] = {p.v};
        circuit::DrainBulkCurrents i[1];
        uicm_currents(uicm_constants(card_, instance, celsius, data.is_pmos), v, i);
        const auto relative = normal_pair(seed_, 0, 1, drawn_), absolute = normal_pair(seed_, 1, 1, drawn_++);
        p.I_D = i[0].I_D * (1 + noise * relative.first) + floor * absolute.first;
        if (has_bulk_current) p.I_B = i[0].I_B * (1 + noise * relative.second) + floor * absolute.second;
        data.points.push_back(p);
    }
    void sweep_gate(double V_D, double V_B, double celsius, double last = 1.2, double step = 0.05) {
        for (int k = 0; k * step <= last + 1e-9; ++k) add(k * step, V_D, V_B, celsius);
    }
    IvData& finished() {
        divide_into_curves(data);
        return data;
    }
};

UicmCard known_card() {
    UicmCard card;
    card.I_SQ = 140e-9, card.V_T0 = 0.43, card.n = 1.31, card.sigma_L = 12e-9, card.zeta_L = 30e-9, card.V_E = 9e6;
    card.J_S = 4e-6, card.n_dio = 1.08, card.alpha_VT = -0.8e-3, card.I_S_exponent = 0.6;
    return card;
}

IvData complete_curves(std::uint64_t seed) {
    Bench bench(known_card(), seed);
    for (const double V_D : {0.05, 0.4, 0.8}) bench.sweep_gate(V_D, 0, 27);
    bench.sweep_gate(0.4, -0.3, 27);
    for (const double celsius : {-20.0, 85.0}) bench.sweep_gate(0.4, 0, celsius);
    for (int k = 0; k <= 25; ++k) bench.add(0.2, 0.1, 0.3 + 0.0125 * k, 27, true);
    return bench.finished();
}

/// The number of draws in which the interval of a parameter holds the truth.
struct Coverage {
    std::map<std::string, int> hits = {};
    int draws = 0;

    void add(const TransistorFit& fit, const UicmCard& truth) {
        ++draws;
        for (const auto& v : fit.values)
            for (const auto& f : UicmCard::fields)
                if (f.name == v.card_name && v.low) hits[v.card_name] += *v.low <= truth.*f.member && truth.*f.member <= *v.high;
    }
    void expect(const std::vector<std::string>& names) const {
        for (const auto& name : names) {
            const double part = hits.contains(name) ? static_cast<double>(hits.at(name)) / draws : 0;
            ::testing::Test::RecordProperty(name, std::to_string(part));
            EXPECT_GE(part, 0.90) << name;
            EXPECT_LE(part, 0.99) << name;
        }
    }
};

TEST(TransistorFit, IntervalsOfAKnownCardCoverItIn90To99PercentOf200Draws) {
    Coverage coverage;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto fit = fit_transistor(complete_curves(seed), {});
        ASSERT_TRUE(fit) << fit.error().message;
        EXPECT_TRUE(fit->is_converged);
        coverage.add(*fit, known_card());
    }
    coverage.expect({"vto", "isq", "n", "sigmal", "zetal", "ve", "js", "nj", "tcv", "tis"});
}

TEST(TransistorFit, IntervalsOfMismatchCoverItIn90To99PercentOf200Draws) {
    auto card = known_card();
    card.A_VT = 4e-9, card.A_IS = 15e-9;
    TransistorFitRequest request;
    request.fit = {"vto", "isq", "n", "avt", "ais"}, request.base = card;
    Coverage coverage;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Bench bench(card, seed);
        bench.data.devices.clear();
        for (std::uint32_t d = 0; d < 24; ++d) {
            bench.add_device(std::to_string(d), d % 2 == 0 ? 1.5e-6 : 6e-6, 0.5e-6);
            const auto normal = normal_pair(seed, d, 2, 0);
            const double root = std::sqrt(bench.data.devices.back().W * 0.5e-6);
            bench.V_T_shift = card.A_VT / root * normal.first, bench.log_I_S_shift = card.A_IS / root * normal.second;
            bench.sweep_gate(0.4, 0, 27, 0.9, 0.1);
        }
        const auto fit = fit_transistor(bench.finished(), request);
        ASSERT_TRUE(fit) << fit.error().message;
        coverage.add(*fit, card);
    }
    coverage.expect({"vto", "isq", "n", "avt", "ais"});
}

TEST(TransistorFit, FindsAPmosAndItsBodyFactorWithoutNoise) {
    auto card = known_card();
    card.gamma = 0.4, card.n = 1.4;
    Bench bench(card, 1);
    bench.data.is_pmos = true, bench.noise = 0, bench.floor = 0;
    for (const double V_D : {-0.05, -0.4, -0.8})
        for (int k = 0; k <= 24; ++k) bench.add(-0.05 * k, V_D, 0, 27);
    for (int k = 0; k <= 24; ++k) bench.add(-0.05 * k, -0.4, 0.4, 27);
    TransistorFitRequest request;
    request.fit = {"all", "gamma"};
    const auto fit = fit_transistor(bench.finished(), request);
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_NEAR(fit->card.V_T0, card.V_T0, 1e-6);
    EXPECT_NEAR(fit->card.I_SQ / card.I_SQ, 1, 1e-5);
    EXPECT_NEAR(fit->card.n, card.n, 1e-5);
    EXPECT_NEAR(fit->card.gamma, card.gamma, 1e-3);
    EXPECT_NEAR(fit->card.V_E / card.V_E, 1, 1e-3);
}

TEST(TransistorFit, TheFirstValuesFollowFromTheSlopeOfTheLogarithm) {
    auto card = known_card();
    card.sigma_L = card.zeta_L = 0, card.V_E = 1e30;
    for (const double V_D : {12.9e-3, 0.5}) {
        Bench bench(card, 1);
        bench.noise = 0, bench.floor = 0;
        bench.sweep_gate(V_D, 0, 27, 0.9, 0.005);
        const auto& data = bench.finished();
        const auto start = start_values(data, CurveResiduals(data), {});
        EXPECT_NEAR(start.V_T0, card.V_T0, 5e-3) << V_D;
        EXPECT_NEAR(start.n, card.n, 0.01) << V_D;
        EXPECT_NEAR(start.I_SQ / card.I_SQ, 1, 0.1) << V_D;
    }
}

TEST(TransistorFit, SlopesAreThoseOfTheCurrents) {
    const auto data = complete_curves(1);
    const CurveResiduals residuals(data);
    std::vector<const CardParameter*> all;
    for (const auto& p : card_parameters()) all.push_back(&p);
    auto card = known_card();
    card.gamma = 0.3, card.J_SSW = 1e-12;
    const auto x = coordinates_of(card, all);
    const auto at = residuals.residuals(card, all, x, true);
    for (std::size_t j = 0; j < all.size(); ++j) {
        auto below = x, above = x;
        const double h = all[j]->difference;
        below[j] -= h, above[j] += h;
        const auto low = residuals.residuals(card, all, below, false).values, high = residuals.residuals(card, all, above, false).values;
        for (std::size_t k = 0; k < low.size(); ++k) {
            const double expected = (high[k] - low[k]) / (2 * h);
            EXPECT_NEAR(at.slopes[j][k], expected, 1e-4 * std::abs(expected) + 1e-11 / h) << all[j]->name << " " << k;
        }
    }
}

TEST(TransistorFit, NamesWhatTheCurvesCannotTellAndRefusesToFitIt) {
    const auto one_sweep = [](double V_D, double celsius, double first, double last) {
        Bench bench(known_card(), 3);
        for (double V = first; V <= last; V += 0.02) bench.add(V, V_D, 0, celsius);
        return bench.finished();
    };
    const auto sweep = one_sweep(0.4, 27, 0, 1.2), weak = one_sweep(0.4, 27, 0, 0.35), strong = one_sweep(0.4, 27, 0.7, 1.2);
    Bench output(known_card(), 3);
    for (int k = 1; k <= 20; ++k) output.add(0.5, 0.05 * k, 0, 27);
    const auto one_curve = output.finished();
    const std::tuple<const IvData*, std::string, std::string> rows[] = {
        {&one_curve, "vto", "V_G hardly varies; sweep V_G from weak to strong inversion"},
        {&one_curve, "n", "V_G and V_BS hardly vary"},
        {&sweep, "sigmal", "only one V_DS, and V_T0 contains its effect; measure saturated currents in weak inversion at two or more V_DS"},
        {&sweep, "ve", "only one V_DS"},
        {&sweep, "js", "no bulk currents (I_B) of a forward biased junction; measure I_B"},
        {&sweep, "nj", "no bulk currents"},
        {&sweep, "tcv", "all points have one temperature; measure sweeps of V_G at several temperatures"},
        {&sweep, "tis", "one temperature"},
        {&sweep, "A_VT", "there is one device; measure 10 or more equal devices"},
        {&sweep, "A_K", "there is one device"},
        {&sweep, "gamma", "V_BS does not vary; measure sweeps of V_G at several V_BS"},
        {&sweep, "jssw", "no bulk currents"},
        {&weak, "isq", "all points are in weak inversion"},
        {&weak, "zeta", "no saturated point is in strong inversion"},
        {&strong, "n", "there are 0 points in weak inversion, and V_BS does not vary; sweep V_G from 0.2 V below the threshold"},
    };
    for (const auto& [data, name, expected] : rows) {
        TransistorFitRequest request;
        request.fit = {name};
        const auto refused = fit_transistor(*data, request);
        ASSERT_FALSE(refused) << name;
        EXPECT_NE(refused.error().message.find(expected), std::string::npos) << name << ": " << refused.error().message;
    }
    const auto fit = fit_transistor(sweep, {});
    ASSERT_TRUE(fit) << fit.error().message;
    int determined = 0;
    for (const auto& v : fit->values) {
        determined += v.is_fitted;
        EXPECT_EQ(v.is_fitted, v.reason.empty()) << v.name;
    }
    EXPECT_EQ(determined, 4);  // V_T0, I_SQ, n, zeta
    EXPECT_EQ(fit->card.sigma_L, 0);
}

TEST(TransistorFit, WithoutASizeTheSpecificCurrentIsUndetermined) {
    auto data = complete_curves(1);
    data.is_geometry_known = false;
    const auto fit = fit_transistor(data, {});
    ASSERT_TRUE(fit);
    EXPECT_FALSE(fit->is_geometry_known);
    for (const auto& v : fit->values) EXPECT_EQ(v.reason.find("give --width and --length") != std::string::npos, v.card_name == "isq");
    TransistorFitRequest request;
    request.fit = {"isq"};
    EXPECT_FALSE(fit_transistor(data, request));
}

TEST(TransistorFit, ASweepBeginsAnewWhereAnotherVoltageChanges) {
    Bench bench(known_card(), 1);
    for (const double V_D : {0.1, 0.3}) bench.sweep_gate(V_D, 0, 27, 0.2);
    for (const double V_D : {0.1, 0.2, 0.3}) bench.add(0.5, V_D, 0, 27);
    bench.add(0.5, 0.1, 0, 85);
    const auto& curves = bench.finished().curves;
    ASSERT_EQ(curves.size(), 4U);
    EXPECT_EQ(curves[0].end, 5U);
    EXPECT_EQ(curves[1].swept, 1 << 1);
    EXPECT_EQ(curves[2].swept, 1 << 0);
    EXPECT_EQ(curves[3].end - curves[3].begin, 1U);
}

}  // namespace
}  // namespace corpuscle
