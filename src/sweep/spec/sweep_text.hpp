#pragma once
// The texts of a sweep file, before they are interpreted. Each has its location in the file, for errors.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text/located_text.hpp"

namespace corpuscle::sweeps {

/// One [[vary]]: a quantity that varies. The keys of the file are `what` for name, `how` for distribution, `at_least` for min, `at_most`
/// for max.
struct AxisSpec {
    LocatedText name;
    OptionalLocatedText distribution, from, to, count, log, mean, sigma, min, max;
    std::optional<std::vector<LocatedText>> list;
};

/// One line of [limits]: either min and max, or within as the allowed deviation from the model `like`.
struct LimitSpec {
    LocatedText measure;
    OptionalLocatedText min, max, like, within;
};

/// A sweep file. The members have the names of its keys, except directives (`orders`), settings ([set]), axes ([[vary]]) and probes
/// (`traces`).
struct SweepText {
    std::string file;  ///< path, for errors
    OptionalLocatedText title, afferent, netlist, force, channel, rate, unit, scale, seed, samples, iterations, every, directives;
    std::vector<LocatedSetting> settings;
    std::vector<AxisSpec> axes;
    std::optional<std::vector<LocatedText>> measures, keep;
    std::vector<LocatedText> probes;
    std::vector<LimitSpec> limits;
    std::string canonical;  ///< the file in a standard form without comments, equal for files with the same content; then the options that
                            ///< replace keys of the file, "--seed 3"; empty: the sweep is a netlist without a sweep file
};

/// Keys of former versions and their present names. A file with an old key is refused, and the message names the new one.
struct RenamedKey {
    std::string_view old_key, new_key;
};
inline constexpr RenamedKey renamed_keys[] = {{"units", "samples"}};

/// Reads the text (TOML) of a sweep file. Unknown keys and values of the wrong type are errors. `file`: its path, for errors.
Result<SweepText> read_sweep_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::sweeps
