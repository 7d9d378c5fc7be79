#include "cli/output/output_files.hpp"

#include <fmt/format.h>

namespace corpuscle {

Result<void> write_and_commit(OutputFile& file, const std::string& text) {
    TRY(file.write(text));
    TRY(file.commit());
    return file.is_synced() ? sync_directory_of(file.path()) : Result<void>();
}

Result<void> write_file(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    return file ? write_and_commit(*file, text) : file.error();
}

Result<void> check_page_name(const std::string& name) {
    if (name.empty() || name.ends_with(".html")) return {};
    const auto dot = name.rfind('.');
    const auto stem = dot == std::string::npos || dot == 0 || name.find('/', dot) != std::string::npos ? name : name.substr(0, dot);
    return bad_usage(fmt::format("--report {}: the name must end in .html, such as {}.html", name, stem));
}

}  // namespace corpuscle
