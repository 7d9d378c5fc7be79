#include "own_files.hpp"

#include <algorithm>
#include <cctype>

namespace corpuscle {
namespace {

/// Takes the first line off; its end may be missing.
std::string_view take_line(std::string_view& text) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

/// Takes the first field of a line of CSV off, with its quotes; commas in brackets or quotes are part of it.
std::string_view take_csv_field(std::string_view& line) {
    bool quoted = false;
    std::size_t end = 0;
    for (; end < line.size() && (quoted || line[end] != ','); ++end) quoted ^= line[end] == '"';
    auto field = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return field;
}

/// As .raw and CSV name what a simulator finds: "v(out)", "\"v(in,out)\".re", "time", "v-sweep".
bool is_curve_name(std::string_view name) {
    for (const std::string_view part : {".re", ".im"})
        if (name.ends_with(part)) name.remove_suffix(part.size());
    if (name.size() > 1 && name.starts_with('"') && name.ends_with('"')) name = name.substr(1, name.size() - 2);
    for (const std::string_view known : {"step", "time", "frequency", "onoise_spectrum", "inoise_spectrum", "onoise_total", "inoise_total"})
        if (name == known) return true;
    if (name.ends_with("-sweep")) return true;
    const auto bracket = name.find('(');
    return bracket != name.npos && bracket > 0 && name.ends_with(')') &&
           std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(bracket),
                       [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '@'; });
}

}  // namespace

bool is_own_raw(std::string_view beginning) {
    const auto title = take_line(beginning), plot = take_line(beginning), flags = take_line(beginning), variables = take_line(beginning),
               points = take_line(beginning);
    constexpr std::size_t width = std::string_view("No. Points: ").size() + 20;  // the count has room to grow
    return title.starts_with("Title: ") && plot.starts_with("Plotname: ") && (flags == "Flags: real" || flags == "Flags: complex") &&
           variables.starts_with("No. Variables: ") && points.starts_with("No. Points: ") && points.size() == width;
}

bool is_own_table(std::string_view beginning) {
    auto header = take_line(beginning);
    if (header.empty()) return false;
    bool of_circuit = false;
    while (!header.empty()) {
        const auto name = take_csv_field(header);
        if (!is_curve_name(name)) return false;
        of_circuit = of_circuit || name != "time";
    }
    return of_circuit;
}

bool is_own_events(std::string_view beginning) {
    return beginning.starts_with("time_s,afferent\n") || beginning.starts_with("afferent,channel,time_s\n") ||
           beginning.starts_with("{\"time_s\":") || beginning.starts_with("#!AER-DAT2.0\r\n# spikes of afferents") ||
           beginning.starts_with("corpaer");
}

bool is_own_state(std::string_view beginning) { return beginning.starts_with("corplive"); }

bool is_own_checkpoint(std::string_view beginning) { return beginning.starts_with("corpuscle checkpoint"); }

bool is_own_deck(std::string_view beginning) {
    take_line(beginning);
    return beginning.starts_with("* Written by 'corpuscle export ");
}

bool is_own_markdown(std::string_view beginning) { return beginning.find("\nMade by `corpuscle study ") != beginning.npos; }

}  // namespace corpuscle
