// Arbitrary bytes as the summary.json of an earlier run. For any list in it, only files are removed that this program writes and that are
// in the directory: files of others, links and their targets stay.

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>

#include "require.hpp"
#include "run/earlier_outputs.hpp"

using namespace corpuscle;
using fuzz::require;

namespace {

namespace fs = std::filesystem;

const std::set<std::string> ours = {"spikes.csv", "probes-2.csv", "vectors-sa1.csv", "report.html", "units.csv"};
const std::set<std::string> others = {"notes.txt", "mine.html", "link.html", "response.nwb"};  // the last two are not plain files
constexpr const char* own_page = "<!DOCTYPE html><meta name=\"generator\" content=\"corpuscle\">";

void write(const fs::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

/// A directory with files of ours and of others, beside a file and a directory that a list may name by a path.
const fs::path& folder() {
    static const fs::path parent = "/tmp/corpuscle-fuzz-outputs-" + std::to_string(::getpid()), path = parent / "out";
    static const bool once = [] {
        fs::create_directories(path / "response.nwb");
        write(parent / "spikes.csv", "outside"), write(path / "notes.txt", "mine"), write(path / "mine.html", "<p>mine</p>");
        write(parent / "page.html", own_page), fs::create_symlink("../page.html", path / "link.html");
        return std::atexit([] { fs::remove_all(parent); });
    }();
    (void)once;
    for (const auto& name : ours)
        if (!fs::exists(path / name)) write(path / name, name == "report.html" ? own_page : "0\n");
    return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1) return 0;
    const auto& directory = folder();
    write(directory / "summary.json", {reinterpret_cast<const char*>(data) + 1, size - 1});
    const auto found = earlier_outputs(directory);
    require(found.empty() || found[0] == "summary.json");
    for (std::size_t k = 1; k < found.size(); ++k) require(ours.contains(found[k]) && is_output_name(found[k]));
    const std::vector<std::string> written = data[0] & 1 ? std::vector<std::string>{"spikes.csv"} : std::vector<std::string>();
    const auto removed = remove_stale_outputs(directory, written);
    for (const auto& name : removed) {
        require(std::find(found.begin() + 1, found.end(), name) != found.end());
        require(std::find(written.begin(), written.end(), name) == written.end() && !fs::exists(directory / name));
    }
    for (const auto& name : ours)
        require(fs::exists(directory / name) == (std::find(removed.begin(), removed.end(), name) == removed.end()));
    for (const auto& name : others) require(fs::exists(fs::symlink_status(directory / name)));
    require(fs::exists(directory / "summary.json") && fs::exists(directory / "../spikes.csv") && fs::exists(directory / "../page.html"));
    return 0;
}
