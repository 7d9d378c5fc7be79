// Reads a sweep file and makes the sweep of its subject (afferent or netlist). Paths in errors are relative to the current folder.

#include <fmt/format.h>
#include <array>
#include <filesystem>

#include "circuit/variant/netlist_overrides.hpp"
#include "core/text/input_files.hpp"
#include "run/afferent_plan.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle {
namespace {

using KeyKind = ConfigKey::Kind;

constexpr auto sweep_keys = std::to_array<ConfigKey>(
    {"title", "afferent", "netlist", "force", "channel", "rate", "unit", "scale", "seed", "samples", "iterations", "every", "orders",
     ConfigKey("set", KeyKind::settings), ConfigKey("vary", KeyKind::tables, "each varied quantity"), ConfigKey("measures", KeyKind::list),
     ConfigKey("keep", KeyKind::list), ConfigKey("traces", KeyKind::list), ConfigKey("limits", KeyKind::table)});
constexpr auto axis_keys = std::to_array<ConfigKey>({"what", "how", "from", "to", "count", ConfigKey("log", KeyKind::flag_or_text),
                                                     ConfigKey("list", KeyKind::list), "mean", "sigma", "at_least", "at_most"});

}  // namespace

Result<sweeps::SweepText> sweeps::read_sweep_text(std::string_view text, const std::string& file) {
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

Result<std::unique_ptr<sweeps::PlannedSweep>> sweeps::make_planned_sweep(const SweepText& spec, const std::string& folder) {
    const auto *afferent = spec.get("afferent"), *netlist = spec.get("netlist");
    if (afferent && netlist)
        return netlist->error_here("give either afferent = ..., which responds to a force, or netlist = ..., with its own analyses");
    if (!afferent && !netlist)
        return bad_input("the sweep has no subject; give afferent = \"sa1\", or netlist = \"circuits/bias.cir\"", {spec.file()});
    auto sweep = netlist ? new_analysis_sweep() : names_netlist(afferent->text) ? new_chip_sweep() : new_model_sweep();
    TRY(sweep->prepare(spec, folder));
    return sweep;
}

Result<std::unique_ptr<Sweep>> sweeps::make_sweep(const SweepText& spec, const std::string& folder) {
    return std::unique_ptr<Sweep>(TRY(make_planned_sweep(spec, folder)));
}

namespace {

namespace fs = std::filesystem;
using sweeps::SweepText;

constexpr std::size_t max_file_size = std::size_t{1} << 20;  // bytes

Result<SweepText> text_at(const fs::path& path) {
    const auto text = read_entire_input(path.string(), max_file_size, "sweep file");
    return text ? sweeps::read_sweep_text(*text, path.string()) : Result<SweepText>(text.error());
}

/// The text of a sweep over a netlist alone: its .step and .mc lines define what varies.
SweepText text_of_netlist(const fs::path& path) {
    SweepText out;
    out.top.location.file = path.string();
    std::error_code status;
    out.top.set("netlist", fs::exists(path, status) ? path.filename().string() : path.string());
    return out;
}

/// Replaces a setting of the sweep file by that of the command line, if there is one. The canonical text then ends with the option.
template <class N>
void replace_setting(SweepText& spec, std::string_view key, const std::optional<N>& requested) {
    if (!requested) return;
    const auto text = fmt::format("{}", *requested);
    if (const auto* given = spec.get(key); given && given->text == text) return;
    spec.top.set(key, text);
    spec.canonical += fmt::format("--{} {}\n", key, text);
}

/// The sweep of this text with the overrides. Errors about files that it names have their full paths.
Result<std::unique_ptr<Sweep>> sweep_of(SweepText spec, const fs::path& file, const SweepOverrides& overrides) {
    replace_setting(spec, "seed", overrides.seed);
    replace_setting(spec, "samples", overrides.samples);
    auto sweep = sweeps::make_sweep(spec, file.parent_path().string());
    if (sweep) return sweep;
    auto error = sweep.error();  // in it, netlists and the files they include have paths relative to the folder of the sweep file
    std::error_code status;
    if (const auto full_path = file.parent_path() / error.location.file;
        !error.location.file.empty() && error.location.file != spec.file() && fs::exists(full_path, status))
        error.location.file = full_path.string();
    if (error.location.file.empty()) error.location.file = file.string();
    return error;
}

}  // namespace

Result<std::unique_ptr<Sweep>> read_sweep(const std::string& path, const SweepOverrides& overrides) {
    const fs::path file = path;
    const bool is_netlist = file.extension() != ".toml";
    return sweep_of(TRY(is_netlist ? Result<SweepText>(text_of_netlist(file)) : text_at(file)), file, overrides);
}

Result<std::unique_ptr<Sweep>> read_sweep_text(const std::string& text, const std::string& name, const SweepOverrides& overrides) {
    return sweep_of(TRY(sweeps::read_sweep_text(text, name)), name, overrides);
}

}  // namespace corpuscle
