#include "io/nwb/nwb_metadata.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "io/text/time_stamp.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view lists[] = {"experimenter", "keywords"};
constexpr std::string_view texts[] = {"experiment_description", "institution", "lab",   "session_id",   "notes",  "protocol",
                                      "data_collection",        "surgery",     "virus", "pharmacology", "slices", "stimulus"};
constexpr std::string_view subject_texts[] = {"age", "description", "genotype", "sex", "species", "subject_id", "strain", "weight"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string_view> all_names() {
    std::vector<std::string_view> out = {"session_start_time", "session_description", "identifier"};
    out.insert(out.end(), std::begin(lists), std::end(lists));
    out.insert(out.end(), std::begin(texts), std::end(texts));
    return out;
}

/// True for a time zone at the end of a date and time: Z, +01:00.
bool has_time_zone(std::string_view text) {
    if (text.ends_with('Z')) return true;
    if (text.size() < 6) return false;
    const auto zone = text.substr(text.size() - 6);
    const auto is_digit = [&](std::size_t k) { return zone[k] >= '0' && zone[k] <= '9'; };
    return (zone[0] == '+' || zone[0] == '-') && zone[3] == ':' && is_digit(1) && is_digit(2) && is_digit(4) && is_digit(5);
}

/// Returns an error for a start that is not an ISO 8601 date and time with a time zone, or that is in the future.
Result<void> check_start(const std::string& text) {
    const auto stamp = parse_time_stamp(text);
    if (!stamp || !stamp->has_date || text.size() < 11 || text[4] != '-' || text[10] != 'T' || !has_time_zone(text))
        return bad_usage(
            fmt::format("session_start_time={}: write date, time and time zone as in session_start_time=2026-03-01T12:00:00+01:00", text));
    const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    if (seconds_between({0, 0, true}, *stamp) <= now) return {};
    return bad_usage(fmt::format("session_start_time={} is in the future; give the time at which the session began", text));
}

Result<void> set_field(NwbMetadata& out, std::string_view name, const std::string& value) {
    if (name == "session_start_time") return out.session_start_time = value, check_start(value);
    if (name == "session_description") return out.session_description = value, Result<void>();
    if (name == "identifier") return out.identifier = value, Result<void>();
    if (name.starts_with("subject.") && contains(subject_texts, name.substr(8)))
        return out.subject.emplace_back(name.substr(8), value), Result<void>();
    if (!contains(lists, name) && !contains(texts, name))
        return bad_usage(fmt::format("there is no field '{}'; fields: {}, {}{}", name, joined(all_names()),
                                     fmt::format("subject.{}", fmt::join(subject_texts, ", subject.")), did_you_mean(name, all_names())));
    const auto known = std::find_if(out.general.begin(), out.general.end(), [&](const auto& f) { return f.first == name; });
    if (known == out.general.end())
        out.general.emplace_back(name, std::vector{value});
    else if (contains(lists, name))
        known->second.push_back(value);
    else
        return bad_usage(fmt::format("{} is given twice; it has one value", name));
    return {};
}

}  // namespace

Result<NwbMetadata> read_nwb_metadata(std::span<const std::string> fields, std::string_view option) {
    NwbMetadata out;
    for (const auto& field : fields) {
        const auto at = field.find('=');
        if (at == std::string::npos || at == 0 || at + 1 == field.size())
            return bad_usage(fmt::format("{} {}: write FIELD=TEXT, such as 'experimenter=Doe, Jane'", option, field));
        if (auto ok = set_field(out, std::string_view(field).substr(0, at), field.substr(at + 1)); !ok)
            return bad_usage(fmt::format("{} {}", option, ok.error().message));
    }
    return out;
}

}  // namespace corpuscle
