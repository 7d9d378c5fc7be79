#pragma once
// The text of a sweep file, before it is interpreted.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signal/located_text.hpp"

namespace corpuscle::sweeps {

/// One [[vary]].
struct AxisSpec {
    LocatedText name;  ///< its location is that of the section if there is no name
    OptionalLocatedText distribution, from, to, count, log, mean, sigma, min, max;
    std::optional<std::vector<LocatedText>> list;
};

/// One line of [limits].
struct LimitSpec {
    LocatedText measure;
    OptionalLocatedText min, max, like, within;
};

struct SweepText {
    std::string file;
    OptionalLocatedText title, afferent, netlist, force, channel, rate, unit, scale, seed, samples, iterations, every, directives;
    std::vector<LocatedSetting> settings;
    std::vector<AxisSpec> axes;
    std::optional<std::vector<LocatedText>> measures, keep;
    std::vector<LocatedText> probes;
    std::vector<LimitSpec> limits;
    std::string canonical;  ///< the text without comments and blanks; equal for files with the same content
};

/// Keys of former versions, which are refused, with their present names.
struct RenamedKey {
    std::string_view old_key, new_key;
};
inline constexpr RenamedKey renamed_keys[] = {{"units", "samples"}};

/// Reads TOML. Unknown keys and values of the wrong type are errors.
Result<SweepText> read_sweep_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::sweeps
