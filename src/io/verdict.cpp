#include "io/verdict.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>

#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

constexpr double strays_worth_a_word = 1e-3, strays_worth_a_warning = 0.01, hum_worth_a_word = 0.02, hum_worth_a_warning = 0.1;
constexpr double far_above = 40;  // N: ten times what the models are fitted to

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

double stray_share(const ChannelPath& p) {
    const auto examined = p.stray_check.examined();
    return examined > 0 ? static_cast<double>(p.stray_check.count()) / static_cast<double>(examined) : 0;
}

/// The channels of which something holds, and the one of which it holds most.
struct Concerned {
    std::vector<std::size_t> channels;
    std::size_t worst = 0;
    std::string names;  ///< "'fz'", "'ch3' (the worst of 5 such channels)"
};

class Writer {
    const std::vector<Channel>& channels_;
    const std::vector<ChannelPath>& paths_;
    Quality out_;

    /// Of which channels `amount` is above 0.
    Concerned concerned(const std::function<double(const ChannelPath&)>& amount) const {
        Concerned c;
        for (std::size_t k = 0; k < paths_.size(); ++k) {
            if (!(amount(paths_[k]) > 0)) continue;
            if (c.channels.empty() || amount(paths_[k]) > amount(paths_[c.worst])) c.worst = k;
            c.channels.push_back(k);
        }
        if (!c.channels.empty())
            c.names = paths_.size() == 1 ? "the force"
                      : c.channels.size() == 1
                          ? fmt::format("'{}'", channels_[c.worst].name)
                          : fmt::format("'{}' (the worst of {} such channels)", channels_[c.worst].name, c.channels.size());
        return c;
    }

    void say(bool warn, std::string sentence) { (warn ? out_.warnings : out_.sentences).push_back(std::move(sentence)); }

    void number(std::size_t channel, std::string_view name, double value, std::string_view unit = "") {
        out_.findings.push_back({channels_[channel].id, name, value, unit});
    }

    void strays() {
        const auto c = concerned([](const auto& p) { return stray_share(p) > strays_worth_a_word ? stray_share(p) : 0; });
        if (c.channels.empty()) return;
        const auto& worst = paths_[c.worst];
        say(stray_share(worst) > strays_worth_a_warning,
            fmt::format(
                "{}: {} of {} readings ({}) stand alone, far from those before and after, as torn readings do (and there may be more "
                "in a row); --range LO..HI and --despike LIMIT take them out",
                c.names, worst.stray_check.count(), worst.stray_check.examined(), percent(stray_share(worst))));
    }

    void hum() {
        const auto c = concerned([](const auto& p) { return p.hum.found().share > hum_worth_a_word ? p.hum.found().share : 0; });
        if (c.channels.empty()) return;
        const auto found = paths_[c.worst].hum.found();
        say(found.share > hum_worth_a_warning,
            fmt::format("{}: hum at {:g} Hz is {} of the power that varies within a second, and a derivative makes it more; --notch {:g}Hz "
                        "takes it out",
                        c.names, found.frequency, percent(found.share), found.frequency));
    }

    void saturation() {
        const auto c = concerned([](const auto& p) { return p.saturation.likely() ? p.saturation.share() : 0; });
        if (c.channels.empty()) return;
        const auto& s = paths_[c.worst].saturation;
        say(false, fmt::format("{}: comes back to its highest value, {:.4g} N, and stays there ({} of the readings): is the sensor or its "
                               "converter saturated?",
                               c.names, s.highest(), percent(s.share())));
    }

    /// 255, 1023, 4095 ...: what a converter says when it can say no more.
    void full_scale() {
        const auto code = [](const ChannelPath& p) {
            const double raw = p.saturation.highest() / p.gain() + p.offset(), next = std::round(raw) + 1;
            const bool power = next >= 256 && next <= 0x1p32 && std::exp2(std::round(std::log2(next))) == next;
            return power && std::abs(raw - (next - 1)) < 1e-6 * next && p.saturation.share() * static_cast<double>(p.levels.count) >= 3
                       ? next
                       : 0;
        };
        const auto c = concerned(code);
        if (c.channels.empty()) return;
        const auto& worst = paths_[c.worst];
        say(true, fmt::format("{}: reads {:g}, the highest a {:g}-bit converter can say, {} of the time: saturated, or no sensor of force; "
                              "--channel chooses others",
                              c.names, code(worst) - 1, std::log2(code(worst)), percent(worst.saturation.share())));
    }

    void sums(const SumCheck& check) {
        for (const auto& s : check.found())
            say(false, fmt::format("'{}' is the sum of '{}' to '{}', no sensor of its own; --channel or --layout leaves it out",
                                   channels_[s.channel].name, channels_[s.from].name, channels_[s.to].name));
    }

    void levels() {
        const auto high = concerned([](const auto& p) { return p.levels.greatest > far_above ? p.levels.greatest : 0; });
        if (!high.channels.empty())
            say(true, fmt::format("{}: up to {:.4g} N, where the models are fitted to 0.2 to 4 N; --scale S brings the force that one "
                                  "receptor feels there",
                                  high.names, paths_[high.worst].levels.greatest));
        const auto low = concerned([](const auto& p) { return p.levels.greatest < 0.2 && p.levels.greatest > p.levels.least ? 1 : 0; });
        if (!low.channels.empty() && low.channels.size() == paths_.size())
            say(false, fmt::format("no force reaches 0.2 N, the least the models are fitted to (up to {:.3g} N); is the unit right?",
                                   paths_[low.worst].levels.greatest));
        const auto turned =
            concerned([](const auto& p) { return p.levels.least < -0.2 && -p.levels.least > p.levels.greatest ? -p.levels.least : 0; });
        if (!turned.channels.empty())
            say(true,
                fmt::format("{}: mostly negative, down to {:.4g} N, and a press is positive here; --abs, or --scale with a minus, turns it",
                            turned.names, paths_[turned.worst].levels.least));
        const auto still = concerned([](const auto& p) { return p.levels.greatest == p.levels.least ? 1 : 0; });
        const auto& first = paths_[0].levels;
        const bool all = still.channels.size() == paths_.size();
        if (paths_.size() == 1 && all && first.count > 1)
            say(true, fmt::format("the force is {:.4g} N throughout: is this what was recorded?", first.greatest));
        else if (paths_.size() > 1 && still.channels.size() == 1)
            say(false, fmt::format("{} has the same value throughout", still.names));
        else if (paths_.size() > 1 && !still.channels.empty())
            say(all, fmt::format("{} channels have the same value throughout{}", still.channels.size(),
                                 all ? ": is this the force that was recorded?" : ""));
    }

    void mended(const RowCounts& rows) {
        std::int64_t strays = 0, filled = 0;
        for (const auto& p : paths_) strays += p.strays_taken_out(), filled += p.filled();
        if (rows.dropped > 0) say(false, fmt::format("{} rows with a bad field were left out", rows.dropped));
        std::int64_t readings = 0;
        for (const auto& p : paths_) readings += p.levels.count;
        constexpr std::int64_t share_worth_a_warning = 20;  // one of so many
        if (filled > 0)
            say(filled * share_worth_a_warning > readings,
                fmt::format("{} of {} readings were filled in by straight lines ({} outside --range, {} strays)", filled, readings,
                            rows.out_of_range, strays));
        if (filled * 2 > readings) say(true, "more than half of the readings were filled in: what is left says little");
    }

    void clock(const RowClock& rows) {
        if (rows.gaps > 0 && !rows.by_times && rows.column)
            say(false, fmt::format("{} steps of the clock are longer than one and a half times the usual one", rows.gaps));
    }

    void numbers() {
        for (std::size_t k = 0; k < paths_.size(); ++k) {
            const auto& p = paths_[k];
            number(k, "force_min", p.levels.least, "N");
            number(k, "force_max", p.levels.greatest, "N");
            number(k, "below_0.2N", p.levels.share(p.levels.below));
            number(k, "above_4N", p.levels.share(p.levels.above));
            number(k, "negative", p.levels.share(p.levels.negative));
            number(k, "strays", stray_share(p));
            number(k, "at_highest", p.saturation.share());
            number(k, "hum", p.hum.found().share);
            number(k, "hum_frequency", p.hum.found().frequency, "Hz");
            number(k, "filled", static_cast<double>(p.filled()));
        }
    }

public:
    Writer(const std::vector<Channel>& channels, const std::vector<ChannelPath>& paths) : channels_(channels), paths_(paths) {}

    Quality write(const RowClock& rows, const RowCounts& counts, const SumCheck& check) {
        clock(rows);
        sums(check);
        mended(counts);
        strays();
        hum();
        saturation();
        full_scale();
        levels();
        numbers();
        return std::move(out_);
    }
};

}  // namespace

Quality verdict(const std::vector<Channel>& channels, const std::vector<ChannelPath>& paths, const RowClock& rows, const RowCounts& counts,
                const SumCheck& sums) {
    return Writer(channels, paths).write(rows, counts, sums);
}

}  // namespace corpuscle
