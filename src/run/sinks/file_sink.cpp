#include "run/sinks/file_sink.hpp"

#include <algorithm>

#include "core/text/csv_field.hpp"

namespace corpuscle {

Result<void> FileSink::create(const std::string& name) {
    files_.push_back(TRY(OutputFile::create(directory_ + "/" + name)));
    return {};
}

Result<void> FileSink::write_text(fmt::memory_buffer& text) {
    auto ok = files_.back().write({text.data(), text.size()});
    text.clear();
    return ok;
}

FileSink::~FileSink() {
    while (!files_.empty()) files_.pop_back();
}

std::vector<std::string> FileSink::paths() const {
    std::vector<std::string> all;
    for (const auto& file : files_) all.push_back(file.path());
    return all;
}

Result<void> FileSink::commit() {
    for (auto& file : files_) TRY(file.commit());
    return {};
}

bool is_wanted(const OutputFormat& format, const OutputRequest& request) {
    return format.option.empty() ? format.is_written(request) : request.has(format.option);
}

std::string numbered_name(std::string_view name, std::size_t index) {
    const auto at = name.rfind('#');  // the name of a copy contains another one
    if (at == name.npos) return std::string(name);
    return fmt::format("{}{}{}", name.substr(0, at), index == 0 ? "" : fmt::format("-{}", index + 1), name.substr(at + 1));
}

std::vector<std::string> file_names_of(const OutputFormat& format, const OutputRequest& request) {
    if (format.names_of) return format.names_of(request);
    std::vector<std::string> names;
    const std::size_t count = format.names[0].find('#') == std::string_view::npos ? 1 : request.inputs;
    for (std::size_t k = 0; k < count; ++k) names.push_back(numbered_name(format.names[0], k));
    return names;
}

bool matches_name(std::string_view name, std::string_view file_name) {
    const auto at = name.find_first_of("#*");
    if (at == name.npos) return file_name == name;
    const auto before = name.substr(0, at), after = name.substr(at + 1);
    if (file_name.size() < before.size() + after.size() || !file_name.starts_with(before) || !file_name.ends_with(after)) return false;
    const auto between = file_name.substr(at, file_name.size() - before.size() - after.size());
    if (name[at] == '*') return !between.empty();
    return between.empty() || (between.size() > 1 && between[0] == '-' && between.find_first_not_of("0123456789", 1) == between.npos);
}

bool can_write(const OutputFormat& format, std::string_view file_name) {
    return std::any_of(format.names.begin(), format.names.end(), [&](std::string_view name) { return matches_name(name, file_name); });
}

Result<void> check_recorded_copies(const OutputRequest& request, std::string_view option) {
    if (request.copies.count <= max_recorded_copies) return {};
    return bad_usage(
        fmt::format("{} works with at most {} copies, not {}; use fewer, or simulate one copy: --set its values from copies.csv", option,
                    max_recorded_copies, request.copies.count));
}

std::vector<std::string> afferent_csv_names(const Population& population) {
    std::vector<std::string> names;
    for (std::size_t u = 0; u < population.size(); ++u)
        names.push_back(quote_csv_field(population.afferent_name(u)) + "," + quote_csv_field(population.channel_name(u)));
    return names;
}

}  // namespace corpuscle
