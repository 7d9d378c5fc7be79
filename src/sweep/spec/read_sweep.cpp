// Reads a sweep file and makes the sweep of its subject (afferent or netlist). Paths in errors are relative to the current folder.

#include <fmt/format.h>
#include <filesystem>

#include "circuit/variant/netlist_overrides.hpp"
#include "core/text/input_files.hpp"
#include "run/afferent_plan.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle {

Result<std::unique_ptr<Sweep>> sweeps::make_sweep(const SweepText& spec, const std::string& folder) {
    const auto *afferent = spec.get("afferent"), *netlist = spec.get("netlist");
    if (afferent && netlist)
        return netlist->error_here("give either afferent = ..., which responds to a force, or netlist = ..., with its own analyses");
    if (!afferent && !netlist)
        return bad_input("the sweep has no subject; give afferent = \"sa1\", or netlist = \"circuits/bias.cir\"", {spec.file()});
    auto sweep = netlist ? new_analysis_sweep() : names_netlist(afferent->text) ? new_chip_sweep() : new_model_sweep();
    TRY(sweep->prepare(spec, folder));
    return std::unique_ptr<Sweep>(std::move(sweep));
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

}  // namespace

Result<std::unique_ptr<Sweep>> read_sweep(const std::string& path, const SweepOverrides& overrides) {
    const fs::path file = path;
    const auto folder = file.parent_path().string();
    const bool is_netlist = file.extension() != ".toml";
    auto spec = TRY(is_netlist ? Result<SweepText>(text_of_netlist(file)) : text_at(file));
    replace_setting(spec, "seed", overrides.seed);
    replace_setting(spec, "samples", overrides.samples);
    auto sweep = sweeps::make_sweep(spec, folder);
    if (sweep) return sweep;
    auto error = sweep.error();  // in it, netlists and the files they include have paths relative to the folder of the sweep file
    std::error_code status;
    if (const auto full_path = file.parent_path() / error.location.file;
        !error.location.file.empty() && error.location.file != spec.file() && fs::exists(full_path, status))
        error.location.file = full_path.string();
    if (error.location.file.empty()) error.location.file = path;
    return error;
}

}  // namespace corpuscle
