// Interprets the headers of live frames.

#include <fmt/format.h>
#include <unordered_set>

#include "cli/stream/stream.hpp"
#include "core/text/ascii_text.hpp"
#include "io/recording/column_selection.hpp"
#include "io/table/heading.hpp"
#include "skin/plan/sites.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_override_notes = 6;

/// Finds the place and the unit of each column that a header names.
class HeaderColumns {
    const StreamArguments& args_;
    const Sites& sites_;
    const TaxelLayout* taxels_;                    // null: without --taxels
    std::vector<std::uint32_t> mapped_;            // the site of each column by --layout; empty: all sites in order
    std::unordered_set<std::string> places_ = {};  // the names of the sites or taxels, in lower case
    std::string source_ = input_name(args_.in) + ": header";

    /// The site or taxel of each column; empty: in order.
    Result<std::vector<std::uint32_t>> order_of(std::span<const std::string> names) const {
        if (taxels_) return match_frame_columns(*taxels_, names, "the header of " + input_name(args_.in));
        auto named = find_sites_if_named(sites_, names);
        if (!named)
            return bad_input(
                fmt::format("{}; use site names in all columns, or in none (columns are then in site order)", named.error().message),
                {source_});
        if (!*named || mapped_.empty()) return *named ? **std::move(named) : std::vector<std::uint32_t>();
        for (std::size_t k = 0; k < mapped_.size(); ++k)
            if ((**named)[k] != mapped_[k])
                return bad_input(fmt::format("column {} is site '{}' in the header, but '{}' in {}; remove --layout or the header", k + 1,
                                             sites_.names[(**named)[k]], sites_.names[mapped_[k]], args_.recording.layout),
                                 {source_});
        return std::vector<std::uint32_t>();
    }

    /// The name and the unit of a column. The name of a site or taxel has no unit.
    Column column_of(const std::string& name) const {
        if (!places_.contains(lower(name))) return parse_heading(name);
        Column column;
        column.name = name;
        return column;
    }

public:
    HeaderColumns(const StreamArguments& args, const Sites& sites, const TaxelLayout* taxels, std::vector<std::uint32_t> mapped)
        : args_(args), sites_(sites), taxels_(taxels), mapped_(std::move(mapped)) {
        if (!taxels_)
            for (const auto& name : sites_.names) places_.insert(lower(name));
        else
            for (const auto& taxel : taxels_->taxels) places_.insert(lower(taxel.name));
    }

    /// Appends notes about the units to `notes`, as a recording has them.
    Result<FrameColumns> read(std::span<const std::string> names, std::vector<std::string>& notes) const {
        FrameColumns out{TRY(order_of(names)), {}};
        std::vector<std::string> unitless;
        for (const auto& name : names) {
            const auto column = column_of(name);
            out.scales.push_back(TRY(newtons_per_unit(column, args_.recording, source_, send_only_forces)));
            if (lacks_unit(column, args_.recording)) unitless.push_back(column.name);
            if (auto note = overridden_unit_note(column, args_.recording); !note.empty()) notes.push_back(std::move(note));
        }
        if (const auto count = notes.size(); count > max_override_notes) {
            notes.resize(max_override_notes);
            notes.push_back(
                fmt::format("--unit {} overrides {} more units in the header", *args_.recording.unit, count - max_override_notes));
        }
        if (auto note = unitless_note(std::move(unitless)); !note.empty()) notes.push_back(std::move(note));
        return out;
    }
};

}  // namespace

HeaderReader make_header_reader(const StreamArguments& args, const Sites& sites, const TaxelLayout* taxels,
                                std::vector<std::uint32_t> mapped, std::function<void(const std::vector<std::string>&)> report) {
    return
        [header = HeaderColumns(args, sites, taxels, std::move(mapped)), report = std::move(report)](std::span<const std::string> names) {
            std::vector<std::string> notes;
            auto columns = header.read(names, notes);
            if (columns) report(notes);
            return columns;
        };
}

}  // namespace corpuscle
