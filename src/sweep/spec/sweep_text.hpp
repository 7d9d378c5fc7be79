#pragma once
// A sweep file, before it is interpreted.

#include "core/text/config_file.hpp"

namespace corpuscle::sweeps {

/// A sweep file. All its keys are known, and their values are of the right kind.
struct SweepText {
    ConfigNode top;         ///< the outermost table; its location names the file
    std::string canonical;  ///< the file in a standard form without comments, equal for files with the same content; then the options that
                            ///< replace keys of the file, "--seed 3"; empty: the sweep is a netlist without a sweep file

    const std::string& file() const { return top.location.file; }
    const ConfigNode* get(std::string_view key) const { return top.get(key); }
    std::span<const ConfigNode> axes() const { return top.elements_of("vary"); }
};

/// The quantity that a [[vary]] varies.
inline const LocatedText& axis_name(const ConfigNode& axis) { return *axis.get("what"); }
/// True if the axis samples chips: their process, their mismatch or the noise of their transients.
inline bool is_chips_axis(const ConfigNode& axis) {
    const std::string_view name = axis_name(axis).text;
    return name == "process" || name == "mismatch" || name == "noise";
}

/// Keys of former versions and their present names. A file with an old key is refused, and the message names the new one.
struct RenamedKey {
    std::string_view old_key, new_key;
};
inline constexpr RenamedKey renamed_keys[] = {{"units", "samples"}};

/// Reads the text (TOML) of a sweep file. Unknown keys and values of the wrong kind are errors. `file`: its path, for errors.
Result<SweepText> read_sweep_text(std::string_view text, const std::string& file);

}  // namespace corpuscle::sweeps
