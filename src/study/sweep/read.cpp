// A file to a sweep: which subject it is of; and errors as the user knows the files.

#include <fmt/format.h>
#include <filesystem>

#include "circuit/carried.hpp"
#include "signal/input_files.hpp"
#include "study/afferents.hpp"
#include "study/sweep/subject.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
using sweeps::SweepText;

constexpr std::size_t most_of_a_sweep = std::size_t{1} << 20;  // bytes

Result<SweepText> text_at(const fs::path& path) {
    const auto text = read_whole_input(path.string(), most_of_a_sweep, "sweep file");
    return text ? sweeps::read_sweep_text(*text, path.string()) : Result<SweepText>(text.error());
}

/// A netlist alone: its own .step and .mc say what varies.
SweepText of_netlist(const fs::path& path) {
    SweepText out;
    out.file = path.string();
    std::error_code status;
    out.netlist = Said{fs::exists(path, status) ? path.filename().string() : path.string(), {}};
    return out;
}

Result<std::unique_ptr<Sweep>> of_subject(const SweepText& said, const std::string& folder) {
    if (said.afferent && said.netlist)
        return said.netlist->wrong(
            "a sweep is of one thing: either afferent = ..., which feels a force, or netlist = ..., with its own analyses");
    if (said.netlist) return sweeps::analyses_sweep(said, folder);
    if (!said.afferent)
        return bad_input("nothing says what the sweep is of: afferent = \"sa1\", or netlist = \"circuits/bias.cir\"", {said.file});
    return names_netlist(said.afferent->text) ? sweeps::chips_sweep(said, folder) : sweeps::equations_sweep(said, folder);
}

/// What is asked for on the command line, in the place of what the file says.
void put(MaybeSaid& into, std::string_view key, const std::optional<std::string>& asked, SweepText& said) {
    if (!asked || (into && into->text == *asked)) return;
    into = Said{*asked, {}};
    said.canonical += fmt::format("--{} {}\n", key, *asked);
}

template <class N>
std::optional<std::string> text_of(const std::optional<N>& number) {
    return number ? std::optional(fmt::format("{}", *number)) : std::nullopt;
}

}  // namespace

Result<std::unique_ptr<Sweep>> read_sweep(const std::string& path, const SweepAsked& asked) {
    const fs::path file = path;
    const auto folder = file.parent_path().string();
    const bool is_netlist = file.extension() != ".toml";
    auto said = is_netlist ? Result<SweepText>(of_netlist(file)) : text_at(file);
    if (!said) return said.error();
    put(said->seed, "seed", text_of(asked.seed), *said);
    put(said->units, "units", text_of(asked.units), *said);
    auto sweep = of_subject(*said, folder);
    if (sweep) return sweep;
    auto error = sweep.error();  // netlists and what they include are called as seen from the folder
    std::error_code status;
    if (const auto there = file.parent_path() / error.place.file;
        !error.place.file.empty() && error.place.file != said->file && fs::exists(there, status))
        error.place.file = there.string();
    if (error.place.file.empty()) error.place.file = path;
    return error;
}

}  // namespace corpuscle
