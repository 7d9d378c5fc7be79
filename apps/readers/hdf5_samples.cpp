// Reads a dataset of an HDF5 file as samples.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "hdf5_file.hpp"
#include "helper_main.hpp"
#include "io/table/foreign_format.hpp"
#include "nwb_series.hpp"

namespace corpuscle {
namespace {

using hdf5::Handle;

// Size of the band (Hdf5Samples::band_), in numbers: the usual size, and the limit if a chunk needs more.
constexpr std::size_t default_band = std::size_t{1} << 20, max_band = std::size_t{1} << 26;
constexpr std::size_t max_passes = 16;  // a chunk above max_band is read in at most this many parts, and decompressed for each

constexpr const char* channel_name_attributes[] = {"columns", "channels", "names"};  // attributes with the names of all channels

/// The path of the group that contains an object.
std::string parent_of(const std::string& name) { return name.substr(0, std::max<std::size_t>(1, name.rfind('/'))); }

class Hdf5Samples final : public Samples {
    std::string path_, name_;
    Handle dataset_;
    ArrayExtent extent_;
    std::size_t rank_ = 1;              // number of dimensions of the dataset
    std::vector<std::string> members_;  // the numeric members of a compound type, which are its columns; else empty
    double factor_ = 1, offset_ = 0;    // value = factor * stored number + offset, from attributes of NWB (Neurodata Without Borders)
    hdf5::StorageInfo storage_;

    // The rows in memory are a band: one or several complete chunks, so that each chunk is decompressed only once (or a part of a chunk
    // that is too large).
    std::vector<double> band_;
    std::vector<std::size_t> band_columns_;    // the requested columns
    std::uint64_t first_ = 0, band_rows_ = 0;  // first row of the band in the dataset, and number of rows of the band
    std::uint64_t low_ = 0;                    // first column of the band in the dataset; 0 for a compound type
    std::size_t width_ =
        0;  // number of columns of the band, from the first to the last requested; for a compound type, of requested members

    Error unreadable() const { return bad_input(fmt::format("cannot read {}; the file may be damaged", name_), {path_}); }

    // Rows and columns of a chunk. chunk_rows() is 0 if the dataset is not chunked; chunk_columns() needs a chunked dataset.
    std::uint64_t chunk_rows() const { return storage_.chunk.empty() ? 0 : storage_.chunk[extent_.is_transposed ? rank_ - 1 : 0]; }
    std::uint64_t chunk_columns() const { return rank_ == 1 ? 1 : storage_.chunk[extent_.is_transposed ? 0 : 1]; }

    /// Reads the rows and columns of the band from the file, in the order of the file. `type` is the type of an element in memory.
    Result<void> load(hid_t type) {
        std::array<hsize_t, 2> start{first_, low_}, count{band_rows_, members_.empty() ? width_ : 1};
        if (extent_.is_transposed && rank_ == 2) std::swap(start[0], start[1]), std::swap(count[0], count[1]);
        const Handle space(H5Dget_space(dataset_), H5Sclose),
            memory(H5Screate_simple(static_cast<int>(rank_), count.data(), nullptr), H5Sclose);
        if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
            H5Dread(dataset_, type, memory, space, H5P_DEFAULT, band_.data()) < 0)
            return unreadable();
        return {};
    }

    /// The index in band_ of an element. Row and column are relative to the band; for a compound type, `column` counts the requested
    /// members, which are interleaved.
    std::size_t index_of(std::size_t row, std::size_t column) const {
        return extent_.is_transposed && rank_ == 2 && members_.empty() ? column * band_rows_ + row : row * width_ + column;
    }

    /// Sets the numbers of the band that lie in chunks that were never written to NaN. Only for chunked datasets.
    void mark_gaps() {
        const auto high = members_.empty() ? low_ + width_ : 1;
        for (auto row = first_ / chunk_rows() * chunk_rows(); row < first_ + band_rows_; row += chunk_rows())
            for (auto column = low_ / chunk_columns() * chunk_columns(); column < high; column += chunk_columns()) {
                std::array<hsize_t, 2> offset{row, column};
                if (extent_.is_transposed && rank_ == 2) std::swap(offset[0], offset[1]);
                if (hdf5::is_chunk_written(dataset_, std::span(offset).first(rank_))) continue;
                const auto from = std::max(row, first_) - first_, to = std::min(row + chunk_rows(), first_ + band_rows_) - first_;
                const auto left = members_.empty() ? std::max(column, low_) - low_ : 0,
                           right = members_.empty() ? std::min(column + chunk_columns(), low_ + width_) - low_ : width_;
                for (auto k = from; k < to; ++k)
                    for (auto c = left; c < right; ++c) band_[index_of(k, c)] = std::numeric_limits<double>::quiet_NaN();
            }
    }

    /// Chooses the rows of the band that contains `row`: complete chunks, or one of several equal parts of a chunk that is too large. Needs
    /// width_.
    Result<void> choose_rows(std::uint64_t row) {
        const std::uint64_t height = chunk_rows(), default_rows = std::max<std::size_t>(1, default_band / width_),
                            max_rows = std::max<std::size_t>(1, max_band / width_);
        first_ = row, band_rows_ = default_rows;
        if (height > 0 && height <= max_rows) {
            first_ = row / height * height;
            band_rows_ = std::max<std::uint64_t>(1, default_rows / height) * height;
        } else if (height > 0) {
            const auto passes = (height - 1) / max_rows + 1, rows = (height - 1) / passes + 1, chunk = row / height * height;
            if (passes > max_passes)
                return bad_input(
                    fmt::format("{}: {} columns in chunks of {} rows do not fit into memory. Select some columns by --channel, "
                                "or repack the file: h5repack -l {} {} repacked.h5",
                                name_, width_, height, quote_shell_word(name_ + ":CHUNK=4096x64"), quote_shell_word(path_)),
                    {path_});
            first_ = chunk + (row - chunk) / rows * rows;
            band_rows_ = std::min(rows, chunk + height - first_);
        }
        band_rows_ = std::min(band_rows_, extent_.rows - first_);
        return {};
    }

    /// Reads the band that contains `row`. After an error the band is empty.
    Result<void> load_band(std::uint64_t row, std::span<const std::size_t> columns) {
        band_columns_.assign(columns.begin(), columns.end());
        const auto [min, max] = std::minmax_element(columns.begin(), columns.end());
        low_ = members_.empty() ? *min : 0;
        width_ = members_.empty() ? *max - *min + 1 : columns.size();
        if (auto ok = choose_rows(row); !ok) return band_rows_ = 0, ok;
        band_.resize(band_rows_ * width_);
        Handle compound;
        if (!members_.empty()) compound = Handle(H5Tcreate(H5T_COMPOUND, width_ * sizeof(double)), H5Tclose);
        for (std::size_t i = 0; compound && i < width_; ++i)
            H5Tinsert(compound, members_[columns[i]].c_str(), i * sizeof(double), H5T_NATIVE_DOUBLE);
        if (auto ok = load(members_.empty() ? H5T_NATIVE_DOUBLE : compound); !ok) return band_rows_ = 0, ok;
        if (storage_.has_gaps) mark_gaps();
        return {};
    }

    bool is_in_band(std::uint64_t row, std::span<const std::size_t> columns) const {
        return row >= first_ && row < first_ + band_rows_ &&
               std::equal(columns.begin(), columns.end(), band_columns_.begin(), band_columns_.end());
    }

    /// Determines orientation, number of rows and storage. MATLAB stores matrices by columns, so the first dimension in HDF5 is MATLAB's
    /// second.
    Result<void> read_shape(const ArrayInfo& array, ExtentHints hints) {
        hints.is_column_major = hdf5::text_attribute(dataset_, "MATLAB_class").has_value();
        for (const auto* attribute : channel_name_attributes)
            if (const auto labels = hdf5::string_attributes(dataset_, attribute); labels.size() > 1) hints.channel_names = labels.size();
        extent_ = TRY(extent_of(array, path_, hints));
        rank_ = array.shape.size();
        if (!extent_.note.empty()) info_.notes.push_back(extent_.note);
        info_.rows = static_cast<std::int64_t>(extent_.rows);
        storage_ = TRY(hdf5::check_storage(dataset_, array, path_));
        info_.notes.insert(info_.notes.end(), storage_.notes.begin(), storage_.notes.end());
        return {};
    }

    /// Names the columns after the members of a compound type, or after the dataset (after its group if the dataset is called "data"), or
    /// as an attribute with the names of all channels says.
    Result<void> name_columns() {
        const Handle type(H5Dget_type(dataset_), H5Tclose);
        for (const auto& m : hdf5::numeric_members(type)) members_.push_back(m.name), info_.columns.push_back(parse_heading(m.name));
        if (!members_.empty() && extent_.columns > 1)
            return bad_input(fmt::format("{}: compound types must have one dimension", name_), {path_});
        if (!members_.empty()) return {};
        const auto name = last_path_component(name_);
        info_.columns =
            columns_named_after(name == "data" ? last_path_component(parent_of(name_)) : name, static_cast<std::size_t>(extent_.columns));
        for (const auto* attribute : channel_name_attributes)
            if (const auto labels = hdf5::string_attributes(dataset_, attribute); labels.size() == info_.columns.size())
                for (std::size_t c = 0; c < labels.size(); ++c) {
                    auto heading = parse_heading(labels[c]);
                    if (heading.unit.empty()) heading.unit = info_.columns[c].unit;
                    info_.columns[c] = std::move(heading);
                }
        return {};
    }

    /// Applies the unit attribute to the columns and reads the scaling. In a compound type the unit applies to columns without a unit of
    /// their own, except times.
    void read_unit() {
        for (const auto* attribute : {"unit", "units"})
            if (const auto unit = hdf5::text_attribute(dataset_, attribute))
                for (auto& column : info_.columns)
                    if (members_.empty() || (column.unit.empty() && !is_time_name(column.name))) column.unit = *unit;
        if (!members_.empty()) return;
        factor_ = hdf5::number_attribute(dataset_, "conversion").value_or(1);
        offset_ = hdf5::number_attribute(dataset_, "offset").value_or(0);
    }

public:
    Hdf5Samples(std::string path, std::string name, Handle dataset)
        : path_(std::move(path)), name_(std::move(name)), dataset_(std::move(dataset)) {}

    Result<void> open(const ArrayInfo& array, const ExtentHints& hints) {
        TRY(read_shape(array, hints));
        TRY(name_columns());
        read_unit();
        return {};
    }

    Result<void> fetch(std::int64_t start, std::size_t rows, std::span<const std::size_t> columns,
                       std::vector<std::vector<double>>& out) override {
        for (std::size_t done = 0, count = 0; done < rows && !columns.empty(); done += count) {
            const auto row = static_cast<std::uint64_t>(start) + done;
            if (!is_in_band(row, columns)) TRY(load_band(row, columns));
            const auto from = static_cast<std::size_t>(row - first_);
            count = std::min<std::size_t>(rows - done, band_rows_ - from);
            for (std::size_t i = 0; i < columns.size(); ++i) {
                const auto column = members_.empty() ? columns[i] - low_ : i;
                for (std::size_t k = 0; k < count; ++k) out[i][done + k] = band_[index_of(from + k, column)] * factor_ + offset_;
            }
        }
        return {};
    }
};

/// The sampling rate (Hz) in the attributes of a dataset or group.
std::optional<double> rate_at(hid_t object) {
    for (const auto& name : hdf5::attribute_names(object))
        if (is_rate_name(name))
            if (const auto rate = hdf5::number_attribute(object, name)) return rate;
    return {};
}

/// The sampling rate (Hz) of the dataset `name`, from its attributes if they have it. The next source is another dataset of its group:
/// NWB's starting_time, or a single number with the name of a rate. The last are the attributes of the enclosing groups, the innermost
/// first.
std::optional<double> rate_of(hid_t file, const std::string& name, std::span<const ArrayInfo> arrays) {
    if (const auto dataset = hdf5::open_dataset(file, name))
        if (const auto rate = rate_at(dataset)) return rate;
    for (const auto& a : arrays) {
        if (parent_of(a.name) != parent_of(name)) continue;
        const auto dataset = hdf5::open_dataset(file, a.name);
        if (const auto rate = last_path_component(a.name) == "starting_time" ? rate_at(dataset) : std::nullopt) return rate;
        if (const auto rate = is_rate_name(last_path_component(a.name)) ? hdf5::single_number(dataset) : std::nullopt) return rate;
    }
    for (auto group = parent_of(name);; group = parent_of(group)) {
        if (const Handle object(H5Oopen(file, group.c_str(), H5P_DEFAULT), H5Oclose); object)
            if (const auto rate = rate_at(object)) return rate;
        if (group == "/") return {};
    }
}

/// The time of the first sample in s: NWB's starting_time beside the dataset. 0 if there is none.
double start_of(hid_t file, const std::string& name) {
    const auto path = parent_of(name) + "/starting_time";
    const auto dataset = H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0 ? hdf5::open_dataset(file, path) : Handle();
    const auto start = dataset && rate_at(dataset) ? hdf5::single_number(dataset) : std::nullopt;
    return start && std::isfinite(*start) ? *start : 0;
}

/// Opens an array of the file as samples, without a sampling rate.
Result<std::unique_ptr<Hdf5Samples>> samples_of(hid_t file, const std::string& path, const ArrayInfo& array, const ExtentHints& hints) {
    auto dataset = hdf5::open_dataset(file, array.name);
    if (!dataset) return bad_input(fmt::format("cannot open {}; the file may be damaged", array.name), {path});
    auto samples = std::make_unique<Hdf5Samples>(path, array.name, std::move(dataset));
    TRY(samples->open(array, hints));
    return samples;
}

/// The arrays in the group of the chosen dataset that can be lists of sample times.
std::vector<const ArrayInfo*> time_arrays(const ArrayInfo& chosen, std::span<const ArrayInfo> arrays) {
    std::vector<const ArrayInfo*> out;
    for (const auto& a : arrays)
        if (a.name != chosen.name && parent_of(a.name) == parent_of(chosen.name) && time_list_length(a)) out.push_back(&a);
    return out;
}

/// The first list of sample times with as many times as the chosen dataset has rows, or null.
const ArrayInfo* times_of(const ArrayInfo& chosen, std::int64_t rows, std::span<const ArrayInfo> arrays) {
    for (const auto* a : time_arrays(chosen, arrays))
        if (time_list_length(*a) == static_cast<std::uint64_t>(rows)) return a;
    return nullptr;
}

/// True if this path in the file is a link to another file.
bool is_external_link(hid_t file, const std::string& name) {
    H5L_info_t link{};
    return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0 && H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) >= 0 &&
           link.type == H5L_TYPE_EXTERNAL;
}

}  // namespace

SamplesResult open_hdf5_samples(int descriptor, const std::string& path, const TableOptions& options) {
    const auto file = TRY(hdf5::open_file(descriptor, path));
    const auto arrays = hdf5::datasets_in(file);
    const auto force = options.dataset || !is_nwb(file) ? std::optional<std::size_t>() : TRY(choose_force_series(file, arrays, path));
    const auto chosen = force ? *force : choose_array(arrays, options.dataset, path);
    if (!chosen && options.dataset && is_external_link(file, *options.dataset))
        return bad_input(fmt::format("'{}' is a link to another file, which is not followed; open that file instead", *options.dataset),
                         {path});
    if (!chosen) return chosen.error();
    const auto& array = arrays[*chosen];
    ExtentHints hints{options.transpose};
    for (const auto* times : time_arrays(array, arrays)) hints.time_lengths.push_back(*time_list_length(*times));
    auto samples = TRY(samples_of(file, path, array, hints));
    samples->set_rate(rate_of(file, array.name, arrays));
    samples->set_start(start_of(file, array.name));
    const auto* times = times_of(array, samples->info().rows, arrays);
    if (!times) return std::unique_ptr<Samples>(std::move(samples));
    auto clock = TRY(samples_of(file, path, *times, {}));
    return add_time_column(std::move(clock), std::move(samples));
}

}  // namespace corpuscle
