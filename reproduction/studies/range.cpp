// The working range of the chips: supply from 0.5 to 0.9 V, -55 to 125 C, five process corners, each under the thesis's press stimulus. It
// also finds the limiting mechanism, whether high-threshold switches would help, and which design ranges are exceeded.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include "core/thread_pool.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::range {

constexpr const char *chips[] = {"sa1-circuit", "fa1-circuit"}, *corner_names[] = {"tt", "ss", "ff", "sf", "fs"};
constexpr double nominal_supply = 0.7, nominal_temperature = 27;  // V, C
// values of the axes, in order of their distance from the nominal point
const std::vector<double> lower_supplies = {0.65, 0.6, 0.55, 0.5}, higher_supplies = {0.75, 0.8, 0.85, 0.9},
                          lower_temperatures = {0, -25, -55}, higher_temperatures = {50, 75, 100, 125};

/// One chip under the press stimulus at one operating condition.
struct Condition {
    double supply = nominal_supply, celsius = nominal_temperature;
    bool high_threshold = false;  // with high-threshold switches (hv_switches=1)
    TrialResult response{};
    std::string failed{};  // error text if it did not converge, else ""
    bool works = false;    // is_working
};

/// True if the chip is silent at rest and fires as designed. SA-I: while the force rises and at the end of the plateau, not after
/// retraction. FA-I: in both ramps, not at the end of the plateau.
bool is_working(std::string_view chip, const std::vector<double>& t) {
    if (press::spike_count(t, press::rest) > 0 || press::spike_count(t, press::protraction) == 0) return false;
    if (chip.starts_with("sa1")) return press::spike_count(t, press::plateau_end) > 0 && press::spike_count(t, press::after) == 0;
    return press::spike_count(t, press::plateau_end) == 0 && press::spike_count(t, press::retraction) > 0;
}

/// Spike counts: "protraction / plateau / retraction / after".
std::string phase_counts(const std::vector<double>& t) {
    return fmt::format("{:g} / {:g} / {:g} / {:g}", press::spike_count(t, press::protraction), press::spike_count(t, press::plateau),
                       press::spike_count(t, press::retraction), press::spike_count(t, press::after));
}

/// How far along an axis the chip works.
struct Limit {
    double last = Claim::none;  ///< V or C: last value at which it works; NaN: it does not work at the nominal point
    std::size_t count = 0;      ///< number of values of the axis at which it works
    std::string beyond = "works in the whole range tried";  ///< spike counts and reason of the failure at the next value
};

/// Simulates a chip in a process corner under several conditions. Each condition is simulated once.
class ChipExplorer {
    const char *chip_, *corner_;
    std::deque<Condition> conditions_;  // a deque, so that references returned by at() stay valid

    std::string setting(const char* parameter, auto value) const { return fmt::format("{}.{}={}", chip_, parameter, value); }
    Condition run(Condition condition) const {
        auto response = run_trial({chip_,
                                   "press",
                                   {setting("supply", condition.supply), setting("temp", condition.celsius), setting("corner", corner_),
                                    setting("hv_switches", condition.high_threshold ? 1 : 0)}});
        if (!response) return condition.failed = response.error().text(), condition;
        condition.response = std::move(*response), condition.works = is_working(chip_, condition.response.spikes);
        return condition;
    }
    /// The reason why the chip does not work under a condition, from its warnings or from another trial with high-threshold switches.
    std::string reason(const Condition& condition) {
        if (!condition.failed.empty()) return condition.failed;
        std::string out;
        for (const auto& warning : condition.response.range_warnings) out += (out.empty() ? "" : "; ") + warning;
        if (out.empty() && !condition.high_threshold && at(condition.supply, condition.celsius, true).works)
            return "switches that are off leak as much as the membrane's own leak; it works with hv_switches=1";
        return out.empty() ? "the chip's currents are too small or too large, but no voltage or current leaves its range" : out;
    }

public:
    ChipExplorer(const char* chip, const char* corner) : chip_(chip), corner_(corner) {}
    std::string name() const { return fmt::format("{}, {}", chip_, corner_); }
    const std::deque<Condition>& conditions() const { return conditions_; }

    const Condition& at(double supply, double celsius, bool high_threshold = false) {
        for (const auto& s : conditions_)
            if (s.supply == supply && s.celsius == celsius && s.high_threshold == high_threshold) return s;
        conditions_.push_back(run({supply, celsius, high_threshold}));
        return conditions_.back();
    }
    /// The limit of the working range along an axis, by bisection. `run_at` simulates the condition at a value of the axis. `end_first`:
    /// tries the end of the axis first. `good`: the number of values, from the nominal point on, at which the chip is known to work.
    using RunAt = std::function<const Condition&(double)>;
    Limit find_limit(const std::vector<double>& axis_values, double nominal, const RunAt& run_at, bool end_first = false,
                     std::size_t good = 0) {
        std::size_t bad = axis_values.size() + 1;  // count of values up to the first one known to fail
        if (end_first) (run_at(axis_values.back()).works ? good : bad) = axis_values.size();
        while (bad - good > 1) {
            const auto middle = (good + bad) / 2;
            (run_at(axis_values[middle - 1]).works ? good : bad) = middle;
        }
        Limit out{good == 0 ? nominal : axis_values[good - 1], good};
        if (bad > axis_values.size()) return out;
        const auto& beyond_limit = run_at(axis_values[bad - 1]);
        const auto spikes = phase_counts(beyond_limit.response.spikes);
        return out.beyond = fmt::format("{}: {}", spikes, reason(beyond_limit)), out;
    }

    struct Ends {  // low, high: supply; the others: temperature
        Limit low, high, cold, hot, hot_with_high_threshold;
    } ends;
    void search() {
        const auto at_supply = [this](double v) -> const Condition& { return at(v, nominal_temperature); };
        const auto at_temperature = [this](double T) -> const Condition& { return at(nominal_supply, T); };
        const auto with_high_threshold = [this](double T) -> const Condition& { return at(nominal_supply, T, true); };
        if (at(nominal_supply, nominal_temperature).works) {
            ends.low = find_limit(lower_supplies, nominal_supply, at_supply),
            ends.high = find_limit(higher_supplies, nominal_supply, at_supply, true);
            ends.cold = find_limit(lower_temperatures, nominal_temperature, at_temperature, true),
            ends.hot = find_limit(higher_temperatures, nominal_temperature, at_temperature);
        } else {
            ends.hot.beyond = fmt::format("{}: {}", phase_counts(at(nominal_supply, nominal_temperature).response.spikes),
                                          reason(at(nominal_supply, nominal_temperature)));
        }
        if (!std::isnan(ends.hot.last) || with_high_threshold(nominal_temperature).works)
            ends.hot_with_high_threshold = find_limit(higher_temperatures, nominal_temperature, with_high_threshold, false, ends.hot.count);
    }
};

void report(ChipExplorer& t, StudyResult& out) {
    const auto& nominal = t.at(nominal_supply, nominal_temperature);
    const auto spikes = phase_counts(nominal.response.spikes);
    out.claim(t.name() + ": spikes under the press stimulus at 0.7 V, 27 C", static_cast<double>(nominal.response.spikes.size()))
        .explain(nominal.works ? spikes : "does not work; " + t.ends.hot.beyond);
    const auto add = [&](const char* label, const Limit& end, const char* unit) {
        if (!std::isnan(end.last)) out.claim(t.name() + ": " + label, end.last, unit).explain(end.beyond);
    };
    add("works at 27 C down to", t.ends.low, "V"), add("works at 27 C up to", t.ends.high, "V");
    add("works at 0.7 V down to", t.ends.cold, "C"), add("works at 0.7 V up to", t.ends.hot, "C");
    add("works at 0.7 V with hv_switches=1 up to", t.ends.hot_with_high_threshold, "C");
}

/// Plots the spikes of all conditions on one axis: those at which the `other` quantity has its nominal value.
void add_plot(const ChipExplorer& t, const char* axis_name, const char* unit, double Condition::* axis, double Condition::* other,
              double nominal, StudyResult& out) {
    StudyCurve standard, with_high_threshold;
    for (const auto& condition : t.conditions())
        for (const double at : condition.response.spikes) {
            if (condition.*other != nominal) continue;
            auto& line = condition.high_threshold ? with_high_threshold : standard;
            line.x.push_back(at), line.y.push_back(condition.*axis);
        }
    auto& plot = out.plot(fmt::format("{}: the press stimulus at several {}", t.name(), axis_name), "time (s)",
                          fmt::format("{} ({})", axis_name, unit));
    plot.points("standard", standard);
    if (!with_high_threshold.empty()) plot.points("hv_switches=1", with_high_threshold);
}

Result<StudyResult> compute(const StudyOptions& options) {
    std::vector<ChipExplorer> all;
    for (const char* chip : chips)
        for (const char* corner : corner_names) all.emplace_back(chip, corner);
    std::mutex guard;
    std::size_t done = 0;
    bool interrupted = false;
    ThreadPool().for_each(all.size(), [&](std::size_t k, unsigned) {
        if (const std::lock_guard lock(guard); interrupted) return;
        all[k].search();
        const std::lock_guard lock(guard);
        interrupted = interrupted || !options.should_continue(static_cast<double>(++done) / static_cast<double>(all.size()));
    });
    if (interrupted) return Error{ErrorCode::interrupted, "interrupted"};
    StudyResult out;
    std::size_t runs = 0, failed_runs = 0;
    for (auto& t : all) {
        report(t, out);
        runs += t.conditions().size();
        failed_runs += static_cast<std::size_t>(
            std::count_if(t.conditions().begin(), t.conditions().end(), [](const Condition& s) { return !s.failed.empty(); }));
    }
    for (const std::size_t k : {std::size_t{0}, std::size(corner_names)}) {  // the typical corner of each chip
        add_plot(all[k], "supplies", "V", &Condition::supply, &Condition::celsius, nominal_temperature, out);
        add_plot(all[k], "temperatures", "C", &Condition::celsius, &Condition::supply, nominal_supply, out);
    }
    out.notes = {
        fmt::format(
            "{} runs, of which {} did not converge. Conditions are 0.5 to 0.9 V in steps of 50 mV at 27 C, and -55, -25, 0, 27, 50, 75, "
            "100 and 125 C at 0.7 V, searched by bisection. A range ends between two neighbouring conditions. A chip is assumed to work "
            "between two conditions at which it works, and with high-threshold switches wherever it works without them.",
            runs, failed_runs),
        "Spike counts are given as protraction / plateau / retraction / after. A working chip is silent at rest. A working SA-I fires "
        "while the force rises and in the last 100 ms of the plateau, but not after retraction. A working FA-I fires in both ramps, but "
        "not in those 100 ms.",
        "The thesis gives ranges for its bias generator only: 550 to 800 mV and -55 to 95 C, typical; 650 to 750 mV over corners (E.2). "
        "Bias currents are ideal here, so supply and temperature affect only the chips' transistors."};
    return out;
}

const Study study{
    "range", "Working range of the chips: supply, temperature, process corners",
    "Between which supplies and temperatures do the two chips fire as designed under the press stimulus, and what limits them? Thesis E.2",
    compute};

}  // namespace corpuscle::studies::range
