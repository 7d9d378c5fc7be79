#include "optimize/found_netlist.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "core/text/ascii_text.hpp"

namespace corpuscle::optimize {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view signature = "* Netlist of an optimized design, written by corpuscle optimize.";
constexpr int max_depth = 50;  // of included files

std::string_view without_quotes(std::string_view word) {
    const bool is_quoted = word.size() >= 2 && (word[0] == '\'' || word[0] == '"') && word.back() == word[0];
    return is_quoted ? word.substr(1, word.size() - 2) : word;
}

/// The first word of a directive, in small letters, and the rest of its line.
std::pair<std::string, std::string_view> split_first(std::string_view line) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    return {lower(line.substr(0, end)), trimmed(line.substr(end))};
}

/// Copies a netlist with its included files.
class NetlistText {
    const sweeps::NetlistFactory& netlist_;
    std::string folder_, corner_;
    std::string out_;

    std::string path_of(const std::string& includer, std::string_view name) const {
        return (fs::path(includer).parent_path() / fs::path(name)).lexically_normal().string();
    }
    /// The path of a file for a reader of the new netlist.
    std::string path_from_here(const std::string& path) const {
        if (netlist_.is_embedded()) return path;
        std::error_code status;
        const auto relative = fs::relative(fs::path(netlist_.folder()) / path, folder_.empty() ? "." : folder_, status);
        return status || relative.empty() ? path : relative.string();
    }

    /// True if the line names a file that is copied in its place.
    bool include(const std::string& file, std::string_view line, int depth) {
        const auto [word, rest] = split_first(line);
        if (word != ".include" && word != ".inc" && word != ".incl") return false;
        const auto path = path_of(file, without_quotes(rest));
        const auto text = netlist_.text_of(path);
        if (!text || depth == max_depth) return false;
        out_ += fmt::format("* ---- {} ----\n", path);
        copy(path, *text, depth + 1);
        out_ += fmt::format("* ---- end of {} ----\n", path);
        return true;
    }

    /// Writes a line .lib 'file' section with the path and the corner that hold here.
    bool library(const std::string& file, std::string_view line) {
        const auto [word, rest] = split_first(line);
        const auto space = rest.find_last_of(" \t");
        if (word != ".lib" || space == std::string_view::npos) return false;
        const auto name = without_quotes(trimmed(rest.substr(0, space))), section = rest.substr(space + 1);
        out_ += fmt::format(".lib '{}' {}\n", path_from_here(path_of(file, name)), corner_.empty() ? section : corner_);
        return true;
    }

public:
    NetlistText(const sweeps::NetlistFactory& netlist, std::string folder, std::string corner)
        : netlist_(netlist), folder_(std::move(folder)), corner_(std::move(corner)) {}

    void copy(const std::string& file, std::string_view text, int depth = 0) {
        bool is_first = depth == 0, is_removed = false;
        while (!text.empty()) {
            const auto end = std::min(text.find('\n'), text.size());
            const auto line = text.substr(0, end), content = trimmed(line);
            text.remove_prefix(std::min(end + 1, text.size()));
            if (std::exchange(is_first, false)) continue;  // the title
            if (!content.starts_with('+')) {
                const auto word = split_first(content).first;
                is_removed = word == ".expect" || word == ".end";  // the expected values are those of the netlist as it was
            }
            if (is_removed || include(file, content, depth) || library(file, content)) continue;
            out_ += fmt::format("{}\n", line);
        }
    }
    std::string take() { return std::move(out_); }
};

/// .set and .temp lines for all values that differ from those of the netlist as written.
std::string set_lines(const circuit::ResolvedOverrides& overrides) {
    std::string out;
    for (const auto& [name, value] : overrides.parameters) out += fmt::format(".set {}={}\n", name, value);
    for (const auto& [element, values] : overrides.numbers)
        for (const auto& [name, value] : values) out += fmt::format(".set {}{}{}={}\n", element, name.empty() ? "" : ".", name, value);
    if (overrides.temperature) out += fmt::format(".temp {}\n", *overrides.temperature);
    return out;
}

}  // namespace

Result<std::string> found_netlist(const OptimizationProblem& problem, std::span<const double> design, const std::string& folder,
                                  std::span<const std::string> comment) {
    const auto& factory = problem.sweep->netlist();
    const auto netlist = TRY(factory.at(problem.axis_values(design, problem.cases[0])));
    const auto& overrides = netlist.overrides();
    NetlistText text(factory, folder, overrides.corner);
    text.copy(factory.file(), TRY(factory.text_of(factory.file())));
    std::string out = fmt::format("{}\n{}\n", problem.title, signature);
    for (const auto& line : comment) out += fmt::format("* {}\n", line);
    return fmt::format("{}{}* ---- the design ----\n{}.end\n", out, text.take(), set_lines(overrides));
}

bool is_found_netlist(std::string_view beginning) {
    const auto title_end = beginning.find('\n');
    return title_end != std::string_view::npos && beginning.substr(title_end + 1).starts_with(signature);
}

}  // namespace corpuscle::optimize
