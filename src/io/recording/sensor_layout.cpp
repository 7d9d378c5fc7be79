#include "io/recording/column_selection.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/text/named_columns.hpp"

namespace corpuscle {
namespace {

class LayoutReader {
    NamedColumns layout_;
    const Table& table_;                                   // of the recording
    std::optional<std::size_t> time_;                      // its time column
    std::span<const AxisSensor> axis_sensors_;             // its three-axis sensors
    std::optional<std::size_t> directions_[3] = {};        // columns x_axis, y_axis, z_axis
    std::size_t channel_ = 0;                              // columns of the layout
    std::optional<std::size_t> name_ = {}, axes_[3] = {};  // axes_: of x, y, z
    double metres_[3] = {1, 1, 1};                         // the units of x, y, z, m
    bool has_length_unit_ = true;                          // false: an axis has no unit

    /// Stores the column and the unit of an axis: 0 is x, 1 is y, 2 is z.
    Result<void> find_axis(std::size_t axis) {
        constexpr std::string_view names[] = {"x", "y", "z"};
        axes_[axis] = layout_.find({names[axis]});
        if (!axes_[axis]) return {};
        const auto& heading = layout_.headings()[*axes_[axis]];
        if (heading.unit.empty()) return has_length_unit_ = false, Result<void>{};
        const auto unit = parse_unit(heading.unit);
        if (!unit || !unit->has_same_dimension(*parse_unit("m")))
            return layout_.error_at(
                fmt::format("'{}' is in '{}', which is not a length; use m, cm, mm or um, or no unit", heading.name, heading.unit),
                *axes_[axis]);
        metres_[axis] = unit->factor;
        return {};
    }

    Result<void> read_headings() {
        if (!TRY(layout_.read_header())) return bad_input("no layout in this file", {layout_.path()});
        for (std::size_t axis = 0; axis < 3; ++axis) TRY(find_axis(axis));
        const auto channel = layout_.find({"channel", "sensor"});
        if (!channel)
            return layout_.error_at(fmt::format("a layout needs a column 'channel' (and may have name, x, y, z); this header has: {}",
                                                joined(layout_.fields())));
        channel_ = *channel, name_ = layout_.find({"name"});
        constexpr std::string_view names[] = {"x_axis", "y_axis", "z_axis"};
        for (std::size_t axis = 0; axis < 3 && !axis_sensors_.empty(); ++axis) directions_[axis] = layout_.find({names[axis]});
        return {};
    }

    /// The position in the current line; nullopt if the file has no coordinates.
    Result<std::optional<Position>> position() const {
        Position p;
        double* const coordinates[] = {&p.x, &p.y, &p.z};
        bool any = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!axes_[axis]) continue;
            const auto field = *axes_[axis];
            double value;
            if (!layout_.number(field, value))
                return layout_.error_at(fmt::format("'{}' where a coordinate is expected", layout_.fields()[field].substr(0, 40)), field);
            *coordinates[axis] = value * metres_[axis];
            any = true;
        }
        return any ? std::optional(p) : std::nullopt;
    }

    /// The three-axis sensor called `wanted`, or with this number, counted from 1.
    Result<std::size_t> axis_sensor(std::string_view wanted) const {
        std::vector<std::string_view> names;
        for (const auto& s : axis_sensors_) names.push_back(s.name);
        for (std::size_t k = 0; k < names.size(); ++k)
            if (names[k] == wanted) return k;
        if (const auto number = parse_bare_number<std::size_t>(wanted); number && *number >= 1 && *number <= names.size())
            return *number - 1;
        const auto shown = std::span(names).first(std::min<std::size_t>(names.size(), 24));
        return layout_.error_at(
            fmt::format("no three-axis sensor '{}'{}; there are {}: {}{}", wanted.substr(0, 40), did_you_mean(wanted, names), names.size(),
                        joined(shown), shown.size() < names.size() ? " ..." : ""),
            channel_);
    }

    /// The axes of the sensor in the current line.
    Result<SensorAxes> axes() const {
        const auto text = [&](std::size_t axis) {
            return directions_[axis] ? trimmed(layout_.fields()[*directions_[axis]]) : std::string_view();
        };
        auto out = parse_sensor_axes(text(0), text(1), text(2));
        if (out) return out;
        const auto first = std::find_if(std::begin(directions_), std::end(directions_), [](const auto& d) { return d.has_value(); });
        return layout_.error_at(fmt::format("'{}': {}", layout_.fields()[channel_], out.error().message), **first);
    }

    /// The column of the channel in the current line.
    Result<std::size_t> channel_column() const {
        const auto& fields = layout_.fields();
        const auto columns = select_columns(table_, time_, {std::string(fields[channel_])}, "");
        if (!columns) return layout_.error_at(columns.error().message, channel_);
        if (columns->size() != 1) return layout_.error_at(fmt::format("'{}' is more than one channel", fields[channel_]), channel_);
        return columns->front();
    }

    /// The sensor in the current line. A channel that is in `layout_so_far` is an error.
    Result<SensorPlacement> sensor(const SensorLayout& layout_so_far) const {
        const auto& fields = layout_.fields();
        if (fields.size() != layout_.headings().size())
            return layout_.error_at(fmt::format("{} columns where {} are expected", fields.size(), layout_.headings().size()));
        const auto column = TRY(axis_sensors_.empty() ? channel_column() : axis_sensor(fields[channel_]));
        const auto same = [&](const SensorPlacement& p) { return p.column == column; };
        if (std::any_of(layout_so_far.sensors.begin(), layout_so_far.sensors.end(), same))
            return layout_.error_at(fmt::format("channel '{}' occurs twice", fields[channel_]), channel_);
        auto placed_at = TRY(position());
        return SensorPlacement{column, name_ ? std::string(fields[*name_]) : "", placed_at, TRY(axes())};
    }

public:
    LayoutReader(LineReader lines, const Table& table, std::optional<std::size_t> time, std::span<const AxisSensor> axis_sensors)
        : layout_(std::move(lines)), table_(table), time_(time), axis_sensors_(axis_sensors) {}

    Result<SensorLayout> read() {
        TRY(read_headings());
        SensorLayout layout;
        layout.has_length_unit = has_length_unit_;
        while (TRY(layout_.next())) layout.sensors.push_back(TRY(sensor(layout)));
        if (layout.sensors.empty()) return bad_input("the layout lists no sensors", {layout_.path()});
        return layout;
    }
};

}  // namespace

Result<SensorLayout> read_sensor_layout(const std::string& path, const Table& table, std::optional<std::size_t> time,
                                        std::span<const AxisSensor> axis_sensors) {
    auto lines = TRY(LineReader::open(path));
    return LayoutReader(std::move(lines), table, time, axis_sensors).read();
}

}  // namespace corpuscle
