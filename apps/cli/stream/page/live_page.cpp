#include "cli/stream/page/live_page.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "core/text/embedded_files.hpp"
#include "core/text/input_files.hpp"

namespace corpuscle {
namespace {

constexpr const char* page_name = "press.html";

constexpr const char* page_in_place_of_it = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Corpuscle</title>
<style>
:root { color-scheme: light dark }
body { font: 1rem/1.5 system-ui, sans-serif; max-width: 40rem; margin: 3rem auto; padding: 0 1rem }
</style>
</head>
<body>
<h1>Corpuscle</h1>
<p>The server runs, but the page that it shows has not been built. In the source tree, type</p>
<pre>make page</pre>
<p>and start the server again.</p>
</body>
</html>
)";

/// The text of the page; "" if it has not been built.
Result<std::string> find_page() {
    if (const auto text = embedded_text_of(page_name); !text.empty()) return std::string(text);
    std::error_code unknown;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
    for (const auto& path : {folder / "../page" / page_name, folder / "../share/corpuscle" / page_name})
        if (std::filesystem::is_regular_file(path, unknown)) return read_entire_input(path.string(), std::size_t{1} << 28, "page");
    return std::string();
}

}  // namespace

Result<std::string> load_live_page(std::string_view purpose, std::size_t max_request) {
    constexpr std::string_view head = "<head>";
    auto page = TRY(find_page());
    const auto at = page.find(head);
    if (page.find(purpose) == page.npos || at == page.npos) return std::string(page_in_place_of_it);
    page.insert(at + head.size(), fmt::format("<meta name=\"{}\" content=\"{}\">", purpose, max_request));
    return page;
}

}  // namespace corpuscle
