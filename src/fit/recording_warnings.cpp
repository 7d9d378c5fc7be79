// Warnings about recorded spikes, and the error if none of them can be used.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/quantity.hpp"
#include "fit/spike_problem.hpp"
#include "run/channels/channel_warnings.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t few_spikes = 10;
constexpr double long_delay = 1;  // s; longer than the conduction of any nerve

struct SpikeUse {
    std::size_t all = 0, used = 0;
    double first = std::numeric_limits<double>::infinity(), last = -first;  // s
};

SpikeUse spike_use(const SpikeRecording& r) {
    SpikeUse out;
    for (const auto& train : r.trains)
        for (const double t : train.times) {
            ++out.all, out.used += t >= r.clock.t0 && t < r.end();
            out.first = std::min(out.first, t), out.last = std::max(out.last, t);
        }
    return out;
}

std::string range_text(double from, double to) { return fmt::format("{:.6g} s to {:.6g} s", from, to); }

/// "; --delay 12 s was subtracted: write --delay 12ms if milliseconds are meant". "": the delay is short.
std::string delay_text(const SpikeRecording& r) {
    if (!(std::abs(r.delay) >= long_delay)) return "";
    return fmt::format("; --delay {0:g}s was subtracted from them: write --delay {0:g}ms if milliseconds are meant", r.delay);
}

std::string file_text(const SpikeRecording& r) { return r.spike_file.empty() ? "" : r.spike_file + ": "; }

}  // namespace

std::vector<std::string> recording_warnings(std::span<const SpikeRecording> recordings, const AfferentPlan& plan) {
    std::vector<std::string> out;
    std::size_t used = 0;
    for (const auto& r : recordings) {
        const auto count = spike_use(r);
        used += count.used;
        if (count.used < count.all)
            out.push_back(fmt::format("{}{} of {} spikes ({}) lie outside the time of {}, {}, and are not used{}", file_text(r),
                                      count.all - count.used, count.all, range_text(count.first, count.last), r.name,
                                      range_text(r.clock.t0, r.end()), delay_text(r)));
        if (auto warning = source_rate_warning(plan, r.name, r.clock.rate()); !warning.empty()) out.push_back(std::move(warning));
    }
    if (used < few_spikes)
        out.push_back(fmt::format("only {} spikes can be used; with fewer than {} values and intervals are rough", used, few_spikes));
    return out;
}

Error unused_spikes_error(std::span<const SpikeRecording> recordings) {
    for (const auto& r : recordings) {
        const auto count = spike_use(r);
        if (count.all == 0 || count.used > 0) continue;
        return bad_input(fmt::format(
            "{}no spike lies in the time of {}: the spikes are from {}, the force from {}{}. If the spikes are in milliseconds, write the "
            "header time_ms above their column. If the clocks differ, shift the spikes, such as by --delay {:.4g}s",
            file_text(r), r.name, range_text(count.first, count.last), range_text(r.clock.t0, r.end()), delay_text(r),
            r.delay + count.first - r.clock.t0));
    }
    return bad_input("no spike lies in the part of the force that is fitted; hold out less (--hold-out)");
}

}  // namespace corpuscle
