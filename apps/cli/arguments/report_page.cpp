#include "cli/arguments/report_page.hpp"

#include <fmt/format.h>

namespace corpuscle {

Result<void> check_page_name(const std::string& name) {
    if (name.empty() || name.ends_with(".html")) return {};
    const auto dot = name.rfind('.');
    const auto stem = dot == std::string::npos || dot == 0 || name.find('/', dot) != std::string::npos ? name : name.substr(0, dot);
    return bad_usage(fmt::format("--report {}: the name must end in .html, such as {}.html", name, stem));
}

}  // namespace corpuscle
