#include "skin/taxel/taxel_layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

#include "core/text/ascii_text.hpp"
#include "skin/taxel/taxel_table.hpp"

namespace corpuscle {
namespace {

constexpr double max_taxel_distance = 10, max_taxel_area = 100;  // m, m2
constexpr double max_degrees = 36000;

/// Reads the rows of a table of taxels.
class TaxelReader {
    using enum TaxelColumn;

    TaxelTable table_;
    std::unordered_map<std::string, long> name_lines_;                     // line of each name
    std::unordered_map<std::size_t, long> channel_lines_;                  // line of each channel number
    std::unordered_map<std::string, std::pair<TaxelPose, long>> patches_;  // pose of each patch, and the line of its first row

    Result<void> read_channel(Taxel& taxel) {
        const auto text = table_.text(channel);
        const auto number = parse_bare_number<std::size_t>(text).value_or(0);
        if (number < 1 || number > max_taxels)
            return table_.error_at(
                fmt::format("channel '{}': must be a number from 1 to {}; the name of a channel belongs in a column 'name'",
                            text.substr(0, 40), max_taxels),
                channel);
        if (const auto [entry, is_new] = channel_lines_.try_emplace(number, table_.line()); !is_new)
            return table_.error_at(fmt::format("channel {} has two rows; the first is line {}", number, entry->second), channel);
        taxel.channel = number - 1;
        return {};
    }

    Result<void> read_name(Taxel& taxel) {
        if (table_.has(channel)) TRY(read_channel(taxel));
        taxel.name = table_.text(table_.has(name) ? name : channel);
        if (taxel.name.empty()) return table_.error_at("name is empty; every taxel needs it", name);
        if (const auto [entry, is_new] = name_lines_.try_emplace(taxel.name, table_.line()); !is_new)
            return table_.error_at(fmt::format("taxel '{}' has two rows; the first is line {}", taxel.name, entry->second), name);
        return {};
    }

    /// A length or area, which must be above 0.
    Result<double> read_positive(TaxelColumn c, double limit, const Taxel& taxel) const {
        const auto value = TRY(table_.required(c, limit));
        if (value > 0) return value;
        return table_.error_at(
            fmt::format("taxel '{}' has the {} {}; it must be above 0 (taxels are points if there is no such column)", taxel.name,
                        c == area    ? "area"
                        : c == width ? "width"
                                     : "height",
                        table_.text(c)),
            c);
    }

    Result<void> read_size(Taxel& taxel) const {
        if (table_.has(area)) taxel.area = TRY(read_positive(area, max_taxel_area, taxel));
        if (!table_.has(width)) return {};
        taxel.width = TRY(read_positive(width, max_taxel_distance, taxel));
        taxel.height = TRY(read_positive(height, max_taxel_distance, taxel));
        taxel.area = taxel.width * taxel.height;
        return {};
    }

    Result<void> read_use(Taxel& taxel) const {
        const auto word = lower(table_.text(dead));
        if (word.empty() || word == "0" || word == "no" || word == "false") return {};
        if (word == "1" || word == "yes" || word == "true") return taxel.use = TaxelUse::excluded, Result<void>();
        if (word == "interpolate") return taxel.use = TaxelUse::interpolated, Result<void>();
        return table_.error_at(
            fmt::format("dead is '{}'; write 1 (no force), interpolate (the force of its neighbours), or 0 (not dead)", word.substr(0, 40)),
            dead);
    }

    /// Reads the pose in the current row. Empty fields leave `pose` as it is.
    Result<void> read_pose(TaxelPose& pose) const {
        if (const auto text = table_.text(region); !text.empty()) pose.region = text;
        if (const auto metres = TRY(table_.number(patch_x, max_taxel_distance))) pose.shift.x = *metres;
        if (const auto metres = TRY(table_.number(patch_y, max_taxel_distance))) pose.shift.y = *metres;
        if (const auto degrees = TRY(table_.number(rotation, max_degrees))) {
            const double rest = std::remainder(*degrees, 360.0);  // exact, so a full turn changes no bit
            pose.rotation = (rest == -180 ? 180 : rest) / 360;
        }
        return {};
    }

    Result<void> read_patch(Taxel& taxel) {
        if (!table_.has(patch)) return read_pose(taxel.pose);
        const std::string label(table_.text(patch));
        const auto known = patches_.find(label);
        if (known != patches_.end()) taxel.pose = known->second.first;
        TRY(read_pose(taxel.pose));
        if (known == patches_.end()) return patches_.try_emplace(label, taxel.pose, table_.line()), Result<void>();
        if (taxel.pose == known->second.first) return {};
        return table_.error_at(fmt::format("taxel '{}' gives patch '{}' another pose than line {} does; leave region, patch_x, patch_y and "
                                           "rotation empty here, or name another patch",
                                           taxel.name, label, known->second.second),
                               patch);
    }

    /// The axes of the shear, and the sign of the normal force.
    Result<void> read_axes(Taxel& taxel) const {
        const auto axes = parse_sensor_axes(table_.text(x_axis), table_.text(y_axis), table_.text(z_axis));
        if (axes) return taxel.axes = *axes, Result<void>();
        // The error is that of the last axis without which the others are valid, or that of x.
        const auto is_valid_without = [this](TaxelColumn left_out) {
            const auto axis = [&](TaxelColumn c) { return c == left_out ? std::string_view() : table_.text(c); };
            return !table_.text(left_out).empty() && parse_sensor_axes(axis(x_axis), axis(y_axis), axis(z_axis));
        };
        const auto column = is_valid_without(z_axis) ? z_axis : is_valid_without(y_axis) ? y_axis : x_axis;
        return table_.error_at(fmt::format("taxel '{}': {}", taxel.name, axes.error().message), column);
    }

    Result<Taxel> read_taxel() {
        Taxel taxel;
        TRY(read_name(taxel));
        taxel.x = TRY(table_.required(x, max_taxel_distance)), taxel.y = TRY(table_.required(y, max_taxel_distance));
        TRY(read_size(taxel));
        TRY(read_use(taxel));
        TRY(read_patch(taxel));
        TRY(read_axes(taxel));
        taxel.location = table_.error_at("", x).location;
        return taxel;
    }

    /// Sorts the taxels by their channel numbers, which must be 1, 2 ... without a gap.
    Result<void> sort_by_channel(std::vector<Taxel>& taxels) const {
        std::sort(taxels.begin(), taxels.end(), [](const Taxel& a, const Taxel& b) { return a.channel < b.channel; });
        for (std::size_t k = 0; k < taxels.size(); ++k)
            if (taxels[k].channel != k)
                return bad_input(fmt::format("channel {} has no row, although channel {} has one; add a row for it (with dead = 1 if it "
                                             "is not used)",
                                             k + 1, *taxels.back().channel + 1),
                                 {table_.path()});
        return {};
    }

public:
    explicit TaxelReader(LineReader lines) : table_(std::move(lines)) {}

    Result<TaxelLayout> read() {
        TRY(table_.read_header());
        TaxelLayout out{table_.path(), {}, table_.has(x_axis) || table_.has(y_axis) || table_.has(z_axis)};
        while (TRY(table_.next())) {
            if (out.taxels.size() == max_taxels) return table_.error_at(fmt::format("more than {} taxels", max_taxels));
            out.taxels.push_back(TRY(read_taxel()));
        }
        if (out.taxels.empty()) return bad_input("no taxels in this file", {table_.path()});
        if (table_.has(channel)) TRY(sort_by_channel(out.taxels));
        return out;
    }
};

}  // namespace

bool TaxelPose::operator==(const TaxelPose& o) const {
    return region == o.region && shift.x == o.shift.x && shift.y == o.shift.y && rotation == o.rotation;
}

Result<TaxelLayout> read_taxel_layout(const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return bad_input("cannot be read: there is no such file", {path});
    return TaxelReader(TRY(LineReader::open(path))).read();
}

}  // namespace corpuscle
