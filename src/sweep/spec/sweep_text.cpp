#include "sweep/spec/sweep_text.hpp"

#include <fmt/format.h>

#include <array>
namespace corpuscle::sweeps {
namespace {

using KeyKind = ConfigKey::Kind;

constexpr auto sweep_keys = std::to_array<ConfigKey>(
    {"title", "afferent", "netlist", "force", "channel", "rate", "unit", "scale", "seed", "samples", "iterations", "every", "orders",
     ConfigKey("set", KeyKind::settings), ConfigKey("vary", KeyKind::tables, "each varied quantity"), ConfigKey("measures", KeyKind::list),
     ConfigKey("keep", KeyKind::list), ConfigKey("traces", KeyKind::list), ConfigKey("limits", KeyKind::table)});
constexpr auto axis_keys = std::to_array<ConfigKey>({"what", "how", "from", "to", "count", ConfigKey("log", KeyKind::flag_or_text),
                                                     ConfigKey("list", KeyKind::list), "mean", "sigma", "at_least", "at_most"});

}  // namespace

Result<SweepText> read_sweep_text(std::string_view text, const std::string& file) {
    SweepText out;
    out.top = TRY(parse_toml(text, file));
    for (const auto& [key, value] : out.top.entries)
        for (const auto& [old_key, new_key] : renamed_keys)
            if (key.text == old_key) return key.error_here(fmt::format("{} is now {}", old_key, new_key));
    TRY(check_keys(out.top, sweep_keys, ""));
    for (const auto& axis : out.axes()) {
        TRY(check_keys(axis, axis_keys, "[[vary]]: "));
        if (!axis.has("what"))
            return axis.error_here(
                "[[vary]]: 'what' is missing; give the quantity that varies: what = \"process\", \"temp\" or a parameter's name");
    }
    out.canonical = canonical_toml(text);
    return out;
}

}  // namespace corpuscle::sweeps
