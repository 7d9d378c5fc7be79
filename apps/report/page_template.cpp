#include "report/page_template.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "embedded_file_table.hpp"

namespace corpuscle {

std::string_view compiler_version() {
#ifdef __clang__
    return __VERSION__;
#else
    return "g++ " __VERSION__;
#endif
}

std::string_view asset(std::string_view name) {
    for (const auto& f : embedded_file_table)
        if (f.path.substr(f.path.rfind('/') + 1) == name) return f.text();
    return {};
}

std::string script_json(const nlohmann::ordered_json& document) {
    const auto text = document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string out;
    out.reserve(text.size());
    for (const char c : text) c == '<' ? out += "\\u003c" : out += c;
    return out;
}

std::string escape_html(std::string_view text) {
    std::string out;
    for (const char c : text) c == '<' ? out += "&lt;" : c == '&' ? out += "&amp;" : out += c;
    return out;
}

std::string fill_template(std::string_view page_template, std::string_view title, std::string_view data) {
    std::string out;
    for (;;) {
        const auto open = page_template.find("{{"), close = page_template.find("}}", open);
        out += page_template.substr(0, open);
        if (open == std::string_view::npos || close == std::string_view::npos) return out;
        const auto name = page_template.substr(open + 2, close - open - 2);
        const auto value = name == "title" ? title : name == "data" ? data : asset(name);
        out += value.empty() ? fmt::format("{{{{{}}}}}", name) : value;  // an unknown name stays visible as {{name}}
        page_template.remove_prefix(close + 2);
    }
}

}  // namespace corpuscle
