// Where the chips work: supply from 0.5 to 0.9 V, -55 to 125 C, five corners of the process, each under the thesis's press; and what stops
// them beyond: whether switches of the higher threshold would help, and which of the ranges they were designed for they leave.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include "signal/pool.hpp"
#include "study/studies.hpp"
#include "study/thesis/beside.hpp"

namespace corpuscle::studies::range {

namespace P = press;
constexpr const char *chips[] = {"sa1-circuit", "fa1-circuit"}, *corners[] = {"tt", "ss", "ff", "sf", "fs"};
constexpr double usual_supply = 0.7, usual_temperature = 27;  // V, C
// outwards from there
const std::vector<double> lower = {0.65, 0.6, 0.55, 0.5}, higher = {0.75, 0.8, 0.85, 0.9}, colder = {0, -25, -55},
                          hotter = {50, 75, 100, 125};

/// One chip under the press somewhere.
struct Spot {
    double supply = usual_supply, celsius = usual_temperature;
    bool better_switches = false;
    Told told{};
    std::string failed{};  // "", or why it did not converge
    bool works = false;
};

/// Silent at rest; SA-I fires while the press rises and to the plateau's end and not after, FA-I in both ramps and not at the plateau's
/// end.
bool as_it_should(std::string_view chip, const std::vector<double>& t) {
    if (press::count(t, P::rest) > 0 || press::count(t, P::up) == 0) return false;
    if (chip.starts_with("sa1")) return press::count(t, P::late) > 0 && press::count(t, P::after) == 0;
    return press::count(t, P::late) == 0 && press::count(t, P::down) > 0;
}

std::string pattern(const std::vector<double>& t) {
    return fmt::format("{:g} / {:g} / {:g} / {:g}", press::count(t, P::up), press::count(t, P::plateau), press::count(t, P::down),
                       press::count(t, P::after));
}

/// The last place along a way at which it works, and why not beyond; NaN: at none.
struct End {
    double last = Claim::none;
    std::size_t places = 0;  ///< of the way, at which it works
    std::string beyond = "nothing stops it in the range tried";
};

/// A chip in a corner, tried here and there; what was tried is kept.
class Tried {
    const char *chip_, *corner_;
    std::deque<Spot> spots_;  // references stay good

    std::string setting(const char* what, auto value) const { return fmt::format("{}.{}={}", chip_, what, value); }
    Spot run(Spot spot) const {
        auto told = told_of({chip_,
                             "press",
                             {setting("supply", spot.supply), setting("temp", spot.celsius), setting("corner", corner_),
                              setting("hv_switches", spot.better_switches ? 1 : 0)}});
        if (!told) return spot.failed = told.error().text(), spot;
        spot.told = std::move(*told), spot.works = as_it_should(chip_, spot.told.spikes);
        return spot;
    }
    /// Why it does not work there, as far as another trial tells.
    std::string reason(const Spot& spot) {
        if (!spot.failed.empty()) return spot.failed;
        std::string out;
        for (const auto& meaning : spot.told.outside) out += (out.empty() ? "" : "; ") + meaning;
        if (out.empty() && !spot.better_switches && at(spot.supply, spot.celsius, true).works)
            return "switches that are off leak as much as the membrane's own leak: with hv_switches=1 it works";
        return out.empty() ? "its currents are too small or too large, though nothing is saturated" : out;
    }

public:
    Tried(const char* chip, const char* corner) : chip_(chip), corner_(corner) {}
    std::string name() const { return fmt::format("{}, {}", chip_, corner_); }
    const std::deque<Spot>& spots() const { return spots_; }

    const Spot& at(double supply, double celsius, bool better_switches = false) {
        for (const auto& s : spots_)
            if (s.supply == supply && s.celsius == celsius && s.better_switches == better_switches) return s;
        spots_.push_back(run({supply, celsius, better_switches}));
        return spots_.back();
    }
    /// How far along a way from the usual place, where it works; by halves, or the way's end first. `good`: so many of its places are known
    /// to work.
    using There = std::function<const Spot&(double)>;
    End end_of(const std::vector<double>& way, double usual, const There& there, bool end_first = false, std::size_t good = 0) {
        std::size_t bad = way.size() + 1;
        if (end_first) (there(way.back()).works ? good : bad) = way.size();
        while (bad - good > 1) {
            const auto middle = (good + bad) / 2;
            (there(way[middle - 1]).works ? good : bad) = middle;
        }
        End out{good == 0 ? usual : way[good - 1], good};
        if (bad > way.size()) return out;
        const auto& stopped = there(way[bad - 1]);
        const auto spikes = pattern(stopped.told.spikes);
        return out.beyond = fmt::format("{}: {}", spikes, reason(stopped)), out;
    }

    struct Ends {
        End low, high, cold, hot, hot_with_better;
    } ends;
    void search() {
        const auto volts = [this](double v) -> const Spot& { return at(v, usual_temperature); };
        const auto heat = [this](double T) -> const Spot& { return at(usual_supply, T); };
        const auto better = [this](double T) -> const Spot& { return at(usual_supply, T, true); };
        if (at(usual_supply, usual_temperature).works) {
            ends.low = end_of(lower, usual_supply, volts), ends.high = end_of(higher, usual_supply, volts, true);
            ends.cold = end_of(colder, usual_temperature, heat, true), ends.hot = end_of(hotter, usual_temperature, heat);
        } else {
            ends.hot.beyond = fmt::format("{}: {}", pattern(at(usual_supply, usual_temperature).told.spikes),
                                          reason(at(usual_supply, usual_temperature)));
        }
        if (!std::isnan(ends.hot.last) || better(usual_temperature).works)
            ends.hot_with_better = end_of(hotter, usual_temperature, better, false, ends.hot.places);
    }
};

void tell(Tried& t, Outcome& out) {
    const auto& usual = t.at(usual_supply, usual_temperature);
    const auto spikes = pattern(usual.told.spikes);
    out.claim(t.name() + ": spikes of the press at 0.7 V, 27 C", static_cast<double>(usual.told.spikes.size()))
        .because(usual.works ? spikes : "does not work; " + t.ends.hot.beyond);
    const auto add = [&](const char* what, const End& end, const char* unit) {
        if (!std::isnan(end.last)) out.claim(t.name() + ": " + what, end.last, unit).because(end.beyond);
    };
    add("works at 27 C down to", t.ends.low, "V"), add("up to", t.ends.high, "V");
    add("works at 0.7 V down to", t.ends.cold, "C"), add("up to", t.ends.hot, "C");
    add("with hv_switches=1 up to", t.ends.hot_with_better, "C");
}

/// The spikes of those tried along one axis, in the typical corner.
void draw(const Tried& t, const char* along, const char* unit, double Spot::* axis, double Spot::* other, double usual, Outcome& out) {
    Line as_is, better;
    for (const auto& spot : t.spots())
        for (const double at : spot.told.spikes) {
            if (spot.*other != usual) continue;
            auto& line = spot.better_switches ? better : as_is;
            line.x.push_back(at), line.y.push_back(spot.*axis);
        }
    auto& plot = out.plot(fmt::format("{}: the press at several {}", t.name(), along), "time (s)", fmt::format("{} ({})", along, unit));
    plot.points("as it is", as_is);
    if (!better.empty()) plot.points("hv_switches=1", better);
}

Result<Outcome> work(const StudyOptions& options) {
    std::vector<Tried> all;
    for (const char* chip : chips)
        for (const char* corner : corners) all.emplace_back(chip, corner);
    std::mutex guard;
    std::size_t done = 0;
    bool stopped = false;
    Pool().each(all.size(), [&](std::size_t k, unsigned) {
        if (const std::lock_guard lock(guard); stopped) return;
        all[k].search();
        const std::lock_guard lock(guard);
        stopped = stopped || !options.keep_on(static_cast<double>(++done) / static_cast<double>(all.size()));
    });
    if (stopped) return Error{Code::interrupted, "interrupted"};
    Outcome out;
    std::size_t presses = 0, lost = 0;
    for (auto& t : all) {
        tell(t, out);
        presses += t.spots().size();
        lost +=
            static_cast<std::size_t>(std::count_if(t.spots().begin(), t.spots().end(), [](const Spot& s) { return !s.failed.empty(); }));
    }
    for (const std::size_t k : {std::size_t{0}, std::size(corners)}) {
        draw(all[k], "supplies", "V", &Spot::supply, &Spot::celsius, usual_temperature, out);
        draw(all[k], "temperatures", "C", &Spot::celsius, &Spot::supply, usual_supply, out);
    }
    out.notes = {
        fmt::format(
            "{} presses, of which {} did not converge. Tried are 0.5 to 0.9 V in steps of 50 mV at 27 C and -55, -25, 0, 27, 50, 75, 100 "
            "and 125 C at 0.7 V, by halves: a range ends between two neighbours, between two places at which a chip works it is taken "
            "to work, and with better switches to work wherever it does without them.",
            presses, lost),
        "Spikes are told as protraction / plateau / retraction / after. It works: silent at rest; SA-I fires while the press rises and in "
        "the last "
        "100 ms of the plateau and not after retraction; FA-I in both ramps and not in those 100 ms.",
        "The thesis prints ranges of its bias generator alone: 550 to 800 mV and -55 to 95 C, typical; 650 to 750 mV over corners (E.2). "
        "Bias "
        "currents are ideal here, so supply and temperature reach the chips through their transistors alone."};
    return out;
}

const Study study{
    "range", "Where the chips work: supply, temperature, corners of the process",
    "Between which supplies and temperatures do the two chips fire as they should under the press, and what stops them? Thesis E.2", work};

}  // namespace corpuscle::studies::range
