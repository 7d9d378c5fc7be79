#include "io/recording/recording_formats.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "io/recording/samples.hpp"
#include "io/table/npz.hpp"

namespace corpuscle {
namespace {

/// True if there are several channels and the samples of each channel are contiguous in the file.
bool has_contiguous_channels(const NpyHeader& header, const ArrayExtent& extent) {
    return extent.columns > 1 && header.is_column_major != extent.is_transposed;
}

class NpySamples final : public Samples {
    std::unique_ptr<SeekableBytes> bytes_;
    NpyHeader header_;
    ArrayExtent extent_;
    bool has_contiguous_channels_;
    std::vector<NpyField> fields_;   // the field of each column; if the array is not structured, a single field for all columns
    std::vector<std::byte> buffer_;  // the elements that were read last

    bool is_structured() const { return !header_.fields[0].name.empty(); }
    /// The index in fields_ of the field of a column.
    std::size_t field_of(std::size_t column) const { return is_structured() ? column : 0; }
    std::uint64_t element_offset(std::uint64_t number) const { return header_.data_offset + number * header_.element_size; }

    /// Reads elements `first` to `first` + `count` - 1, in the order of the file, into the buffer.
    Result<void> read_elements(std::uint64_t first, std::size_t count) {
        buffer_.resize(count * header_.element_size);
        TRY(bytes_->seek(element_offset(first)));
        return bytes_->read(buffer_);
    }

    /// Decodes `field` of every `stride`-th element of the buffer, from index `from` on, until `out` is full.
    void decode(const NpyField& field, std::size_t from, std::size_t stride, std::span<double> out) const {
        const auto number = field.decoder();
        const auto* at = buffer_.data() + from * header_.element_size + field.offset;
        for (auto& x : out) x = number(at), at += stride * header_.element_size;
    }

    /// fetch() for an array in which the samples of each channel are contiguous.
    Result<void> fetch_columns(std::uint64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                               std::vector<std::vector<double>>& out) {
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            TRY(read_elements(wanted[i] * extent_.rows + first, rows));
            decode(fields_[0], 0, 1, out[i]);
        }
        return {};
    }

public:
    NpySamples(std::unique_ptr<SeekableBytes> bytes, NpyHeader header, ArrayExtent extent)
        : bytes_(std::move(bytes)), header_(std::move(header)), extent_(std::move(extent)),
          has_contiguous_channels_(has_contiguous_channels(header_, extent_)) {
        if (!extent_.note.empty()) info_.notes.push_back(extent_.note);
        info_.rows = static_cast<std::int64_t>(extent_.rows);
    }

    /// Defines the columns. `name` is the name of the array, "" if it has none.
    void name_columns(std::string_view name) {
        if (!is_structured()) {
            fields_ = header_.fields;
            info_.columns = columns_named_after(name, static_cast<std::size_t>(extent_.columns));
        }
        for (const auto& f : header_.fields)
            if (is_structured() && f.is_numeric()) fields_.push_back(f), info_.columns.push_back(parse_heading(f.name));
    }

    Result<void> fetch(std::int64_t start, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        const auto first = static_cast<std::uint64_t>(start);
        const auto width = static_cast<std::size_t>(extent_.columns);
        if (has_contiguous_channels_) return fetch_columns(first, rows, wanted, out);
        const std::size_t max_rows = std::max<std::size_t>(1, (std::size_t{1} << 20) / (width * header_.element_size));
        for (std::size_t done = 0; done < rows; done += max_rows) {
            const auto count = std::min(max_rows, rows - done);
            TRY(read_elements((first + done) * width, count * width));
            for (std::size_t i = 0; i < wanted.size(); ++i)
                decode(fields_[field_of(wanted[i])], is_structured() ? 0 : wanted[i], width, std::span(out[i]).subspan(done, count));
        }
        return {};
    }
};

/// True if at least one field of the elements is numeric.
bool has_numbers(const NpyHeader& header) {
    return std::any_of(header.fields.begin(), header.fields.end(), [](const auto& f) { return f.is_numeric(); });
}

/// The error for an array that cannot be read as numbers. `name` is the name of the file and array.
Error no_numbers(const NpyHeader& header, const std::string& name) {
    const bool pickled = std::any_of(header.fields.begin(), header.fields.end(), [](const auto& f) { return f.kind == 'O'; });
    const bool complex = header.fields[0].kind == 'c';
    return bad_input(
        fmt::format("the array holds {} {}", header.type,
                    pickled   ? "(Python objects), which are not supported because loading them can run any code; save numbers instead"
                    : complex ? "(complex numbers); save the real part or the magnitude instead"
                              : "(not a supported number type); supported are floats up to 64 bits, integers and booleans"),
        {name});
}

/// One array as samples. `bytes` are those of the array, including its header; if `in_archive`, they are a member of an archive.
Result<std::unique_ptr<NpySamples>> samples_of(std::unique_ptr<SeekableBytes> bytes, NpyHeader header, const ArrayInfo& array,
                                               const ExtentHints& hints, bool in_archive = false) {
    const auto name = bytes->name();
    if (!has_numbers(header) || std::any_of(header.fields.begin(), header.fields.end(), [](const auto& f) { return f.kind == 'O'; }))
        return no_numbers(header, name);
    const auto extent = TRY(extent_of(array, name, hints));
    if (in_archive && has_contiguous_channels(header, extent)) {  // seeking in an archive is slow, and each channel needs it
        bytes = TRY(copy_to_temporary_file(*bytes));
    }
    if (!header.fields[0].name.empty() && extent.columns > 1)
        return bad_input(fmt::format("{}: a structured array must have one dimension, because its fields are the columns", describe(array)),
                         {name});
    auto samples = std::make_unique<NpySamples>(std::move(bytes), std::move(header), extent);
    samples->name_columns(array.name);
    return samples;
}

/// The arrays of an NPZ file and their headers. k is the index of an array.
struct Npz {
    NpzReader file;
    std::vector<ArrayInfo> arrays = {};
    std::vector<NpyHeader> headers = {};

    /// Reads the headers of all arrays. An array with an invalid header counts as not numeric, so that another array can still be read.
    void read_headers() {
        for (const auto& name : file.names()) {
            const auto bytes = file.bytes(name);
            auto header = bytes ? read_npy_header(**bytes) : bytes.error();
            arrays.push_back({name, header ? header->shape : std::vector<std::uint64_t>{}, header && has_numbers(*header)});
            headers.push_back(header ? *std::move(header) : NpyHeader{});
        }
    }

    /// Array k as samples.
    Result<std::unique_ptr<NpySamples>> samples(std::size_t k, const ExtentHints& hints) const {
        auto bytes = TRY(file.bytes(arrays[k].name));
        auto header = TRY(read_member_header(*bytes));  // unlike read_headers(), checks the size of the array
        return samples_of(std::move(bytes), std::move(header), arrays[k], hints, true);
    }

    /// Hints about the orientation of array `chosen`, from the lists of times among the other arrays.
    ExtentHints hints(std::size_t chosen, std::optional<bool> transpose) const {
        ExtentHints out{transpose};
        for (std::size_t k = 0; k < arrays.size(); ++k)
            if (const auto length = k == chosen ? std::nullopt : time_list_length(arrays[k])) out.time_lengths.push_back(*length);
        return out;
    }

    /// The sample rate in Hz, if one of the arrays is a single number with the name of a rate.
    std::optional<double> rate() const {
        for (std::size_t k = 0; k < arrays.size(); ++k)
            if (is_rate_name(arrays[k].name) && arrays[k].is_numeric && headers[k].element_count() == 1)
                if (const auto value = file.numbers(arrays[k].name)) return value->at(0);
        return {};
    }

    /// The index of a list of times with `rows` elements, other than array `chosen`; nullopt if there is none.
    std::optional<std::size_t> times(std::size_t chosen, std::int64_t rows) const {
        for (std::size_t k = 0; k < arrays.size(); ++k)
            if (k != chosen && time_list_length(arrays[k]) == static_cast<std::uint64_t>(rows) && headers[k].fields[0].name.empty())
                return k;
        return {};
    }
};

SamplesResult open_npy(const std::string& path, const TableOptions& options) {
    auto bytes = TRY(open_bytes(path));
    auto header = TRY(read_npy_header(*bytes));
    const ArrayInfo array{"", header.shape, has_numbers(header)};
    auto samples = TRY(samples_of(std::move(bytes), std::move(header), array, {options.transpose}));
    return std::unique_ptr<Samples>(std::move(samples));
}

SamplesResult open_npz(const std::string& path, const TableOptions& options) {
    Npz npz{TRY(NpzReader::open(path))};
    npz.read_headers();
    const auto chosen = TRY(choose_array(npz.arrays, options.dataset, path));
    auto samples = TRY(npz.samples(chosen, npz.hints(chosen, options.transpose)));
    samples->set_rate(npz.rate());
    const auto times = npz.times(chosen, samples->info().rows);
    if (!times) return std::unique_ptr<Samples>(std::move(samples));
    auto time_samples = TRY(npz.samples(*times, {}));
    return add_time_column(std::move(time_samples), std::move(samples));
}

}  // namespace

Result<std::unique_ptr<Table>> open_npy_table(const std::string& path, const TableOptions& options) {
    if (options.dataset) return bad_usage(fmt::format("--dataset {}: an NPY file has only one array", *options.dataset));
    return make_table(open_npy(path, options), path);
}

Result<std::unique_ptr<Table>> open_npz_table(const std::string& path, const TableOptions& options) {
    return make_table(open_npz(path, options), path);
}

}  // namespace corpuscle
