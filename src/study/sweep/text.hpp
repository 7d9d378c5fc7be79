#pragma once
// The text of a sweep file, before it is interpreted.

#include <optional>
#include <string>
#include <vector>

#include "signal/located_text.hpp"

namespace corpuscle::sweeps {

/// One [[vary]].
struct SaidAxis {
    LocatedText what;  ///< its location is that of the section if there is no name
    OptionalLocatedText how, from, to, count, log, mean, sigma, at_least, at_most;
    std::optional<std::vector<LocatedText>> list;
};

/// One line of [limits].
struct SaidLimit {
    LocatedText measure;
    OptionalLocatedText at_least, at_most, like, within;
};

struct SweepText {
    std::string file;
    OptionalLocatedText title, afferent, netlist, force, channel, rate, unit, scale, seed, units, iterations, every, orders;
    std::vector<LocatedSetting> set;
    std::vector<SaidAxis> vary;
    std::optional<std::vector<LocatedText>> measures, keep;
    std::vector<LocatedText> traces;
    std::vector<SaidLimit> limits;
    std::string canonical;  ///< the text without comments and blanks; equal for files with the same content
};

/// Reads TOML. Unknown keys and values of the wrong type are errors.
Result<SweepText> read_sweep_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::sweeps
