#include "core/text/embedded_files.hpp"

#include <fmt/format.h>

#include "embedded_file_table.hpp"

namespace corpuscle {

Result<std::string> embedded_text(const std::string& path) {
    for (const auto& f : embedded_file_table)
        if (f.path == path) return std::string(f.text());
    return bad_input(fmt::format("there is no embedded file '{}'", path), {path});
}

std::string_view embedded_text_of(std::string_view name) {
    for (const auto& f : embedded_file_table)
        if (f.path.substr(f.path.rfind('/') + 1) == name) return f.text();
    return {};
}

std::string embedded_card_of(std::string_view path) {
    for (const auto& f : embedded_file_table)
        if (f.path.starts_with("process/") && path.ends_with(f.path) &&
            (path.size() == f.path.size() || path[path.size() - f.path.size() - 1] == '/'))
            return std::string(f.path);
    return "";
}

std::vector<std::string_view> embedded_files() {
    std::vector<std::string_view> out;
    for (const auto& f : embedded_file_table) out.push_back(f.path);
    return out;
}

}  // namespace corpuscle
