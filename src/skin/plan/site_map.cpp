#include "skin/plan/site_map.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "io/table/heading.hpp"
#include "io/text/named_columns.hpp"

namespace corpuscle {
namespace {

using SiteIndex = std::unordered_map<std::string_view, std::uint32_t>;

SiteIndex index_sites(const Sites& sites) {
    SiteIndex index;
    for (std::size_t s = 0; s < sites.size(); ++s) index.emplace(sites.names[s], static_cast<std::uint32_t>(s));
    return index;
}

/// The message for a name that is not a site.
std::string no_such_site(const Sites& sites, std::string_view name) {
    const std::vector<std::string_view> some(sites.names.begin(),
                                             sites.names.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(sites.size(), 1000)));
    return fmt::format("there is no site '{}'{}; the first are {}; 'corpuscle list POPULATION --sites' prints all", name.substr(0, 64),
                       did_you_mean(name, some),
                       fmt::join(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(some.size(), 3)), ", "));
}

/// Reads the layout of frames row by row.
class SiteMapReader {
    NamedColumns table_;
    const Sites& sites_;
    SiteIndex index_;
    std::size_t channel_ = 0, name_ = 0;             // columns, counted from 0
    std::vector<std::optional<std::uint32_t>> map_;  // for each channel its site, if its row has been read
    std::vector<char> taken_;                        // for each site: 1 if a channel has it

    Result<void> read_header() {
        TRY(table_.read_header());
        const auto channel = table_.find({"channel", "sensor"}), name = table_.find({"name"});
        if (!channel || !name)
            return table_.error_at(
                "a layout of frames needs the columns channel and name: channel is the number of a value in the frame, from 1; name is a "
                "site");
        channel_ = *channel, name_ = *name;
        return {};
    }

    Result<void> add_row() {
        const auto& fields = table_.fields();
        if (fields.size() <= std::max(channel_, name_)) return table_.error_at("this row has too few columns");
        const auto number = fields[channel_], name = fields[name_];
        const auto channel = parse_bare_number<std::size_t>(number).value_or(0);
        if (channel < 1 || channel > sites_.size())
            return table_.error_at(
                fmt::format("channel '{}': must be a number from 1 to {}, the number of sites", number.substr(0, 64), sites_.size()),
                channel_);
        const auto entry = index_.find(name);
        if (entry == index_.end()) return table_.error_at(no_such_site(sites_, name), name_);
        if (map_.size() < channel) map_.resize(channel);
        if (std::exchange(taken_[entry->second], 1)) return table_.error_at(fmt::format("site '{}' has two channels", name), name_);
        if (map_[channel - 1]) return table_.error_at(fmt::format("channel {} has two rows", channel), channel_);
        map_[channel - 1] = entry->second;
        return {};
    }

public:
    SiteMapReader(LineReader lines, const Sites& sites)
        : table_(std::move(lines)), sites_(sites), index_(index_sites(sites)), taken_(sites.size()) {}

    Result<std::vector<std::uint32_t>> read() {
        TRY(read_header());
        while (TRY(table_.next())) TRY(add_row());
        std::vector<std::uint32_t> out;
        for (const auto& site : map_) {
            if (!site)
                return bad_input(fmt::format("channel {} has no row, although channel {} has one", out.size() + 1, map_.size()),
                                 {table_.path()});
            out.push_back(*site);
        }
        if (out.empty()) return bad_input("no channels in this layout", {table_.path()});
        return out;
    }
};

}  // namespace

Result<std::vector<std::uint32_t>> find_sites(const Sites& sites, std::span<const std::string> names) {
    const auto index = index_sites(sites);
    std::vector<char> taken(sites.size());
    std::vector<std::uint32_t> found;
    for (const auto& name : names) {
        const auto at = index.find(name);
        if (at == index.end()) return bad_input(no_such_site(sites, name));
        if (std::exchange(taken[at->second], 1)) return bad_input(fmt::format("two channels have the name '{}', which is one site", name));
        found.push_back(at->second);
    }
    return found;
}

Result<std::optional<std::vector<std::uint32_t>>> find_sites_if_named(const Sites& sites, std::span<const std::string> names) {
    std::unordered_set<std::string> known;  // in lower case, so that 'R1C1' is recognised as a site
    for (const auto& name : sites.names) known.insert(lower(name));
    const auto is_site = [&](const std::string& name) { return known.contains(lower(name)); };
    std::vector<std::string> without_units;
    for (const auto& name : names) without_units.push_back(is_site(name) ? name : parse_heading(name).name);
    if (std::none_of(without_units.begin(), without_units.end(), is_site)) return std::optional<std::vector<std::uint32_t>>();
    for (const auto& name : without_units) {
        // If a recording has two channels r1c1, its reader names the second "r1c1 (2)".
        const auto first = name.substr(0, name.rfind(" ("));
        if (!is_site(name) && name.ends_with(')') && is_site(first))
            return bad_input(fmt::format("two channels have the name '{}', which is one site", first));
    }
    auto found = find_sites(sites, without_units);
    return found ? std::optional(std::move(*found)) : Result<std::optional<std::vector<std::uint32_t>>>(found.error());
}

Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites& sites) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return bad_input("cannot be read: there is no such file", {path});
    auto lines = TRY(LineReader::open(path));
    return SiteMapReader(std::move(lines), sites).read();
}

}  // namespace corpuscle
