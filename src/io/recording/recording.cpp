#include "io/recording/recording.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <unordered_map>

#include "core/afferent.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "io/quality/quality_report.hpp"
#include "io/recording/column_selection.hpp"
#include "io/recording/recording_formats.hpp"
#include "io/recording/row_curve.hpp"
#include "io/recording/samples.hpp"
#include "io/table/foreign_format.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_channels = std::size_t{1} << 17;

/// The name of a recording: "press" for "trials/press.csv.gz".
std::string name_of_recording(const std::filesystem::path& path) {
    return (lower(path.extension().string()) == ".gz" ? path.stem().stem() : path.stem()).string();
}

class Recording final : public ForceSource {
    std::unique_ptr<Table> table_;
    RecordingOptions options_;
    std::string path_, name_;
    RowClock row_clock_;  // of the rows of the file
    Clock clock_;         // of the samples that read() returns; differs from row_clock_.clock after resampling
    std::vector<Channel> channels_;
    std::unordered_map<std::string, int> name_counts_;  // number of channels with each name
    std::vector<std::string> notes_, selection_notes_;  // selection_notes_: about the selected columns
    std::vector<std::string> calibration_warnings_;
    std::vector<AxisSensor> axis_sensors_;         // the three-axis sensors whose columns are the channels; empty: none
    std::vector<std::optional<Position>> placed_;  // the positions of the three-axis sensors, if a layout gives them
    std::unique_ptr<HumTable> hum_table_;
    std::optional<ForceRows> rows_;
    std::int64_t samples_ = 0;  // samples returned so far
    // For resampling.
    std::int64_t next_ = 0;        // index of the next sample
    std::int64_t row_number_ = 0;  // number of rows read so far
    RowCurve curve_;

    /// Applies the layout to the three-axis sensors: their order, names, positions and axes.
    Result<void> place_axis_sensors(std::optional<std::size_t> time) {
        const auto layout = TRY(read_sensor_layout(options_.layout, *table_, time, axis_sensors_));
        if (!layout.has_length_unit)
            notes_.push_back("the layout has no unit of length, so only the relative positions of the sensors are used");
        std::vector<AxisSensor> placed;
        for (const auto& p : layout.sensors) {
            placed.push_back(axis_sensors_[p.column]);
            if (!p.name.empty()) placed.back().name = p.name;
            placed.back().axes = p.axes;
            placed_.push_back(p.position);
        }
        axis_sensors_ = std::move(placed);
        return {};
    }

    /// The columns of the three-axis sensors. Adds a note about those that belong to no sensor.
    Result<std::vector<SensorPlacement>> choose_axis_columns(std::optional<std::size_t> time) {
        TRY(check_axis_options(options_, axis_sensors_));
        std::vector<char> is_used(table_->columns().size(), 0);
        for (const auto& s : axis_sensors_)
            for (const auto c : s.columns) is_used[c] = 1;
        if (!options_.layout.empty()) TRY(place_axis_sensors(time));
        std::vector<SensorPlacement> out;
        for (const auto& s : axis_sensors_)
            for (const auto c : s.columns) out.push_back({c, "", {}});
        std::vector<std::string> others;
        for (std::size_t c = 0; c < is_used.size(); ++c)
            if (!is_used[c] && c != time && table_->columns()[c].exclusion_reason.empty())
                others.push_back("'" + table_->columns()[c].name + "'");
        if (others.size() > 6) others.resize(6), others.push_back("...");
        if (!others.empty())
            selection_notes_.push_back(fmt::format("{} ignored: not an axis of a force (use --channel NAME to read one as a force)",
                                                   joined(others) + (others.size() == 1 ? " was" : " were")));
        return out;
    }

    bool is_angle(std::size_t column) const {
        return std::any_of(axis_sensors_.begin(), axis_sensors_.end(),
                           [column](const AxisSensor& s) { return s.has_angles && (s.columns[1] == column || s.columns[2] == column); });
    }

    /// The columns that are channels, with their sensors' names and positions if a layout gives them. `time` is the time column.
    Result<std::vector<SensorPlacement>> choose_sensors(std::optional<std::size_t> time) {
        std::vector<SensorPlacement> chosen;
        if (!axis_sensors_.empty()) return choose_axis_columns(time);
        if (!options_.layout.empty()) {
            auto layout = TRY(read_sensor_layout(options_.layout, *table_, time));
            if (!layout.has_length_unit)
                notes_.push_back("the layout has no unit of length, so only the relative positions of the sensors are used");
            if (options_.channels.empty()) return std::move(layout.sensors);
            chosen = std::move(layout.sensors);  // --channel selects some of them below
        }
        const auto columns = TRY(select_columns(*table_, time, options_.channels, path_, &selection_notes_));
        std::vector<SensorPlacement> out;
        for (const auto c : columns) {
            const auto placed = std::find_if(chosen.begin(), chosen.end(), [&](const SensorPlacement& p) { return p.column == c; });
            out.push_back(placed == chosen.end() ? SensorPlacement{c, "", {}} : *placed);
        }
        return out;
    }

    Result<void> check_interpolation() const {
        if (!options_.interpolation) return {};
        if (!options_.resample) return bad_usage("--interpolation is the curve for --resample; add a rate, such as --resample 2kHz");
        return {};
    }

    /// Determines the clocks of the rows and of the samples.
    Result<void> set_clock(std::optional<std::size_t> time, const std::vector<std::size_t>& columns) {
        row_clock_ = TRY(find_row_clock(*table_, options_, path_, time, columns));
        clock_ = row_clock_.clock;
        notes_.insert(notes_.end(), row_clock_.notes.begin(), row_clock_.notes.end());
        TRY(check_interpolation());
        if (!options_.resample) return {};
        clock_ = TRY(make_clock(*options_.resample, clock_.t0));
        return {};
    }

    std::string channel_name(const SensorPlacement& placed) const {
        return placed.name.empty() ? table_->columns()[placed.column].name : placed.name;
    }
    /// True if a calibration gives newtons per unit.
    bool has_load(const SensorPlacement& placed) const {
        const auto* calibration = find_calibration(options_.calibrations, channel_name(placed));
        return calibration && calibration->load;
    }

    /// The scales of the chosen columns, as far as they are known before the rows are read. So a unit that is not a force is reported at
    /// once.
    Result<std::vector<ChannelScale>> find_scales(const std::vector<SensorPlacement>& chosen) const {
        std::vector<ChannelScale> out;
        for (const auto& p : chosen) {
            const auto& column = table_->columns()[p.column];
            const double gain = is_angle(p.column) ? radians_per_unit(column)
                                : has_load(p)      ? 1.0  // until the rows are read
                                                   : TRY(newtons_per_unit(column, options_, path_));
            out.push_back({gain, options_.offset});
        }
        return out;
    }

    /// Calibrates the channels by rows of the recording.
    Result<void> calibrate_channels(const std::vector<std::size_t>& columns, std::optional<std::size_t> time,
                                    std::vector<ChannelScale>& scales) {
        if (options_.calibrations.empty()) return {};
        std::vector<std::string> names;
        for (const auto& c : channels_) names.push_back(c.name);
        TRY(check_calibrations(options_, names, path_));
        CalibrationNotes found;
        const auto own_time = row_clock_.uses_row_times || row_clock_.drops_untimed ? time : std::nullopt;
        TRY(calibrate(options_, names, RowReader(*table_, options_, columns, own_time), row_clock_, path_, scales, found));
        notes_.insert(notes_.end(), found.notes.begin(), found.notes.end());
        calibration_warnings_ = std::move(found.warnings);
        return table_->rewind();
    }

    /// Adds a channel. If neither the file nor an option gives its unit, appends its name to `unitless`.
    void add_channel(const SensorPlacement& placed, std::vector<std::string>& unitless) {
        const auto& column = table_->columns()[placed.column];
        if (lacks_unit(column, options_) && !has_load(placed)) unitless.push_back(column.name);
        if (auto note = overridden_unit_note(column, options_); !note.empty() && !is_angle(placed.column))
            notes_.push_back(std::move(note));
        const auto& name = placed.name.empty() ? column.name : placed.name;
        const int occurrence = ++name_counts_[name];
        channels_.push_back({static_cast<std::uint32_t>(channels_.size()),
                             occurrence == 1 ? name : fmt::format("{} ({})", name, occurrence), placed.position});
    }

    /// Warns if there are more columns than samples and the columns have no names of their own: the table may have to be transposed.
    void warn_about_orientation(RecordingQuality& quality) const {
        const auto& columns = table_->columns();
        const auto samples = samples_;
        if (options_.table.transpose || options_.resample || static_cast<std::int64_t>(columns.size()) <= samples || samples == 0) return;
        const auto is_numbered = [this](const Column& c) {  // ch1, ch2 ... or 1, 2 ...
            if (table_->info().is_time_guessed && c.name == "time") return true;
            const std::string_view digits = std::string_view(c.name).substr(c.name.starts_with("ch") ? 2 : 0);
            return !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
        };
        if (table_->info().is_orientation_known || !std::all_of(columns.begin(), columns.end(), is_numbered)) return;
        quality.warnings.push_back(
            fmt::format("{} columns, but only {} rows. Use --transpose if each row is a channel, or --no-transpose if each row is "
                        "a sample",
                        columns.size(), samples));
    }

    /// True if the table has the columns of a spike file, which are a time and the afferent or unit that fired.
    bool holds_spikes(std::optional<std::size_t> time) const {
        const auto& columns = table_->columns();
        return time && options_.channels.empty() && columns.size() <= 3 && std::any_of(columns.begin(), columns.end(), [](const Column& c) {
                   constexpr std::string_view words[] = {"unit", "afferent", "cluster", "cluster_id", "unit_id", "neuron", "neuron_id"};
                   return std::any_of(std::begin(words), std::end(words), [&](auto w) { return equal_ignoring_case(c.name, w); });
               });
    }

    /// Adds the channels, and a note about those whose unit is not known.
    void add_channels(const std::vector<SensorPlacement>& chosen) {
        std::vector<std::string> unitless;
        for (const auto& placed : chosen) add_channel(placed, unitless);
        if (auto note = unitless_note(std::move(unitless)); !note.empty()) notes_.push_back(std::move(note));
    }

    /// Creates the pipelines of all channels. The filters run on the rows if these are evenly spaced, otherwise on the resampled samples.
    Result<std::vector<ChannelPipeline>> make_pipelines(const std::vector<ChannelScale>& scales) {
        hum_table_ = std::make_unique<HumTable>(clock_);
        const bool rows_are_even = !row_clock_.uses_row_times;
        std::vector<ChannelPipeline> pipelines;
        for (const auto& scale : scales) {
            auto pipeline =
                TRY(ChannelPipeline::make(options_, scale, rows_are_even ? row_clock_.clock : clock_, rows_are_even, *hum_table_));
            pipeline.is_component = !axis_sensors_.empty();
            pipelines.push_back(std::move(pipeline));
        }
        return pipelines;
    }

    /// Reads the next row. Returns false at the end of the file.
    Result<bool> read_row(RowCurve::Row& row) {
        const auto has_row = rows_->fetch_row();
        if (!has_row || !*has_row) return has_row;
        row.force.resize(channels_.size());
        for (std::size_t c = 0; c < channels_.size(); ++c) row.force[c] = rows_->force(c);
        row.t = row_clock_.uses_row_times ? row_clock_.seconds(rows_->time())
                                          : clock_.t0 + static_cast<double>(row_number_) * row_clock_.clock.T();
        rows_->advance();
        ++row_number_;
        return true;
    }

    /// Fills the block with samples that are interpolated between rows.
    Result<void> read_resampled(Frames& block) {
        const auto next_row = [this](RowCurve::Row& row) { return read_row(row); };
        if (!curve_.has_begun())
            if (const auto first = curve_.advance(next_row); !first || !*first) return first ? Result<void>() : first.error();
        for (; block.count < block.capacity; ++block.count, ++next_) {
            const double t = clock_.time(next_);
            while (curve_.time() < t - 1e-9 * clock_.T()) {  // a row at the time of the sample, apart from rounding, is not before it
                const auto next = TRY(curve_.advance(next_row));
                if (!next) return {};
            }
            for (std::size_t c = 0; c < channels_.size(); ++c) block.force[c][block.count] = curve_.force(c, t);
        }
        return {};
    }

    /// Fills the block with the rows as they are.
    Result<void> read_rows(Frames& block) {
        while (block.count < block.capacity) {
            const auto has_row = TRY(rows_->fetch_row());
            if (!has_row) return {};
            const auto n = std::min(rows_->ready_rows(), block.capacity - block.count);
            for (std::size_t c = 0; c < channels_.size(); ++c)
                std::copy_n(rows_->ready_data(c), n, block.force[c].begin() + static_cast<std::ptrdiff_t>(block.count));
            block.count += n;
            rows_->advance(n);
        }
        return {};
    }

public:
    /// `name`: "" for that of the file.
    Recording(std::string path, const std::string& name, std::unique_ptr<Table> table, RecordingOptions options)
        : table_(std::move(table)), options_(std::move(options)), path_(std::move(path)),
          name_(name.empty() ? name_of_recording(path_) : name), curve_(options_.interpolation.value_or(Interpolation::linear)) {}

    /// Selects the columns, determines the clock and prepares reading.
    Result<void> open() {
        const auto time = TRY(select_time_column(*table_, options_.time, path_));
        notes_ = table_->info().notes;
        if (const auto& notes = table_->info().time_notes; time && time == table_->info().time_column)
            notes_.insert(notes_.end(), notes.begin(), notes.end());
        if (holds_spikes(time)) return bad_input("this file holds spikes, not force; 'corpuscle compare' reads it", {path_});
        if (options_.channels.empty()) axis_sensors_ = TRY(find_axis_sensors(*table_, time, path_));
        const auto chosen = TRY(choose_sensors(time));
        if (chosen.size() > max_channels)
            return bad_input(fmt::format("{} channels are more than the limit of {}; select some, such as --channel 1-1000", chosen.size(),
                                         max_channels),
                             {path_});
        std::vector<std::size_t> columns;
        for (const auto& p : chosen) columns.push_back(p.column);
        auto scales = TRY(find_scales(chosen));
        TRY(set_clock(time, columns));
        notes_.insert(notes_.end(), selection_notes_.begin(), selection_notes_.end());
        add_channels(chosen);
        TRY(calibrate_channels(columns, time, scales));
        auto pipelines = TRY(make_pipelines(scales));
        std::vector<std::string> names;
        for (const auto& c : channels_) names.push_back(c.name);
        // The times are read with the rows if each row has its own time, or if rows without a time are dropped.
        const bool with_times = row_clock_.uses_row_times || row_clock_.drops_untimed;
        rows_.emplace(RowReader(*table_, options_, columns, with_times ? time : std::nullopt), std::move(pipelines), path_,
                      std::move(names), row_clock_.uses_row_times);
        return {};
    }

    const std::vector<AxisSensor>& axis_sensors() const { return axis_sensors_; }
    const std::vector<std::optional<Position>>& placed() const { return placed_; }
    bool is_recording() const override { return true; }
    const std::string& name() const override { return name_; }
    const Clock& clock() const override { return clock_; }
    const std::vector<Channel>& channels() const override { return channels_; }
    double progress() const override { return table_->progress(); }
    std::vector<MetadataEntry> metadata() const override {
        std::vector<MetadataEntry> all;
        for (std::size_t c = 0; c < channels_.size(); ++c)
            if (axis_sensors_.empty() || !axis_sensors_[c / 3].has_angles || c % 3 == 0)
                all.push_back({channels_[c].name + ": newtons per unit", rows_->pipelines()[c].gain(), "N"});
        for (std::size_t c = 0; c < channels_.size() && !options_.calibrations.empty(); ++c)
            all.push_back({channels_[c].name + ": reading at zero force", rows_->pipelines()[c].offset(), ""});
        all.push_back({"absolute value", options_.absolute ? 1.0 : 0.0, ""});
        if (options_.offset != 0) all.push_back({"offset", options_.offset, ""});
        if (options_.range)
            all.push_back({"range, low", options_.range->first, ""}), all.push_back({"range, high", options_.range->second, ""});
        if (options_.despike) all.push_back({"despike", options_.despike->limit.value_or(0), ""});
        for (const double f : options_.notch) all.push_back({"notch", f, "Hz"});
        if (options_.lowpass) all.push_back({"low-pass", *options_.lowpass, "Hz"});
        if (options_.zero) all.push_back({"rest period", *options_.zero, "s"});
        if (options_.deadband) all.push_back({"deadband", options_.deadband->band.value_or(0), "N"});
        if (options_.interpolation == Interpolation::smooth) all.push_back({"smooth interpolation", 1, ""});
        if (options_.resample) all.push_back({"resampled from", row_clock_.uses_row_times ? 0 : row_clock_.clock.rate(), "Hz"});
        return all;
    }
    std::string description() const override {
        return fmt::format("{} of {} at {:g} Hz", channels_.size() == 1 ? "a channel" : fmt::format("{} channels", channels_.size()),
                           std::filesystem::path(path_).filename().string(), clock_.rate());
    }
    std::vector<std::string> notes() const override { return notes_; }
    RecordingQuality quality() const override {
        auto found = assess_quality(channels_, *rows_, row_clock_);
        found.warnings.insert(found.warnings.end(), calibration_warnings_.begin(), calibration_warnings_.end());
        warn_about_orientation(found);
        return found;
    }

    Result<void> read(Frames& block) override {
        block.count = 0;
        TRY(options_.resample ? read_resampled(block) : read_rows(block));
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            const std::span<double> force(block.force[c].data(), block.count);
            rows_->pipelines()[c].finish_force(force);
            if (const auto bad = first_non_finite(force); bad < force.size())
                return bad_input(
                    fmt::format("'{}': sample {} is not finite after processing: a value in the file is too large for --scale or the "
                                "filters",
                                channels_[c].name, samples_ + static_cast<std::int64_t>(bad)),
                    {path_});
        }
        samples_ += static_cast<std::int64_t>(block.count);
        return {};
    }
};

/// The format with the file extension of `path`; text if no format has it.
const RecordingFormat& format_of_recording(const std::string& path) {
    const auto extension = lower(std::filesystem::path(path).extension().string());
    if (!extension.empty())
        for (const auto& f : recording_formats)
            if ((" " + std::string(f.extensions) + " ").find(" " + extension + " ") != std::string::npos) return f;
    return recording_formats[0];
}

}  // namespace

Result<std::unique_ptr<Table>> open_recording_table(const std::string& path, const RecordingOptions& options) {
    TRY(check_unit_options(options));
    const auto& format = format_of_recording(path);
    if (options.table.skip_lines > 0 && format.name != "text")
        return bad_usage(
            fmt::format("--skip {}: only text files have lines to skip, and {} is {}", options.table.skip_lines, path, format.name));
    if (format.name != "text") {  // MATLAB files before version 7.3 are not HDF5 files, but have the same extension
        const auto first = peek_input(path, 512);
        if (auto refusal = describe_foreign_format(first, path); !refusal.empty()) return bad_input(std::move(refusal), {path});
    }
    auto table_options = options.table;
    table_options.should_continue = [&] { return options.should_continue(0); };
    auto table = format.open(path, table_options);
    if (!table) return table.error();
    if (options.table.transpose == true && !(*table)->info().is_orientation_known) table = transpose_table(std::move(*table), path);
    if (table) remember_input(path);
    return table;
}

Result<std::unique_ptr<ForceSource>> make_recording(std::unique_ptr<Table> table, const std::string& path, const std::string& name,
                                                    const RecordingOptions& options) {
    auto recording = std::make_unique<Recording>(path, name, std::move(table), options);
    TRY(recording->open());
    if (auto sensors = recording->axis_sensors(); !sensors.empty()) {
        auto placed = recording->placed();
        return combine_axes(std::move(recording), std::move(sensors), std::move(placed), path);
    }
    return std::unique_ptr<ForceSource>(std::move(recording));
}

Result<std::unique_ptr<ForceSource>> open_recording(const std::string& path, const RecordingOptions& options) {
    auto table = TRY(open_recording_table(path, options));
    return make_recording(std::move(table), path, "", options);
}

}  // namespace corpuscle
