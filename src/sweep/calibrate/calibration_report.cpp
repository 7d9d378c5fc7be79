#include "sweep/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text/ascii_text.hpp"

namespace corpuscle {

std::size_t CalibrationResult::count_within_limits(int bits) const {
    return static_cast<std::size_t>(
        std::count_if(chips.begin(), chips.end(), [&](const CalibratedChip& c) { return c.bits >= 0 && c.bits <= bits; }));
}

long CalibrationResult::total_presses() const {
    long out = 0;
    for (const auto& c : chips) out += c.presses;
    return out;
}

double CalibrationResult::mean_presses() const {
    // A chip that meets the limits without calibration has one press.
    const auto trimmed = chips.size() - count_within_limits(0);
    return trimmed == 0 ? 0
                        : static_cast<double>(total_presses() - static_cast<long>(count_within_limits(0))) / static_cast<double>(trimmed);
}

std::string CalibrationResult::names() const {
    std::string out;
    for (const auto& t : trims) out += (out.empty() ? "" : ", ") + t.names.front();
    return out;
}

int useful_bits(const CalibrationResult& result, int max_bits) {
    for (int b = 0; b < max_bits; ++b)
        if ((result.count_within_limits(max_bits) - result.count_within_limits(b)) * 100 <= result.chips.size()) return b;
    return max_bits;
}

std::string format_calibration(const ChipCalibration& options, const std::vector<CalibrationResult>& all) {
    std::size_t width = 5;
    for (const auto& set : all) width = std::max(width, set.names().size());
    std::string out = fmt::format("{}: {} chips, limits: {}\n\n{:{}}   0 bits", options.netlist, all.empty() ? 0 : all[0].chips.size(),
                                  options.limits.text(), "trims", width);
    for (int b = 1; b <= options.bits; ++b) out += fmt::format("  {} bit{}", b, b == 1 ? " " : "s");
    out += "  presses per trimmed chip\n";
    for (const auto& set : all) {
        out += fmt::format("{:{}}", set.names(), width);
        for (int b = 0; b <= options.bits; ++b)
            out += fmt::format("{:{}.1f}{}", 100 * static_cast<double>(set.count_within_limits(b)) / static_cast<double>(set.chips.size()),
                               b == 0 ? 8 : 7, " %");
        out += fmt::format("  {:.1f}\n", set.mean_presses());
    }
    for (const auto& t : all.empty() ? std::vector<Trim>() : all[0].trims)
        out += fmt::format("\n{}: {:g} as designed, {:g} to {:g} with {} bits{}", joined(t.names, " and "), t.designed,
                           t.value(1 - (1 << (options.bits - 1)), options.bits), t.value(1 << (options.bits - 1), options.bits),
                           options.bits, t.is_integer ? ", integer columns" : "");
    if (!all.empty()) out += fmt::format("\nuseful number of bits: {}\n", useful_bits(all[0], options.bits));
    return out;
}

nlohmann::ordered_json document_of(const ChipCalibration& options, const std::vector<CalibrationResult>& all) {
    nlohmann::ordered_json out = {{"netlist", options.netlist}, {"limits", options.limits.text()}, {"bits", options.bits}};
    for (const auto& setting : options.overrides) out["settings"].push_back(fmt::format("{}={}", setting.parameter, setting.value));
    for (const auto& set : all) {
        nlohmann::ordered_json one, trims, within_limits, chips;
        for (const auto& t : set.trims)
            trims.push_back({{"names", t.names}, {"designed", t.designed}, {"range", t.range}, {"integer", t.is_integer}});
        for (int b = 0; b <= options.bits; ++b) within_limits.push_back(set.count_within_limits(b));
        for (const auto& c : set.chips)
            chips.push_back({{"bits", c.bits},
                             {"presses", c.presses},
                             {"codes", c.codes.back()},
                             {"spikes_before", c.spikes_before},
                             {"spikes", c.spikes}});
        out["sets"].push_back({{"trims", trims},
                               {"within_limits", within_limits},
                               {"useful_bits", useful_bits(set, options.bits)},
                               {"presses", set.total_presses()},
                               {"chips", chips}});
    }
    return out;
}

}  // namespace corpuscle
