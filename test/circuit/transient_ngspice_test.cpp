// The same decks in time through Debian's ngspice and through us, in one run: waves on one grid of times, and when an edge comes.
//
// A deck says how near it must be held in its comments: `* within: 1m` is volts of every curve that is saved; `* within: 1m 2u` also
// lets a wave be so many seconds early or late, as an edge is that something else sets off. `* spikes: v(s) 0.35` names a level that
// v(s) rises through: as many times in both, after the same time and at the same distances, to 0.1 %.
// Transistors are formulas in the one and our own device in the other: formulas.inc and native.inc say the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "circuit/netlist/spice_number.hpp"
#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

constexpr double share_of_interval = 1e-3;

/// A curve between its points: of the two parabolas through three of them, the one that bends less, so that corners stay corners;
/// straight in the first step and the last.
class Wave {
    std::vector<double> t_, v_, bend_;  // bend_: of the three points around one, the second divided difference

public:
    Wave(const Curve& time, const Curve& curve) {
        for (std::size_t k = 0; k < time.values.size(); ++k) {
            const double t = time.values[k].real();
            if (!t_.empty() && !(t > t_.back())) continue;
            t_.push_back(t), v_.push_back(curve.values[k].real());
        }
        if (t_.size() < 3) return;
        const auto secant = [&](std::size_t k) { return (v_[k + 1] - v_[k]) / (t_[k + 1] - t_[k]); };
        bend_.resize(t_.size());
        for (std::size_t k = 1; k + 1 < t_.size(); ++k) bend_[k] = (secant(k) - secant(k - 1)) / (t_[k + 1] - t_[k - 1]);
    }
    const std::vector<double>& times() const { return t_; }
    bool drawn() const { return !bend_.empty(); }

    double at(double t) const {
        t = std::clamp(t, t_.front(), t_.back());
        const auto after = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
        const auto k = static_cast<std::size_t>(after - t_.begin()) - 1;
        const double bend = std::abs(bend_[k]) < std::abs(bend_[k + 1]) ? bend_[k] : bend_[k + 1], from = t - t_[k];
        return v_[k] + (v_[k + 1] - v_[k]) * from / (t_[k + 1] - t_[k]) + bend * from * (t - t_[k + 1]);
    }
    /// How far v is from all that the wave is within `early_or_late` of t.
    double distance(double t, double v, double early_or_late) const {
        double low = at(t), high = low;
        const auto take = [&](double x) { low = std::min(low, x), high = std::max(high, x); };
        if (early_or_late > 0) {
            take(at(t - early_or_late)), take(at(t + early_or_late));
            for (auto k = std::lower_bound(t_.begin(), t_.end(), t - early_or_late); k != t_.end() && *k < t + early_or_late; ++k)
                take(v_[static_cast<std::size_t>(k - t_.begin())]);
        }
        return std::max({low - v, v - high, 0.0});
    }
    std::vector<double> rises(double level) const {
        std::vector<double> out;
        for (std::size_t k = 1; k < t_.size(); ++k) {
            if (!(v_[k - 1] < level && v_[k] >= level)) continue;
            double low = t_[k - 1], high = t_[k];
            for (int halves = 0; halves < 60; ++halves) (at((low + high) / 2) < level ? low : high) = (low + high) / 2;
            out.push_back(high);
        }
        return out;
    }
};

/// What a deck's comments ask.
struct TransientAsked {
    double volts = 0, seconds = 0, level = 0;
    std::string spikes;
};
TransientAsked asked_of(const std::string& deck) {
    TransientAsked out;
    std::istringstream lines(deck);
    const auto number = [](std::istream& from) {
        std::string word;
        from >> word;
        const auto found = parse_number(word);
        return found ? found->value : 0;
    };
    for (std::string line, star, what; std::getline(lines, line);) {
        std::istringstream words(line);
        if (!(words >> star >> what) || star != "*") continue;
        if (what == "within:") out.volts = number(words), out.seconds = number(words);
        if (what == "spikes:") words >> out.spikes, out.level = number(words);
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

/// A deck with our transistors in place of the formulas.
RunOutcome native_run(const std::string& path) {
    std::string text = read_file(path);
    if (const auto at = text.find(by_formulas); at != std::string::npos) text.replace(at, by_formulas.size(), native);
    return run_corpuscle(Netlist::parse(text, path, [](const std::string& file) -> Result<std::string> { return read_file(file); }));
}

double furthest(const Wave& mine, const Wave& theirs, const TransientAsked& asked, double& when) {
    double worst = 0;
    for (const auto* grid : {&mine.times(), &theirs.times()})
        for (const double t : *grid)
            if (const double off = theirs.distance(t, mine.at(t), asked.seconds); off > worst) worst = off, when = t;
    return worst;
}

/// The largest difference of what lies between two rises, and of the last, as parts of what they are.
struct Lateness {
    double interval = 0, last = 0;
};
Lateness lateness(const std::vector<double>& mine, const std::vector<double>& theirs) {
    Lateness out;
    for (std::size_t k = 1; k < mine.size(); ++k)
        out.interval = std::max(out.interval, std::abs((mine[k] - mine[k - 1]) / (theirs[k] - theirs[k - 1]) - 1));
    if (!mine.empty()) out.last = std::abs(mine.back() / theirs.back() - 1);
    return out;
}

void hold_spikes(const std::string& name, const Wave& mine, const Wave& theirs, double level) {
    const auto here = mine.rises(level), there = theirs.rises(level);
    EXPECT_EQ(here.size(), there.size()) << name;
    EXPECT_GE(there.size(), 2U) << name;
    if (here.size() != there.size() || here.empty()) return;
    const auto late = lateness(here, there);
    std::printf("; %zu spikes, intervals to %.2g, the last to %.2g", here.size(), late.interval, late.last);
    EXPECT_LE(late.interval, share_of_interval) << name;
    EXPECT_LE(late.last, share_of_interval) << name << ": the last at " << here.back() << " here, " << there.back() << " there";
}

/// Every voltage that both give.
void hold_waves(const Plot& mine, const Plot& theirs, const TransientAsked& asked) {
    std::printf("%zu points here, %zu there", mine.point_count(), theirs.point_count());
    int held = 0;
    for (const auto& curve : theirs.curves) {
        const auto* own = mine.find_curve(corpuscle_name(curve.name));
        if (curve.type != "voltage" || own == nullptr) continue;
        ++held;
        const Wave here(mine.curves[0], *own), there(theirs.curves[0], curve);
        ASSERT_TRUE(here.drawn() && there.drawn());
        if (asked.volts > 0) {
            double when = 0;
            const double off = furthest(here, there, asked, when);
            std::printf("; %s %.2g V", own->name.c_str(), off);
            EXPECT_LE(off, asked.volts) << own->name << " at " << when << " s: " << here.at(when) << " here, " << there.at(when)
                                        << " there";
        }
        if (own->name == asked.spikes) hold_spikes(own->name, here, there, asked.level);
    }
    std::printf("\n");
    EXPECT_GE(held, 1);
}

class TransientDeck : public testing::TestWithParam<std::string> {};

TEST_P(TransientDeck, GoesAsInNgspice) {
    const auto path = transient_deck(GetParam());
    const TemporaryFolder folder;
    const auto log = run_ngspice(path, folder / "theirs.raw");
    const auto theirs = read_raw_file(folder / "theirs.raw");
    ASSERT_EQ(theirs.size(), 1U) << log;
    const auto mine = native_run(path).plots();
    ASSERT_EQ(mine.size(), 1U);
    hold_waves(mine[0], theirs[0], asked_of(read_file(path)));
}

class TransistorDeck : public testing::TestWithParam<std::string> {};

TEST_P(TransistorDeck, GoesHereByFormulasAsByOurOwnTransistors) {
    const auto path = transient_deck(GetParam());
    const auto mine = native_run(path).plots(), formulas = run_corpuscle(path).plots();
    ASSERT_EQ(mine.size(), 1U);
    ASSERT_EQ(formulas.size(), 1U);
    hold_waves(mine[0], formulas[0], asked_of(read_file(path)));
}

INSTANTIATE_TEST_SUITE_P(Ngspice, TransientDeck, testing::ValuesIn(transient_decks()), [](const auto& one) { return one.param; });
INSTANTIATE_TEST_SUITE_P(Here, TransistorDeck, testing::ValuesIn(transistor_decks()), [](const auto& one) { return one.param; });

}  // namespace
}  // namespace corpuscle::circuit::test
