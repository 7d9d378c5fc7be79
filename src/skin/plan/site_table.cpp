#include "skin/plan/site_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/text/dialect.hpp"
#include "io/text/line_reader.hpp"
#include "io/text/text_table.hpp"

namespace corpuscle {
namespace {

/// Reads a table of sites row by row.
class SiteTableReader {
    LineReader lines_;
    Dialect dialect_;
    Fields fields_;
    std::string_view line_;
    std::optional<std::size_t> name_, region_, axes_[2];  // columns, counted from 0; axes_: of x and y
    double metres_[2] = {};                               // metres per unit of x and of y
    std::size_t columns_ = 0;                             // number of columns

    /// An error in the current line, at a field; without a field at the line only.
    Error error_at(std::string message, std::size_t field = std::string::npos) const {
        const long column = field < fields_.size() ? fields_[field].data() - line_.data() + 1 : 0;
        return bad_input(std::move(message), {lines_.path(), lines_.line_number(), column});
    }

    /// Reads the next line that is neither empty nor a comment; false at the end of the file.
    Result<bool> next_line() {
        for (;;) {
            const auto more = lines_.next(line_);
            if (!more || !*more) return more;
            if (const auto s = trimmed(line_); !s.empty() && s.front() != '#') return true;
        }
    }

    Result<void> read_header() {
        const auto more = TRY(next_line());
        if (!more) return bad_input("no sites in this file", {lines_.path()});
        dialect_ = Dialect::detect(line_);
        dialect_.split(line_, fields_);
        columns_ = fields_.size();
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            const auto heading = parse_heading(fields_[f]);
            const auto word = lower(heading.name);
            if (word == "name") name_ = f;
            if (word == "region") region_ = f;
            for (std::size_t axis = 0; axis < 2; ++axis) {
                if (word != std::string(1, "xy"[axis])) continue;
                const auto unit = parse_unit(heading.unit);
                if (heading.unit.empty() || !unit || !unit->has_same_dimension(*parse_unit("m")))
                    return error_at(fmt::format("column '{0}' needs a unit of length; write {1}_mm or {1}_m", fields_[f], word), f);
                axes_[axis] = f, metres_[axis] = unit->factor;
            }
        }
        if (!name_ || !axes_[0] || !axes_[1])
            return error_at(
                fmt::format("a table of sites needs the columns name, x and y (x_mm, y_mm); this one has {}", fmt::join(fields_, ", ")));
        return {};
    }

    Result<void> add_site(Sites& out) const {
        if (fields_.size() != columns_) return error_at(fmt::format("{} columns instead of {}", fields_.size(), columns_));
        double position[2];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            if (!dialect_.parse_number(fields_[*axes_[axis]], position[axis]))
                return error_at(fmt::format("'{}' is not a coordinate", fields_[*axes_[axis]].substr(0, 40)), *axes_[axis]);
            position[axis] *= metres_[axis];
            if (!(std::abs(position[axis]) <= 10))
                return error_at(fmt::format("{:g} m is too far away: coordinates must be within 10 m", position[axis]), *axes_[axis]);
        }
        if (out.size() == max_sites) return error_at(fmt::format("more than {} sites", max_sites));
        out.positions.push_back({position[0], position[1], 0}), out.names.emplace_back(fields_[*name_]);
        const std::string region(region_ ? fields_[*region_] : "skin");
        const auto found = std::find(out.regions.begin(), out.regions.end(), region);
        out.region.push_back(static_cast<std::uint32_t>(found - out.regions.begin()));
        if (found == out.regions.end()) out.regions.push_back(region);
        return {};
    }

public:
    explicit SiteTableReader(LineReader lines) : lines_(std::move(lines)) {}

    Result<Sites> read() {
        TRY(read_header());
        Sites out;
        for (;;) {
            const auto more = TRY(next_line());
            if (!more) break;
            dialect_.split(line_, fields_);
            TRY(add_site(out));
        }
        if (out.positions.empty()) return bad_input("no sites in this file", {lines_.path()});
        return out;
    }
};

}  // namespace

Result<Sites> read_site_table(const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return bad_input("cannot be read: there is no such file", {path});
    auto lines = TRY(LineReader::open(path));
    return SiteTableReader(std::move(lines)).read();
}

}  // namespace corpuscle
