// Where the chips work: supply from 0.5 to 0.9 V, -55 to 125 C, five corners of the process, each under the thesis's press; and what stops
// them beyond: whether switches of the higher threshold would help, and which of the ranges they were designed for they leave.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/measures.hpp"
#include "signal/pool.hpp"
#include "study/studies.hpp"
#include "study/trains.hpp"

namespace corpuscle::studies::range {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr const char* corners[] = {"tt", "ss", "ff", "sf", "fs"};
constexpr double supplies[] = {0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9};        // V
constexpr double temperatures[] = {-55, -25, 0, 27, 50, 75, 100, 125};                  // C
constexpr double usual_supply = 0.7, usual_temperature = 27;                            // V, C
constexpr double up = 0.25, held = 0.375, late = 0.525, down = 0.625, released = 0.75;  // s, of the press; late: the plateau's last 100 ms

/// One chip under the press somewhere.
struct Spot {
    const char* chip;
    const char* corner;
    double supply, celsius;
    Told told{}, with_better_switches{};
    std::string failed{};  // "", or why it did not converge

    Asked asked(bool better_switches) const {
        const auto set = [&](const std::string& what) { return fmt::format("{}.{}", chip, what); };
        return {chip,
                "press",
                {set(fmt::format("supply={}", supply)), set(fmt::format("temp={}", celsius)), set(fmt::format("corner={}", corner)),
                 set(fmt::format("hv_switches={:d}", better_switches))}};
    }
};

double count(const std::vector<double>& train, double from, double to) { return measure<SpikeCount>(train, {from, to}); }

/// Silent at rest; SA-I fires while the press rises and to the plateau's end and not after, FA-I in both ramps and not at the plateau's
/// end.
bool works(const char* chip, const std::vector<double>& t) {
    if (count(t, 0, up) > 0 || count(t, up, held) == 0) return false;
    if (std::string_view(chip).starts_with("sa1")) return count(t, late, down) > 0 && count(t, released, 1) == 0;
    return count(t, late, down) == 0 && count(t, down, released) > 0;
}

void run(Spot& spot) {
    auto told = told_of(spot.asked(false));
    if (!told) return void(spot.failed = told.error().text());
    spot.told = std::move(*told);
    if (works(spot.chip, spot.told.spikes)) return;
    if (auto better = told_of(spot.asked(true))) spot.with_better_switches = std::move(*better);
}

/// Why it does not work there, as far as two trials tell.
std::string reason(const Spot& p) {
    if (!p.failed.empty()) return p.failed;
    if (works(p.chip, p.with_better_switches.spikes))
        return "switches that are off leak as much as the membrane's own leak: with hv_switches=1 it works";
    std::string out;
    for (const auto& meaning : p.told.outside) out += (out.empty() ? "" : "; ") + meaning;
    return out.empty() ? "its currents are too small or too large, though nothing is saturated" : out;
}

std::string pattern(const std::vector<double>& t) {
    return fmt::format("{:g} / {:g} / {:g} / {:g}", count(t, up, held), count(t, held, down), count(t, down, released),
                       count(t, released, 1));
}

class Map {
    std::vector<Spot> spots_;

public:
    Map() {
        for (const char* chip : {"sa1-circuit", "fa1-circuit"})
            for (const char* corner : corners) {
                for (const double v : supplies) spots_.push_back({chip, corner, v, usual_temperature});
                for (const double T : temperatures)
                    if (T != usual_temperature) spots_.push_back({chip, corner, usual_supply, T});
            }
    }
    Result<void> run_all(const StudyOptions& options) {
        constexpr std::size_t at_once = 10;
        Pool pool;
        for (std::size_t from = 0; from < spots_.size(); from += at_once) {
            pool.each(std::min(at_once, spots_.size() - from), [&](std::size_t k, unsigned) { run(spots_[from + k]); });
            if (!options.keep_on(static_cast<double>(from) / static_cast<double>(spots_.size())))
                return Error{Code::interrupted, "interrupted"};
        }
        return {};
    }
    const Spot& at(std::string_view chip, std::string_view corner, double supply, double celsius) const {
        return *std::find_if(spots_.begin(), spots_.end(), [&](const Spot& p) {
            return p.chip == chip && p.corner == corner && p.supply == supply && p.celsius == celsius;
        });
    }
    const std::vector<Spot>& spots() const { return spots_; }
};

bool works_as_it_is(const Spot& s) { return works(s.chip, s.told.spikes); }
/// Where the plain switches do not, those of the higher threshold may.
bool works_some_way(const Spot& s) { return works_as_it_is(s) || works(s.chip, s.with_better_switches.spikes); }

/// The first and the last value of an axis between which the chip works, from its usual place outwards, and why not beyond.
struct Ends {
    double low = none, high = none;
    std::string below = "nothing stops it in the range tried", above = below;
};
template <class At>
Ends ends_of(std::span<const double> axis, double usual, const At& at, bool (*good)(const Spot&) = works_as_it_is,
             Told Spot::* tried = &Spot::told) {
    Ends out;
    const auto middle = std::find(axis.begin(), axis.end(), usual);
    if (!good(at(usual))) return out.below = out.above = reason(at(usual)), out;
    for (auto x = middle;; --x) {
        if (!good(at(*x))) {
            out.below = fmt::format("{}: {}", pattern((at(*x).*tried).spikes), reason(at(*x)));
            break;
        }
        out.low = *x;
        if (x == axis.begin()) break;
    }
    for (auto x = middle; x != axis.end(); ++x) {
        if (!good(at(*x))) {
            out.above = fmt::format("{}: {}", pattern((at(*x).*tried).spikes), reason(at(*x)));
            break;
        }
        out.high = *x;
    }
    return out;
}

void claim(const Map& map, const char* chip, const char* corner, Outcome& out) {
    const auto name = fmt::format("{}, {}", chip, corner);
    const auto by_supply = [&](double v) -> const Spot& { return map.at(chip, corner, v, usual_temperature); };
    const auto by_temperature = [&](double T) -> const Spot& { return map.at(chip, corner, usual_supply, T); };
    const auto volts = ends_of(supplies, usual_supply, by_supply);
    const auto heat = ends_of(temperatures, usual_temperature, by_temperature);
    const auto best = ends_of(temperatures, usual_temperature, by_temperature, works_some_way, &Spot::with_better_switches);
    const auto& usual = map.at(chip, corner, usual_supply, usual_temperature).told.spikes;
    out.claims.push_back({name + ": spikes of the press at 0.7 V, 27 C", static_cast<double>(usual.size()), "", none, none, none, "",
                          works_as_it_is(map.at(chip, corner, usual_supply, usual_temperature))
                              ? pattern(usual)
                              : pattern(usual) + ": does not work; " + volts.below});
    const auto add = [&](std::string what, double made, const char* unit, const std::string& why) {
        if (std::isnan(made)) return;
        out.claims.push_back({name + ": " + std::move(what), made, unit, none, none, none, "", why});
    };
    add("works at 27 C down to", volts.low, "V", volts.below), add("up to", volts.high, "V", volts.above);
    add("works at 0.7 V down to", heat.low, "C", heat.below), add("up to", heat.high, "C", heat.above);
    add("with hv_switches=1 up to", best.high, "C", best.above);
}

/// Spikes along one axis, and how many there are of them in each corner.
template <class At>
void draw(const char* chip, const char* along, const char* unit, std::span<const double> axis, const At& at, Outcome& out) {
    Plot rows{
        fmt::format("{}: the press at several {}, typical process", chip, along), "time (s)", fmt::format("{} ({})", along, unit), {}};
    Plot::Series as_is{"as it is", {}, {}, Plot::Style::points},
        better{"where that does not work: hv_switches=1", {}, {}, Plot::Style::points};
    for (const double x : axis) {
        for (const double t : at("tt", x).told.spikes) as_is.x.push_back(t), as_is.y.push_back(x);
        for (const double t : at("tt", x).with_better_switches.spikes) better.x.push_back(t), better.y.push_back(x);
    }
    rows.series = {std::move(as_is), std::move(better)};
    Plot counts{fmt::format("{}: spikes under the press", chip), fmt::format("{} ({})", along, unit), "spikes", {}};
    for (const char* corner : corners) {
        Plot::Series series{corner, {}, {}};
        for (const double x : axis) series.x.push_back(x), series.y.push_back(static_cast<double>(at(corner, x).told.spikes.size()));
        counts.series.push_back(std::move(series));
    }
    out.plots.push_back(std::move(rows)), out.plots.push_back(std::move(counts));
}

Result<Outcome> work(const StudyOptions& options) {
    Map map;
    if (auto ok = map.run_all(options); !ok) return ok.error();
    Outcome out;
    for (const char* chip : {"sa1-circuit", "fa1-circuit"}) {
        for (const char* corner : corners) claim(map, chip, corner, out);
        draw(
            chip, "supply", "V", supplies,
            [&](const char* corner, double v) -> const Spot& { return map.at(chip, corner, v, usual_temperature); }, out);
        draw(
            chip, "temperature", "C", temperatures,
            [&](const char* corner, double T) -> const Spot& { return map.at(chip, corner, usual_supply, T); }, out);
    }
    const auto lost = std::count_if(map.spots().begin(), map.spots().end(), [](const Spot& p) { return !p.failed.empty(); });
    out.notes = {
        fmt::format("{} presses, of which {} did not converge. A range ends between two values tried.", map.spots().size(), lost),
        "Spikes are told as protraction / plateau / retraction / after. It works: silent at rest; SA-I fires while the press rises and in "
        "the "
        "last 100 ms of the plateau and not after retraction; FA-I in both ramps and not in those 100 ms.",
        "The thesis prints ranges of its bias generator alone: 550 to 800 mV and -55 to 95 C, typical; 650 to 750 mV over corners (E.2). "
        "Bias currents are ideal here, so supply and temperature reach the chips through their transistors alone."};
    return out;
}

const Study study{
    "range", "Where the chips work: supply, temperature, corners of the process",
    "Between which supplies and temperatures do the two chips fire as they should under the press, and what stops them? Thesis E.2", work};

}  // namespace corpuscle::studies::range
