// The algorithms in fixed-point words, checked against arithmetic in 128 bits and against the models in double precision.

#include <cmath>
#include <random>

#include "model/sensor/fixed_models.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

__extension__ using Wide = __int128;
std::mt19937_64 random_bits(1);

/// A random integer from low to high, inclusive.
std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_bits() % (static_cast<std::uint64_t>(high - low) + 1));
}

/// The operations of doc/fixed-point.md in 128 bits, which cannot overflow here. Counts the results that do not fit a word.
struct Reference {
    WordFormat format;
    std::int64_t overflows = 0;
    Wide sat(Wide x) {
        const Wide saturated = std::min<Wide>(std::max<Wide>(x, format.min()), format.max());
        overflows += saturated != x;
        return saturated;
    }
    Wide times(Factor c, Wide n) {
        const Wide power = Wide{1} << c.shift, sum = n * c.mantissa + power / 2;
        return sat(sum >= 0 ? sum / power : -((-sum + power - 1) / power));
    }
    Wide abs(Wide n) { return n < 0 ? sat(-n) : n; }
};

// Random words and factors of a format; extreme values are frequent.
Word any_word(WordFormat f) {
    switch (between(0, 9)) {
        case 0:
            return f.min();
        case 1:
            return f.max();
        case 2:
            return 0;
        default:
            return between(f.min(), f.max()) >> between(0, f.word - 1);
    }
}
Factor any_factor(WordFormat f) { return {between(0, 4) ? between(f.max() / 2 + 1, f.max()) : f.max(), static_cast<int>(between(0, 62))}; }

/// A receptor with random constants.
template <class R>
R any_receptor(WordFormat f) {
    Constants c(f);
    static const R defaults({}, 1e3, c);
    R r = defaults;
    if constexpr (requires { r.beta; }) r.beta = any_word(f);
    const auto set = [&](auto... at) { ((r.*at = any_factor(f)), ...); };
    if constexpr (std::is_same_v<R, FixedSa1a>) set(&R::k_s, &R::k_d);
    if constexpr (std::is_same_v<R, FixedFa1a>) set(&R::k);
    if constexpr (std::is_same_v<R, FixedSa1b>) set(&R::k_A, &R::k_B1, &R::k_B2, &R::k_C1, &R::k_C2);
    if constexpr (std::is_same_v<R, FixedFa1b>) set(&R::k, &R::k_A, &R::k_B);
    return r;
}

/// The currents of a receptor; the second is 0 if it has only one.
using TwoCurrents = std::array<Wide, 2>;
// One step of each receptor in wide arithmetic.
TwoCurrents wide_step(const FixedSa1a& r, FixedSa1a::State& s, Word F, Reference& w) {
    return {w.sat(r.beta + w.times(r.k_s, F) + w.times(r.k_d, w.abs(w.sat(Wide{F} - s.F)))), 0};
}
TwoCurrents wide_step(const FixedFa1a& r, FixedFa1a::State& s, Word F, Reference& w) {
    const Wide d = w.sat(Wide{F} - s.F), x = w.times(r.k, w.abs(d));
    return d > 0 ? TwoCurrents{x, 0} : TwoCurrents{0, x};
}
TwoCurrents wide_step(const FixedSa1b& r, FixedSa1b::State& s, Word F, Reference& w) {
    const Wide d = w.sat(Wide{F} - s.F), B = w.sat(w.times(r.k_B1, d) + w.times(r.k_B2, s.I_B)),
               C = w.sat(w.times(r.k_C1, d) + w.times(r.k_C2, s.I_C));
    return {w.sat(w.times(r.k_A, F) + std::max<Wide>(B, 0) + std::max<Wide>(C, 0)), 0};
}
TwoCurrents wide_step(const FixedFa1b& r, FixedFa1b::State& s, Word F, Reference& w) {
    const Wide x = w.times(r.k, w.sat(w.sat(Wide{F} - s.F) + s.I_0));
    return {x > 0 ? w.times(r.k_A, x) : w.times(r.k_B, w.abs(x)), 0};
}

/// For random constants and states, the words equal those of wide arithmetic, and every result that did not fit a word was counted.
template <class R>
void check_receptor_steps() {
    for (int n = 0; n < 250'000; ++n) {
        const int word = static_cast<int>(between(8, 32));
        const WordFormat f{word, static_cast<int>(between(0, word - 1))};
        const auto r = any_receptor<R>(f);
        typename R::State s;
        Word words[sizeof s / sizeof(Word)];
        for (auto& x : words) x = any_word(f);
        std::memcpy(&s, words, sizeof s);
        Word I[2] = {};
        Arithmetic a{f};
        Reference w{f};
        const Word F = any_word(f);
        const auto expected = wide_step(r, s, F, w);
        r.step(s, F, reinterpret_cast<Word(&)[R::Traits::outputs]>(I), a);
        ASSERT_TRUE(I[0] == expected[0] && I[1] == expected[1]) << R::Traits::name << ' ' << n;
        ASSERT_EQ(a.overflowed, w.overflows) << R::Traits::name << ' ' << n;
    }
}

TEST(FixedPoint, AMillionRandomReceptorStepsGiveTheWordsOfWideArithmeticAndCountEveryOverflow) {
    check_receptor_steps<FixedSa1a>();
    check_receptor_steps<FixedFa1a>();
    check_receptor_steps<FixedSa1b>();
    check_receptor_steps<FixedFa1b>();
}

/// A neuron with random constants.
template <class N>
N any_neuron(WordFormat f) {
    Constants c(f);
    static const N defaults({}, 1e3, c);
    N n = defaults;
    n.V_th = any_word(f), n.E_L = any_word(f), n.V_reset = any_word(f), n.ref = between(0, 2);
    if constexpr (requires { n.k_c; }) n.k_a = any_factor(f), n.k_b = any_factor(f), n.k_c = any_word(f);
    if constexpr (requires { n.k; }) n.k = any_factor(f);
    if constexpr (requires { n.I_leak0; }) n.I_leak0 = any_word(f);
    if constexpr (requires { n.k_th; }) n.k_th = any_factor(f), n.dV_th = any_word(f);
    return n;
}

/// One step of each neuron in wide arithmetic.
struct WideNeuron {
    Wide u, a, wait;
    bool spike = false;
    template <class N>
    void fire(const N& n, Wide theta, Reference& w) {
        u = n.ref > 0 ? Wide{n.V_reset} : w.sat(u - theta + n.V_reset);
        wait = n.ref, spike = true;
    }
    bool is_refractory() { return wait > 0 ? --wait, true : false; }
    void step(const FixedLifA& n, Word I, Reference& w) {
        if (is_refractory()) return;
        u = w.sat(w.times(n.k_a, I) + w.times(n.k_b, u) + n.k_c);
        if (u > n.V_th) fire(n, n.V_th, w);
    }
    void step(const FixedLifB& n, Word I, Reference& w) {
        if (is_refractory()) return;
        u = w.sat(u + w.times(n.k, w.sat(Wide{I} - n.I_leak0)));
        u > n.V_th ? fire(n, n.V_th, w) : void(u = std::max<Wide>(u, n.E_L));
    }
    void step(const FixedAdaptive& n, Word I, Reference& w) {
        a = w.times(n.k_th, a);
        if (is_refractory()) return;
        u = std::max<Wide>(w.sat(u + w.times(n.k, I)), n.E_L);
        const Wide theta = w.sat(n.V_th + a);
        if (I > 0 && u > theta) fire(n, theta, w), a = w.sat(a + n.dV_th);
    }
};

template <class N>
void check_neuron_steps() {
    for (int m = 0; m < 333'334; ++m) {
        const int word = static_cast<int>(between(8, 32));
        const WordFormat f{word, static_cast<int>(between(0, word - 1))};
        const auto n = any_neuron<N>(f);
        typename N::State s{};
        s.u = any_word(f), s.wait = between(0, 4) / 4;
        WideNeuron expected{s.u, 0, s.wait};
        if constexpr (requires { s.a; }) expected.a = s.a = any_word(f);
        Arithmetic a{f};
        Reference w{f};
        const Word I = any_word(f);
        expected.step(n, I, w);
        const auto fired = n.step(s, I, a);
        ASSERT_TRUE(s.u == expected.u && s.wait == expected.wait && fired.spike == expected.spike) << N::Traits::name << ' ' << m;
        if constexpr (requires { s.a; }) {
            ASSERT_TRUE(s.a == expected.a) << N::Traits::name << ' ' << m;
        }
        ASSERT_EQ(a.overflowed, w.overflows) << N::Traits::name << ' ' << m;
    }
}

TEST(FixedPoint, AMillionRandomNeuronStepsGiveTheWordsOfWideArithmeticAndCountEveryOverflow) {
    check_neuron_steps<FixedLifA>();
    check_neuron_steps<FixedLifB>();
    check_neuron_steps<FixedAdaptive>();
}

TEST(FixedPoint, AFactorHasTheSameRelativePrecisionAtAnyMagnitude) {
    for (const int word : {8, 13, 24, 32})
        for (double c = 1e-9; c < std::ldexp(1, word - 1) - 1; c *= 1.37) {
            Constants constants({word, 4});
            const auto f = constants.factor("c", c);
            ASSERT_FALSE(constants.error()) << c;
            EXPECT_NEAR(std::ldexp(static_cast<double>(f.mantissa), -f.shift) / c, 1, std::ldexp(1, 1 - word)) << word << ' ' << c;
        }
    Constants constants({8, 4});
    EXPECT_EQ(constants.factor("c", 0).mantissa, 0);
    EXPECT_EQ(constants.factor("c", 127.9).mantissa, 0);
    EXPECT_TRUE(constants.error()) << "127.9 rounds to 128, which does not fit 8 bits";
    Constants tiny({32, 20});
    EXPECT_EQ(tiny.factor("c", 1e-300).shift, 62);
}

/// The force that an afferent read (N) and its membrane (V), one value per sample, and its spike times (s). Sampling rate 1 kHz.
struct DigitalRun {
    std::vector<double> F, u, spikes;
};
DigitalRun run_digital(const Afferent& a, const std::vector<double>& f, std::string_view membrane) {
    std::vector<std::vector<double>> values(a.probes().size(), std::vector<double>(f.size()));
    std::vector<double*> rows;
    for (auto& v : values) rows.push_back(v.data());
    std::vector<Spike> spikes;
    ResponseBlock response{spikes, 0, rows};
    auto state = a.start();
    EXPECT_TRUE(a.respond(f, state, response));
    EXPECT_EQ(response.overflowed, 0);
    DigitalRun out;
    for (std::size_t p = 0; p < values.size(); ++p) {
        if (a.probes()[p].name == "F_read") out.F = values[p];
        if (a.probes()[p].name == membrane) out.u = values[p];
    }
    out.spikes = spike_times(spikes, Clock{1000, 1});
    return out;
}

TEST(FixedPoint, LongWordsGiveTheSpikesOfTheSampledModelInDoublePrecision) {
    for (const std::string model : {"sa1a+lif-a", "sa1a+lif-b", "sa1b+lif-a", "sa1b+lif-b", "fa1b+lif-a", "fa1b+lif-b", "fa1a+lif-b"}) {
        const auto name = "adc+" + model;
        const auto membrane = model.starts_with("fa1a") ? "u_+" : "u";
        const auto f = test::force("press", {.rate = 1e3});
        const auto words =
            run_digital(*test::afferent(name, {.settings = {name + ".frac=24", name + ".bits=16"}, .rate = 1e3}), f, membrane);
        const auto doubles =
            run_digital(*test::afferent(model, {.rate = 1e3, .method = Method::backward_euler, .sampled = true}), words.F, membrane);
        EXPECT_EQ(words.spikes, doubles.spikes) << model;
        EXPECT_FALSE(words.spikes.empty()) << model;
        for (std::size_t k = 0; k < f.size(); ++k) ASSERT_NEAR(words.u[k], doubles.u[k], 3e-5) << model << ' ' << k;
    }
}

TEST(FixedPoint, TheAdaptiveNeuronConvergesToTheExactOneAsConversionsBecomeFaster) {
    const std::string name = "adc+fa1a+adaptive", gain = ".k=200e-9";
    const auto exact = test::train("fa1a+adaptive", "press", {.settings = {"fa1a+adaptive" + gain}, .rate = 100e3});
    double before = INFINITY;
    for (const double f_s : {1e3, 10e3}) {
        const auto fixed_point =
            test::train(name, "press", {.settings = {name + gain, name + ".bits=16", name + ".f_s=" + std::to_string(f_s)}, .rate = 100e3});
        ASSERT_EQ(fixed_point.size(), exact.size()) << f_s;
        double max_error = 0;
        for (std::size_t k = 0; k < fixed_point.size(); ++k) max_error = std::max(max_error, std::abs(fixed_point[k] - exact[k]));
        EXPECT_LT(max_error, 4 / f_s);
        EXPECT_LT(max_error, before / 3);
        before = max_error;
    }
}

}  // namespace
}  // namespace corpuscle
