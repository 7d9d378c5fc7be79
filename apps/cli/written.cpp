#include "written.hpp"

#include <fmt/format.h>
#include <filesystem>

namespace corpuscle {

Result<void> put_whole(OutputFile& file, const std::string& text) {
    if (auto ok = file.write(text); !ok) return ok;
    return file.commit();
}

std::vector<std::string> names_in(const std::string& directory, const std::vector<std::string>& paths) {
    std::vector<std::string> all;
    for (const auto& path : paths)
        if (!directory.empty() && path.starts_with(directory + "/") && path.find('/', directory.size() + 1) == path.npos)
            all.push_back(std::filesystem::path(path).filename().string());
    return all;
}

std::string told_of(const std::vector<std::string>& paths, const std::vector<std::string>& removed) {
    if (paths.empty()) return "Nothing was written: --out DIR keeps the spikes, --report makes a page to look at.\n";
    const auto gone = removed.empty() ? "" : fmt::format("Removed, of an earlier run: {}\n", fmt::join(removed, ", "));
    return fmt::format("Written: {}\n{}", fmt::join(paths, ", "), gone);
}

}  // namespace corpuscle
