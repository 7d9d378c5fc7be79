#include "io/table/heading.hpp"

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "core/text/utf8.hpp"

namespace corpuscle {
namespace {

template <class List>
bool in_list(const List& list, std::string_view word) {
    return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

bool contains_any(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(), [&](auto w) { return text.find(w) != text.npos; });
}

/// Units besides those that parse_unit() reads, and units of time.
constexpr std::string_view unit_words[] = {"counts", "count",   "raw",   "adc",     "lsb",  "bits", "ticks", "digits", "px",
                                           "kg",     "g",       "Pa",    "kPa",     "mmHg", "bar",  "psi",   "newton", "newtons",
                                           "Newton", "Newtons", "hours", "samples", "dB",   "kgf",  "gf"};
/// Units that a force sensor never has, besides those whose dimension is_never_force() recognises.
constexpr std::string_view never_force[] = {"hex",     "deg", "\u00b0", "rad",      "degC",   "degF",  "\u00b0C", "\u00b0F", "celsius",
                                            "Celsius", "C",   "K",      "kelvin",   "Kelvin", "Nm",    "Nmm",     "mNm",     "Ncm",
                                            "kNm",     "N.m", "N.mm",   "N\u00b7m", "rpm",    "deg/s", "rad/s",   "m/s^2",   "m/s\u00b2"};

/// Suffixes of column names that could be units, but usually are not (left_F, sensor_A).
constexpr std::string_view ambiguous_units[] = {"", "1", "F", "A", "S", "T", "C", "K", "h", "min"};

/// True if the name before an ambiguous suffix shows that the suffix is a unit: temp_C, motor_current_A.
bool shows_unit(std::string_view name, std::string_view suffix) {
    const auto n = lower(name);
    if (suffix == "C" || suffix == "K" || suffix == "F") return contains_any(n, {"temp", "therm"}) || (n == "t" && suffix != "F");
    if (suffix == "h" || suffix == "min") return may_be_time_name(n);
    return suffix == "A" && (contains_any(n, {"current", "strom"}) || n == "i");
}

/// True if the suffix `s` of a heading is a unit.
bool is_suffix_unit(std::string_view name, std::string_view s) {
    if (in_list(ambiguous_units, s)) return shows_unit(name, s);
    return is_unit(s);
}

/// Replaces each pair of double quotes ("") by one, as in quoted fields of CSV.
std::string with_single_quotes(std::string text) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '"' && k + 1 < text.size() && text[k + 1] == '"') ++k;
        text[kept++] = text[k];
    }
    text.resize(kept);
    return text;
}

/// The unit of time that the name of a column is, or that follows its last point: "ms" for millis, "ns" for header.stamp.nsecs. "" for
/// other names.
std::string_view time_unit_named(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> words[] = {
        {"sec", "s"}, {"secs", "s"},    {"seconds", "s"},   {"sekunden", "s"},      {"msec", "ms"},    {"msecs", "ms"},
        {"ms", "ms"}, {"millis", "ms"}, {"millisec", "ms"}, {"milliseconds", "ms"}, {"usec", "us"},    {"usecs", "us"},
        {"us", "us"}, {"micros", "us"}, {"microsec", "us"}, {"microseconds", "us"}, {"nsec", "ns"},    {"nsecs", "ns"},
        {"ns", "ns"}, {"nanos", "ns"},  {"nanosec", "ns"},  {"nanoseconds", "ns"},  {"minutes", "min"}};
    if (const auto dot = name.rfind('.'); dot != name.npos) name.remove_prefix(dot + 1);
    if (name.size() == 2 && name != lower(name)) return "";  // "MS" may be the name of a sensor
    for (const auto& [word, unit] : words)
        if (equal_ignoring_case(name, word)) return unit;
    return "";
}

/// The name without a slash at its end: "fz" for "fz / [N]".
std::string_view without_slash(std::string_view name) {
    name = trimmed(name);
    return name.size() > 1 && name.ends_with('/') ? trimmed(name.substr(0, name.size() - 1)) : name;
}

}  // namespace

bool is_unit(std::string_view word) {
    return in_list(unit_words, word) || in_list(never_force, word) || seconds_per_time_unit(word) || (!word.empty() && parse_unit(word));
}

Column parse_heading(std::string_view written) {
    const auto text = with_single_quotes(to_utf8(written));
    const std::string_view field = text;
    if (const auto unit = time_unit_named(field); !unit.empty()) return {text, std::string(unit)};
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}})
        if (const auto at = field.rfind(open); at != std::string_view::npos && field.ends_with(close) && at > 0)
            return {std::string(without_slash(field.substr(0, at))), std::string(trimmed(field.substr(at + 1, field.size() - at - 2)))};
    if (const auto at = field.rfind('_');
        at != std::string_view::npos && at > 0 && is_suffix_unit(field.substr(0, at), field.substr(at + 1)))
        return {std::string(field.substr(0, at)), std::string(field.substr(at + 1))};
    // "Fz/mN", as the German standard DIN 461 labels axes. In a path such as "wrench/force/x" no unit follows the slash.
    if (const auto at = field.find('/'); at != std::string_view::npos && at > 0) {
        const auto name = trimmed(field.substr(0, at)), unit = trimmed(field.substr(at + 1));
        if (unit.find('/') == unit.npos || is_never_force(unit))
            if (is_suffix_unit(name, unit)) return {std::string(name), std::string(unit)};
    }
    if (const auto at = field.rfind(" in ");
        at != std::string_view::npos && at > 0 && is_suffix_unit(field.substr(0, at), field.substr(at + 4)))
        return {std::string(trimmed(field.substr(0, at))), std::string(field.substr(at + 4))};
    return {std::string(field), ""};
}

bool is_time_name(std::string_view name) {
    constexpr std::string_view words[] = {"time", "timestamp", "t", "times", "timestamps", "time stamp"};
    return in_list(words, lower(name));
}

bool may_be_time_name(std::string_view name) {
    constexpr std::string_view words[] = {"date", "clock", "elapsed", "seconds", "secs", "sec", "millis", "micros", "ms", "us", "x_value"};
    const auto word = lower(name);
    return is_time_name(word) || in_list(words, word) || contains_any(word, {"time", "stamp", "zeit", "temps", "tiempo", "tempo"});
}

bool is_index_name(std::string_view name) {
    constexpr std::string_view words[] = {
        "#",       "n",        "no",        "nr",         "idx",          "seq",           "row",          "no.",     "nr.",
        "index",   "frame",    "sample",    "frames",     "packet",       "number",        "samples",      "counter", "frameno",
        "level_0", "frame_id", "sample no", "unnamed: 0", "sample_index", "sample_number", "sample number"};
    auto word = lower(name);
    if (const auto dot = word.rfind('.'); dot != word.npos && dot + 1 < word.size()) word = word.substr(dot + 1);  // field.header.seq
    return in_list(words, word);
}

bool is_sequence_name(std::string_view name) {
    const auto word = lower(name);
    return word.ends_with("sequence") || word == "seq" || word.ends_with("_seq") || word.ends_with(".seq");
}

bool is_trial_name(std::string_view name) {
    constexpr std::string_view words[] = {"trial",    "trials",  "trial_id",   "trial_number", "trial_no",   "trial number",
                                          "run",      "rep",     "repeat",     "epoch",        "repetition", "subject",
                                          "block",    "session", "condition",  "participant",  "subject_id", "segment",
                                          "press_id", "run_id",  "experiment", "versuch"};
    return in_list(words, lower(name));
}

std::optional<double> seconds_per_time_unit(std::string_view unit) {
    const auto is_one_of = [unit](std::initializer_list<std::string_view> words) { return in_list(words, unit); };
    if (is_one_of({"sec", "secs", "second", "seconds", "Sek", "sek", "Sekunden"})) return 1;
    if (is_one_of({"msec", "msecs", "millis", "milliseconds"})) return 1e-3;
    if (is_one_of({"usec", "usecs", "micros", "microseconds"})) return 1e-6;
    if (is_one_of({"nsec", "nsecs", "nanos", "nanoseconds"})) return 1e-9;
    if (unit == "minutes") return 60;
    if (unit == "h") return 3600;
    if (unit.empty()) return {};
    const auto parsed = parse_unit(unit);
    if (parsed && parsed->has_same_dimension(*parse_unit("s"))) return parsed->factor;
    return {};
}

bool is_never_force(std::string_view unit) {
    if (in_list(never_force, unit) || seconds_per_time_unit(unit)) return true;
    const auto parsed = unit.empty() ? Result<Unit>(bad_input("")) : parse_unit(unit);
    if (!parsed) return false;
    for (const auto* other : {"Hz", "m/s", "m/s2", "N m"})
        if (parsed->has_same_dimension(*parse_unit(other))) return true;
    return false;
}

}  // namespace corpuscle
