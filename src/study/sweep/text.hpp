#pragma once
// The text of a sweep file, before it is interpreted.

#include <optional>
#include <string>
#include <vector>

#include "signal/said.hpp"

namespace corpuscle::sweeps {

/// One [[vary]].
struct SaidAxis {
    Said what;  ///< its location is that of the section if there is no name
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
    std::string canonical;  ///< the text without comments and blanks; equal for files with the same content
};

/// Reads TOML. Unknown keys and values of the wrong type are errors.
Result<SweepText> read_sweep_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::sweeps
