#include "report/page_template.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/text/embedded_files.hpp"
#include "core/version.hpp"
#include "report/envelope.hpp"

namespace corpuscle {

namespace {

using Json = nlohmann::ordered_json;

/// JSON for a script element: '<' is escaped, so that the data cannot end the element.
std::string script_json(const Json& document) {
    const auto text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string out;
    out.reserve(text.size());
    for (const char c : text) c == '<' ? out += "\\u003c" : out += c;
    return out;
}

/// Replaces absolute paths by the names of their files, so that a published page does not reveal directories. Different files keep
/// different names.
class DirectoryRemover {
    std::map<std::string, std::string> names_;  // by path
    std::map<std::string, int> uses_;           // of each file name

    const std::string& name_of(const std::string& path) {
        auto& name = names_[path];
        if (!name.empty()) return name;
        name = path.substr(path.rfind('/') + 1);
        const int use = ++uses_[name];
        return use == 1 ? name : name += fmt::format(" ({})", use);
    }

public:
    std::string without_directories(const std::string& text) {
        constexpr std::string_view before = " '\"(:=,[<", ends = " '\"),:;]>";
        std::string out;
        for (std::size_t at = 0; at < text.size();) {
            const bool may_begin = text[at] == '/' && text[at + 1] != '/' && (at == 0 || before.find(text[at - 1]) != before.npos);
            const auto path = may_begin ? text.substr(at, text.find_first_of(ends, at) - at) : "";
            if (path.find('/', 1) != path.npos && path.back() != '/')
                out += name_of(path), at += path.size();
            else
                out += text[at++];
        }
        return out;
    }

    /// All texts of a document, but not its encoded arrays.
    void apply(Json& document) {
        if (document.is_string()) {
            const auto& whole = document.get_ref<const std::string&>();
            if (whole.find('/') != whole.npos) document = without_directories(whole);
        } else if (document.is_array()) {
            for (auto& value : document) apply(value);
        } else if (document.is_object()) {
            for (auto& [key, value] : document.items())
                if (!is_array_type(key)) apply(value);
        }
    }
};

/// Text with < and & escaped for HTML.
std::string escape_html(std::string_view text) {
    std::string out;
    for (const char c : text) c == '<' ? out += "&lt;" : c == '&' ? out += "&amp;" : out += c;
    return out;
}

/// Returns the template with all names replaced. `title` must be escaped HTML, and `data` the text of script_json().
std::string fill_template(std::string_view page_template, std::string_view title, std::string_view data) {
    std::string out;
    for (;;) {
        const auto open = page_template.find("{{"), close = page_template.find("}}", open);
        out += page_template.substr(0, open);
        if (open == std::string_view::npos || close == std::string_view::npos) return out;
        const auto name = page_template.substr(open + 2, close - open - 2);
        const auto value = name == "title"    ? title
                           : name == "data"   ? data
                           : name == "style"  ? embedded_text_of("page.bundle.css")
                           : name == "script" ? embedded_text_of("page.js")
                                              : "";
        out += value.empty() ? fmt::format("{{{{{}}}}}", name) : value;  // an unknown name stays visible as {{name}}
        page_template.remove_prefix(close + 2);
    }
}

}  // namespace

Json versions_document() {
#ifdef __clang__
    return {{"corpuscle", version}, {"compiler", __VERSION__}};
#else
    return {{"corpuscle", version}, {"compiler", "g++ " __VERSION__}};
#endif
}

Json parameters_document(const AfferentPlan& plan, std::span<const ParameterDistribution> spreads) {
    Json out = Json::array();
    for (std::size_t k = 0; k < plan.values.size(); ++k) {
        const auto& p = (*plan.parameters)[k];
        out.push_back({{"name", p.info.name},
                       {"value", plan.values[k]},
                       {"unit", p.info.unit},
                       {"default", p.info.default_value},
                       {"set", p.set_by_user},
                       {"description", p.info.description},
                       {"source", p.info.source},
                       {"component", p.component}});
        for (const auto& s : spreads)
            if (s.afferent == plan.name && s.parameter == p.info.name)
                s.factor ? out.back()["spread_factor"] = *s.factor : out.back()["spread"] = s.deviation;
    }
    return out;
}

std::string report_page(std::string_view page, const std::string& title, const std::string& command, const Json& document) {
    Json data = {{"page", page}, {"title", title}, {"program", fmt::format("corpuscle {}", version)}, {"command", command}};
    data.update(document);
    DirectoryRemover().apply(data);
    return fill_template(embedded_text_of("shell.html"), escape_html(title), script_json(data));
}

}  // namespace corpuscle
