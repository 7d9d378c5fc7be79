// Transients of the same decks in Debian's ngspice and in Corpuscle: compares waveforms on a common time grid, and spike times.
//
// Comments of a deck give its tolerances. `* tolerance: 1mV` applies to every saved curve. `* tolerance: 1mV 2us` also allows a curve
// to be 2 us early or late, for edges triggered by other edges. `* spikes: v(s) 0.35` names a level that v(s) crosses upward. The number
// of crossings must be equal; the last crossing and all intervals must agree to 0.1 %.
// Transistors are expressions in ngspice and built-in devices in Corpuscle: formulas.inc and native.inc describe the same transistors.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "circuit/expression/spice_number.hpp"
#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

constexpr double spike_tolerance = 1e-3;

/// Interpolates a curve. Uses the less curved of the two parabolas through three neighbouring points, which keeps corners sharp.
/// Linear in the first and the last step.
class Wave {
    std::vector<double> t_, v_, curvature_;  // curvature_: second divided difference at each point and its two neighbours

public:
    Wave(const Curve& time, const Curve& curve) {
        for (std::size_t k = 0; k < time.values.size(); ++k) {
            const double t = time.values[k].real();
            if (!t_.empty() && !(t > t_.back())) continue;
            t_.push_back(t), v_.push_back(curve.values[k].real());
        }
        if (t_.size() < 3) return;
        const auto secant = [&](std::size_t k) { return (v_[k + 1] - v_[k]) / (t_[k + 1] - t_[k]); };
        curvature_.resize(t_.size());
        for (std::size_t k = 1; k + 1 < t_.size(); ++k) curvature_[k] = (secant(k) - secant(k - 1)) / (t_[k + 1] - t_[k - 1]);
    }
    const std::vector<double>& times() const { return t_; }
    bool is_valid() const { return !curvature_.empty(); }

    double at(double t) const {
        t = std::clamp(t, t_.front(), t_.back());
        const auto after = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
        const auto k = static_cast<std::size_t>(after - t_.begin()) - 1;
        const double curvature = std::abs(curvature_[k]) < std::abs(curvature_[k + 1]) ? curvature_[k] : curvature_[k + 1],
                     from = t - t_[k];
        return v_[k] + (v_[k + 1] - v_[k]) * from / (t_[k + 1] - t_[k]) + curvature * from * (t - t_[k + 1]);
    }
    /// Distance (V) of v from the range of the curve within +-max_shift (s) of t.
    double distance(double t, double v, double max_shift) const {
        double low = at(t), high = low;
        const auto extend = [&](double x) { low = std::min(low, x), high = std::max(high, x); };
        if (max_shift > 0) {
            extend(at(t - max_shift)), extend(at(t + max_shift));
            for (auto k = std::lower_bound(t_.begin(), t_.end(), t - max_shift); k != t_.end() && *k < t + max_shift; ++k)
                extend(v_[static_cast<std::size_t>(k - t_.begin())]);
        }
        return std::max({low - v, v - high, 0.0});
    }
    std::vector<double> rises(double level) const {
        std::vector<double> out;
        for (std::size_t k = 1; k < t_.size(); ++k) {
            if (!(v_[k - 1] < level && v_[k] >= level)) continue;
            double low = t_[k - 1], high = t_[k];
            for (int halving = 0; halving < 60; ++halving) (at((low + high) / 2) < level ? low : high) = (low + high) / 2;
            out.push_back(high);
        }
        return out;
    }
};

/// Tolerances from a deck's comments.
struct DeckTolerances {
    double volts = 0, seconds = 0, level = 0;  ///< V, s, V
    std::string spikes;                        ///< curve whose spikes are compared; empty for none
};
DeckTolerances tolerances_of(const std::string& deck) {
    DeckTolerances out;
    std::istringstream lines(deck);
    const auto number = [](std::istream& from) {
        std::string word;
        from >> word;
        const auto found = parse_number(word);
        return found ? found->value : 0;
    };
    for (std::string line, star, key; std::getline(lines, line);) {
        std::istringstream words(line);
        if (!(words >> star >> key) || star != "*") continue;
        if (key == "tolerance:") out.volts = number(words), out.seconds = number(words);
        if (key == "spikes:") words >> out.spikes, out.level = number(words);
    }
    return out;
}

std::string transient_deck(const std::string& name) { return deck_path("tran/" + name); }

constexpr std::string_view by_formulas = "formulas.inc", native = "native.inc";

std::vector<std::string> transient_decks() { return deck_names("tran"); }
std::vector<std::string> transistor_decks() {
    auto out = transient_decks();
    std::erase_if(out, [](const std::string& name) { return read_file(transient_deck(name)).find(by_formulas) == std::string::npos; });
    return out;
}

/// Runs a deck with built-in transistors instead of expressions.
RunOutcome run_with_native_transistors(const std::string& path) {
    std::string text = read_file(path);
    if (const auto at = text.find(by_formulas); at != std::string::npos) text.replace(at, by_formulas.size(), native);
    return run_corpuscle(Netlist::parse(text, path, [](const std::string& file) -> Result<std::string> { return read_file(file); }));
}

double max_distance(const Wave& result, const Wave& reference, const DeckTolerances& tolerances, double& when) {
    double worst = 0;
    for (const auto* grid : {&result.times(), &reference.times()})
        for (const double t : *grid)
            if (const double difference_V = reference.distance(t, result.at(t), tolerances.seconds); difference_V > worst)
                worst = difference_V, when = t;
    return worst;
}

/// Largest relative difference of the intervals between upward crossings, and relative difference of the last crossing.
struct SpikeDifference {
    double interval = 0, last = 0;
};
SpikeDifference spike_difference(const std::vector<double>& result, const std::vector<double>& reference) {
    SpikeDifference out;
    for (std::size_t k = 1; k < result.size(); ++k)
        out.interval = std::max(out.interval, std::abs((result[k] - result[k - 1]) / (reference[k] - reference[k - 1]) - 1));
    if (!result.empty()) out.last = std::abs(result.back() / reference.back() - 1);
    return out;
}

void compare_spikes(const std::string& name, const Wave& result, const Wave& reference, double level) {
    const auto spikes = result.rises(level), reference_spikes = reference.rises(level);
    EXPECT_EQ(spikes.size(), reference_spikes.size()) << name;
    EXPECT_GE(reference_spikes.size(), 2U) << name;
    if (spikes.size() != reference_spikes.size() || spikes.empty()) return;
    const auto difference = spike_difference(spikes, reference_spikes);
    std::printf("; %zu spikes, intervals to %.2g, the last to %.2g", spikes.size(), difference.interval, difference.last);
    EXPECT_LE(difference.interval, spike_tolerance) << name;
    EXPECT_LE(difference.last, spike_tolerance)
        << name << ": the last at " << spikes.back() << " s, in the reference at " << reference_spikes.back() << " s";
}

/// Compares every voltage that both results contain.
void compare_waves(const Plot& result, const Plot& reference, const DeckTolerances& tolerances) {
    std::printf("%zu points, reference %zu", result.point_count(), reference.point_count());
    int compared = 0;
    for (const auto& curve : reference.curves) {
        const auto* own = result.find_curve(corpuscle_name(curve.name));
        if (curve.type != "voltage" || own == nullptr) continue;
        ++compared;
        const Wave wave(result.curves[0], *own), reference_wave(reference.curves[0], curve);
        ASSERT_TRUE(wave.is_valid() && reference_wave.is_valid());
        if (tolerances.volts > 0) {
            double when = 0;
            const double difference_V = max_distance(wave, reference_wave, tolerances, when);
            std::printf("; %s %.2g V", own->name.c_str(), difference_V);
            EXPECT_LE(difference_V, tolerances.volts)
                << own->name << " at " << when << " s: " << wave.at(when) << " V, reference " << reference_wave.at(when) << " V";
        }
        if (own->name == tolerances.spikes) compare_spikes(own->name, wave, reference_wave, tolerances.level);
    }
    std::printf("\n");
    EXPECT_GE(compared, 1);
}

class TransientDeck : public testing::TestWithParam<std::string> {};

TEST_P(TransientDeck, AgreesWithNgspice) {
    const auto path = transient_deck(GetParam());
    const TemporaryFolder folder;
    const auto log = run_ngspice(path, folder / "ngspice.raw");
    const auto reference = read_raw_file(folder / "ngspice.raw");
    ASSERT_EQ(reference.size(), 1U) << log;
    const auto result = run_with_native_transistors(path).plots();
    ASSERT_EQ(result.size(), 1U);
    compare_waves(result[0], reference[0], tolerances_of(read_file(path)));
}

class TransistorDeck : public testing::TestWithParam<std::string> {};

TEST_P(TransistorDeck, AgreesBetweenExpressionsAndNativeTransistors) {
    const auto path = transient_deck(GetParam());
    const auto result = run_with_native_transistors(path).plots(), formulas = run_corpuscle(path).plots();
    ASSERT_EQ(result.size(), 1U);
    ASSERT_EQ(formulas.size(), 1U);
    compare_waves(result[0], formulas[0], tolerances_of(read_file(path)));
}

INSTANTIATE_TEST_SUITE_P(Ngspice, TransientDeck, testing::ValuesIn(transient_decks()), [](const auto& one) { return one.param; });
INSTANTIATE_TEST_SUITE_P(Here, TransistorDeck, testing::ValuesIn(transistor_decks()), [](const auto& one) { return one.param; });

}  // namespace
}  // namespace corpuscle::circuit::test
