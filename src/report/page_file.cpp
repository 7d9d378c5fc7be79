#include "report/page_file.hpp"

#include <fmt/format.h>

#include "io/output/output_check.hpp"
#include "io/output/output_file.hpp"
#include "run/earlier_outputs.hpp"

namespace corpuscle {

Result<void> check_page_name(const std::string& name) {
    if (name.empty() || name.ends_with(".html")) return {};
    const auto dot = name.rfind('.');
    const auto stem = dot == std::string::npos || dot == 0 || name.find('/', dot) != std::string::npos ? name : name.substr(0, dot);
    return bad_usage(fmt::format("--report {}: the name must end in .html, such as {}.html", name, stem));
}

Result<void> check_page_path(const std::string& path) { return OutputCheck(false).check_file(path, is_own_page); }

Result<void> write_page(const std::string& path, const std::string& page) {
    TRY(check_page_path(path));
    auto file = TRY(OutputFile::create(path));
    TRY(file.write(page));
    TRY(file.commit());
    return file.is_synced() ? sync_directory_of(path) : Result<void>();
}

}  // namespace corpuscle
