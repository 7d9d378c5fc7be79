#include "io/recording/sensor_layout.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/recording/column_selection.hpp"
#include "io/text/dialect.hpp"
#include "io/text/line_reader.hpp"
#include "io/text/text_table.hpp"

namespace corpuscle {
namespace {

/// The columns of the layout file.
struct Headings {
    std::optional<std::size_t> channel, name, axes[3];  ///< indices of these columns; axes: x, y, z
    double metres[3] = {1, 1, 1};                       ///< the unit of each axis, in m
    std::size_t count = 0;                              ///< number of columns
    bool unitless = false;                              ///< true: an axis has no unit
};

class LayoutReader {
    LineReader lines_;  // of the layout file
    Dialect dialect_;
    const Table& table_;               // of the recording
    std::optional<std::size_t> time_;  // its time column
    Headings headings_;
    Fields fields_;          // of the current line
    std::string_view line_;  // the current line

    /// An error in the current line, at the field with this index if it is given.
    Error error_at(std::string message, std::size_t field = std::string::npos) const {
        const long column = field < fields_.size() ? fields_[field].data() - line_.data() + 1 : 0;
        return bad_input(std::move(message), {lines_.path(), lines_.line_number(), column});
    }

    /// Reads the next line that is neither empty nor a comment. Returns false at the end of the file.
    Result<bool> next_line() {
        for (;;) {
            const auto more = lines_.next(line_);
            if (!more || !*more) return more;
            if (const auto s = trimmed(line_); !s.empty() && s.front() != '#' && s.front() != '%') return true;
        }
    }

    /// Stores the column and the unit of an axis: 0 is x, 1 is y, 2 is z. `field` is the index of its column.
    Result<void> read_axis(std::size_t axis, std::size_t field, const Column& heading) {
        headings_.axes[axis] = field;
        if (heading.unit.empty()) return headings_.unitless = true, Result<void>{};
        const auto unit = parse_unit(heading.unit);
        if (!unit || !unit->has_same_dimension(*parse_unit("m")))
            return error_at(
                fmt::format("'{}' is in '{}', which is not a length; use m, cm, mm or um, or no unit", heading.name, heading.unit), field);
        headings_.metres[axis] = unit->factor;
        return {};
    }

    Result<void> read_headings() {
        const auto more = TRY(next_line());
        if (!more) return bad_input("no layout in this file", {lines_.path()});
        dialect_ = Dialect::detect(line_);
        dialect_.split(line_, fields_);
        headings_.count = fields_.size();
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            const auto heading = parse_heading(fields_[f]);
            const auto word = lower(heading.name);
            if (word == "channel" || word == "sensor") headings_.channel = f;
            if (word == "name") headings_.name = f;
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (word == std::string(1, "xyz"[axis])) TRY(read_axis(axis, f, heading));
        }
        if (!headings_.channel)
            return error_at(fmt::format("a layout needs a column 'channel' (and may have name, x, y, z); this header has: {}",
                                        fmt::join(fields_, ", ")));
        return {};
    }

    /// The position in the current line; nullopt if the file has no coordinates.
    Result<std::optional<Position>> position() const {
        Position p;
        double* const coordinates[] = {&p.x, &p.y, &p.z};
        bool any = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!headings_.axes[axis]) continue;
            const auto field = *headings_.axes[axis];
            double value;
            if (!dialect_.parse_number(fields_[field], value))
                return error_at(fmt::format("'{}' where a coordinate is expected", fields_[field].substr(0, 40)), field);
            *coordinates[axis] = value * headings_.metres[axis];
            any = true;
        }
        return any ? std::optional(p) : std::nullopt;
    }

    /// The sensor in the current line. A channel that is in `layout_so_far` is an error.
    Result<SensorPlacement> sensor(const SensorLayout& layout_so_far) const {
        if (fields_.size() != headings_.count)
            return error_at(fmt::format("{} columns where {} are expected", fields_.size(), headings_.count));
        const auto field = *headings_.channel;
        const auto columns = select_columns(table_, time_, {std::string(fields_[field])}, "");
        if (!columns) return error_at(columns.error().message, field);
        if (columns->size() != 1) return error_at(fmt::format("'{}' is more than one channel", fields_[field]), field);
        const auto same = [&](const SensorPlacement& p) { return p.column == columns->front(); };
        if (std::any_of(layout_so_far.sensors.begin(), layout_so_far.sensors.end(), same))
            return error_at(fmt::format("channel '{}' occurs twice", fields_[field]), field);
        auto placed_at = TRY(position());
        return SensorPlacement{columns->front(), headings_.name ? std::string(fields_[*headings_.name]) : "", placed_at};
    }

public:
    LayoutReader(LineReader lines, const Table& table, std::optional<std::size_t> time)
        : lines_(std::move(lines)), table_(table), time_(time) {}

    Result<SensorLayout> read() {
        TRY(read_headings());
        SensorLayout layout;
        layout.has_length_unit = !headings_.unitless;
        for (;;) {
            const auto more = TRY(next_line());
            if (!more) break;
            dialect_.split(line_, fields_);
            layout.sensors.push_back(TRY(sensor(layout)));
        }
        if (layout.sensors.empty()) return bad_input("the layout lists no sensors", {lines_.path()});
        return layout;
    }
};

}  // namespace

Result<SensorLayout> read_sensor_layout(const std::string& path, const Table& table, std::optional<std::size_t> time) {
    auto lines = TRY(LineReader::open(path));
    return LayoutReader(std::move(lines), table, time).read();
}

}  // namespace corpuscle
