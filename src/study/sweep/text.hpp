#pragma once
// What a sweep file says, word by word, before anybody knows what it means.

#include <optional>
#include <string>
#include <vector>

#include "signal/said.hpp"

namespace corpuscle::sweeps {

/// One [[vary]].
struct SaidAxis {
    Said what;  ///< its place, where nothing names it, is that of the whole
    MaybeSaid how, from, to, count, log, mean, sigma, at_least, at_most;
    std::optional<std::vector<Said>> list;
};

/// One line of [limits].
struct SaidLimit {
    Said measure;
    MaybeSaid at_least, at_most, like, within;
};

struct SweepText {
    std::string file;
    MaybeSaid title, afferent, netlist, force, channel, rate, unit, scale, seed, units, iterations, every, orders;
    std::vector<SaidSetting> set;
    std::vector<SaidAxis> vary;
    std::optional<std::vector<Said>> measures, keep;
    std::vector<Said> traces;
    std::vector<SaidLimit> limits;
    std::string canonical;  ///< all of it without comments and blanks: two files that say the same have the same
};

/// Reads TOML. Keys that nobody knows, and values of the wrong kind, are refused.
Result<SweepText> read_sweep_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::sweeps
