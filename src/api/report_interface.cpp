#include "api/result.hpp"
#include "corpuscle/respond.hpp"
#include "report/page_file.hpp"

namespace corpuscle {

void check_report(const std::string& path) {
    if (path.empty() || path.find('\0') != std::string::npos) throw InputError("the name of a report must not be empty or have NUL bytes");
    api::value_or_throw(check_page_name(path));
    api::value_or_throw(check_page_path(path));
}

void write_report(const std::string& path, const std::string& page) {
    check_report(path);
    api::value_or_throw(write_page(path, page));
}

}  // namespace corpuscle
