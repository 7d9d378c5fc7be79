#include "cli/output/output_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>

namespace corpuscle {
namespace {

/// Removes and returns the first line. The line end may be missing.
std::string_view take_line(std::string_view& text) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

/// Removes and returns the first field of a CSV line, with its quotes. Commas within quotes are part of the field.
std::string_view take_csv_field(std::string_view& line) {
    bool quoted = false;
    std::size_t end = 0;
    for (; end < line.size() && (quoted || line[end] != ','); ++end) quoted ^= line[end] == '"';
    auto field = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return field;
}

/// True for a curve name of .raw and CSV files: "v(out)", "\"v(in,out)\".re", "time", "v-sweep".
bool is_curve_name(std::string_view name) {
    for (const std::string_view part : {".re", ".im"})
        if (name.ends_with(part)) name.remove_suffix(part.size());
    if (name.size() > 1 && name.starts_with('"') && name.ends_with('"')) name = name.substr(1, name.size() - 2);
    for (const std::string_view known : {"step", "time", "frequency", "onoise_spectrum", "inoise_spectrum", "onoise_total", "inoise_total"})
        if (name == known) return true;
    if (name.ends_with("-sweep")) return true;
    const bool has_quantity = name.starts_with("v(") || name.starts_with("i(");
    return has_quantity && name.ends_with(')') && std::none_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c); });
}

/// True for a time as event files write it: "0.319562339".
bool is_event_time(std::string_view text) {
    constexpr std::size_t decimals = 9;
    const auto point = text.find('.');
    return point > 0 && point != text.npos && text.size() - point - 1 == decimals && text.find_first_not_of("0123456789.") == text.npos;
}

/// True for a table of events with this header. Its first row, if there is one, must have a time in the first field (`time_first`) or in
/// the last field.
bool is_event_table(std::string_view beginning, std::string_view header, bool time_first) {
    if (take_line(beginning) != header) return false;
    const auto row = take_line(beginning);
    return row.empty() || is_event_time(time_first ? row.substr(0, row.find(',')) : row.substr(row.rfind(',') + 1));
}

/// True for a line of an event file in JSON Lines.
bool is_event_record(std::string_view line) {
    constexpr std::string_view before = "{\"time_s\":", after = ",\"afferent\":\"";
    if (!line.starts_with(before)) return false;
    line.remove_prefix(before.size());
    const auto end = line.find(',');
    return end != line.npos && is_event_time(line.substr(0, end)) && line.substr(end).starts_with(after);
}

}  // namespace

Result<void> write_and_commit(OutputFile& file, const std::string& text) {
    TRY(file.write(text));
    TRY(file.commit());
    return file.is_synced() ? sync_directory_of(file.path()) : Result<void>();
}

Result<void> write_file(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    return file ? write_and_commit(*file, text) : file.error();
}

bool is_own_raw(std::string_view beginning) {
    const auto title = take_line(beginning);
    const bool has_date = beginning.starts_with("Date: ");  // not in files of version 0.1.0 and earlier
    if (has_date) take_line(beginning);
    const auto plot = take_line(beginning), flags = take_line(beginning), variables = take_line(beginning), points = take_line(beginning);
    constexpr std::size_t width = std::string_view("No. Points: ").size() + 20;  // the count is padded, so that it can be rewritten
    return title.starts_with("Title: ") && plot.starts_with("Plotname: ") && (flags == "Flags: real" || flags == "Flags: complex") &&
           variables.starts_with("No. Variables: ") && points.starts_with("No. Points: ") && points.size() == width &&
           (!has_date || beginning.starts_with("Command: set rawwriter=\"Corpuscle"));
}

bool is_own_table(std::string_view beginning) {
    auto header = take_line(beginning);
    if (header.empty()) return false;
    bool has_circuit_curve = false;  // a table with only a time column may be of any program
    while (!header.empty()) {
        const auto name = take_csv_field(header);
        if (!is_curve_name(name)) return false;
        has_circuit_curve = has_circuit_curve || name != "time";
    }
    return has_circuit_curve;
}

bool is_own_events(std::string_view beginning) {
    return is_event_table(beginning, "time_s,afferent", true) || is_event_table(beginning, "afferent,channel,time_s", false) ||
           is_event_record(beginning) || beginning.starts_with("#!AER-DAT2.0\r\n# spikes of afferents") || beginning.starts_with("corpaer");
}

bool is_own_state(std::string_view beginning) { return beginning.starts_with("corplive"); }

bool is_own_checkpoint(std::string_view beginning) { return beginning.starts_with("corpuscle checkpoint"); }

bool is_own_markdown(std::string_view beginning) {
    return beginning.find("\nWritten by `corpuscle study ") != beginning.npos ||
           beginning.find("\nMade by `corpuscle study ") != beginning.npos;  // version 0.1.0 and earlier
}

}  // namespace corpuscle
