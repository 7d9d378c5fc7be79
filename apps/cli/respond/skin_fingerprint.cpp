// The fingerprint of a skin run, which its checkpoint contains.

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "cli/respond/skin_run.hpp"
#include "core/checksum.hpp"
#include "core/version.hpp"

namespace corpuscle {
namespace {

/// True for an option that changes where or how results are written and how fast, but not the response.
bool is_output_option(std::string_view name) {
    constexpr std::string_view options[] = {"--checkpoint", "--out", "--report", "--overwrite", "--quiet", "--json", "--threads"};
    const auto is_of = [&](const OutputFormat* format) { return format->option == name; };
    return std::find(std::begin(options), std::end(options), name) != std::end(options) ||
           std::any_of(std::begin(output_formats), std::end(output_formats), is_of);
}

/// Adds the checksum of a file's contents, if the file exists. `kind`: "recording", "population file" ...
Result<void> add_contents(RunFingerprint& all, const std::string& kind, const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return {};
    const auto contents = TRY(checksum_of_file(path));
    all.emplace_back(fmt::format("contents of the {}", kind), contents);
    return {};
}

/// Checksum of the sites. It also covers the site lists that a population file includes.
std::string sites_checksum(const Sites& sites) {
    Checksum sum;
    for (const auto& p : sites.positions) sum.add(p.x), sum.add(p.y), sum.add(p.z);
    for (const auto& name : sites.names) sum.add(std::string_view(name));
    for (const auto r : sites.region) sum.add(std::uint64_t{r});
    for (const auto& name : sites.regions) sum.add(std::string_view(name));
    sum.add(sites.area);
    return fmt::format("{} sites, checksum {:016x}", sites.size(), sum.value());
}

}  // namespace

Result<RunFingerprint> SkinRun::fingerprint() const {
    RunFingerprint all = {{"the program", fmt::format("version {}", version)}, {"FORCE", args_.forces[0].text}};
    for (const auto& [name, values] : common_.typed)
        if (name != "FORCE" && !is_output_option(name)) all.emplace_back(name, fmt::format("{}", fmt::join(values, " ")));
    if (const auto& force = args_.forces[0]; !force.is_stimulus && !force.touch) TRY(add_contents(all, "recording", force.text));
    TRY(add_contents(all, "population file", args_.population));
    TRY(add_contents(all, "layout file", args_.recording.layout));
    all.emplace_back("contents of the table of sites", sites_checksum(innervation_->plan.sites));
    return all;
}

}  // namespace corpuscle
