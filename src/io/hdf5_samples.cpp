#include "io/hdf5_samples.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "io/hdf5_file.hpp"
#include "io/text_table.hpp"

namespace corpuscle {
namespace {

using hdf5::Id;

constexpr std::size_t most_numbers = std::size_t{1} << 20;  // read at once, if it is more than one row

std::string parent_of(const std::string& name) { return name.substr(0, std::max<std::size_t>(1, name.rfind('/'))); }

class Hdf5Samples final : public Samples {
    std::string path_, name_;
    Id dataset_;
    Extent extent_;
    std::size_t rank_ = 1;
    std::vector<std::string> members_;  // of a compound type: the columns
    double factor_ = 1, offset_ = 0;    // of NWB
    SamplesFacts facts_;
    std::vector<double> buffer_;

    Error unreadable() const {
        return bad_input(fmt::format("{} cannot be read: damaged, or packed by a filter that is not here?", name_), {path_});
    }

    /// Rows and columns of the file into the buffer, as they lie there.
    Result<void> load(std::uint64_t first, std::uint64_t rows, std::uint64_t column, std::uint64_t columns, hid_t type) {
        std::array<hsize_t, 2> start{first, column}, count{rows, columns};
        if (extent_.lying) std::swap(start[0], start[1]), std::swap(count[0], count[1]);
        const Id space(H5Dget_space(dataset_), H5Sclose),
            memory(H5Screate_simple(static_cast<int>(rank_), count.data(), nullptr), H5Sclose);
        if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
            H5Dread(dataset_, type, memory, space, H5P_DEFAULT, buffer_.data()) < 0)
            return unreadable();
        return {};
    }

    /// The columns from the first to the last that are wanted.
    Result<void> fetch_plain(std::uint64_t first, std::size_t at, std::size_t rows, std::span<const std::size_t> wanted,
                             std::vector<std::vector<double>>& out) {
        const auto [low, high] = std::minmax_element(wanted.begin(), wanted.end());
        const auto width = *high - *low + 1;
        buffer_.resize(rows * width);
        if (auto ok = load(first, rows, *low, width, H5T_NATIVE_DOUBLE); !ok) return ok;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const auto c = wanted[i] - *low, step = extent_.lying ? 1 : width, from = extent_.lying ? c * rows : c;
            for (std::size_t k = 0; k < rows; ++k) out[i][at + k] = buffer_[from + k * step] * factor_ + offset_;
        }
        return {};
    }

    Result<void> fetch_members(std::uint64_t first, std::size_t at, std::size_t rows, std::span<const std::size_t> wanted,
                               std::vector<std::vector<double>>& out) {
        const auto width = wanted.size();
        const Id type(H5Tcreate(H5T_COMPOUND, width * sizeof(double)), H5Tclose);
        for (std::size_t i = 0; i < width; ++i) H5Tinsert(type, members_[wanted[i]].c_str(), i * sizeof(double), H5T_NATIVE_DOUBLE);
        buffer_.resize(rows * width);
        if (auto ok = load(first, rows, 0, 1, type); !ok) return ok;
        for (std::size_t i = 0; i < width; ++i)
            for (std::size_t k = 0; k < rows; ++k) out[i][at + k] = buffer_[k * width + i];
        return {};
    }

    /// MATLAB's matrices lie column after column: HDF5's first dimension is their second.
    Result<void> take_shape(const ArrayFacts& facts) {
        const auto extent = extent_of(facts, path_);
        if (!extent) return extent.error();
        extent_ = *extent;
        rank_ = facts.shape.size();
        if (!extent_.lying && extent_.columns > 1 && hdf5::text_at(dataset_, "MATLAB_class"))
            extent_ = {extent_.columns, extent_.rows, true};
        facts_.rows = static_cast<std::int64_t>(extent_.rows);
        return {};
    }

    Result<void> name_columns() {
        const Id type(H5Dget_type(dataset_), H5Tclose);
        for (const auto& m : hdf5::numeric_members(type)) members_.push_back(m.name), facts_.columns.push_back(parse_heading(m.name));
        if (!members_.empty() && extent_.columns > 1)
            return bad_input(fmt::format("{}: members of numbers in one dimension only", name_), {path_});
        if (!members_.empty()) return {};
        const auto name = last_name(name_);
        facts_.columns =
            columns_named_after(name == "data" ? last_name(parent_of(name_)) : name, static_cast<std::size_t>(extent_.columns));
        for (const auto* attribute : {"columns", "channels", "names"})
            if (const auto words = hdf5::words_at(dataset_, attribute); words.size() == facts_.columns.size())
                for (std::size_t c = 0; c < words.size(); ++c) {
                    auto heading = parse_heading(words[c]);
                    if (heading.unit.empty()) heading.unit = facts_.columns[c].unit;
                    facts_.columns[c] = std::move(heading);
                }
        return {};
    }

    void take_unit() {
        for (const auto* attribute : {"unit", "units"})
            if (const auto unit = hdf5::text_at(dataset_, attribute))
                for (auto& column : facts_.columns)
                    if (members_.empty() || (column.unit.empty() && !names_time(column.name))) column.unit = *unit;
        if (!members_.empty()) return;
        factor_ = hdf5::number_at(dataset_, "conversion").value_or(1);
        offset_ = hdf5::number_at(dataset_, "offset").value_or(0);
    }

public:
    Hdf5Samples(std::string path, std::string name, Id dataset)
        : path_(std::move(path)), name_(std::move(name)), dataset_(std::move(dataset)) {}

    Result<void> open(const ArrayFacts& facts) {
        if (auto ok = take_shape(facts); !ok) return ok;
        if (auto ok = name_columns(); !ok) return ok;
        take_unit();
        return {};
    }

    void set_rate(std::optional<double> rate) { facts_.rate = rate; }
    const SamplesFacts& facts() const override { return facts_; }

    Result<void> fetch(std::int64_t start, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        const auto width = members_.empty() ? static_cast<std::size_t>(extent_.columns) : wanted.size();
        const auto most = std::max<std::size_t>(1, most_numbers / width);
        for (std::size_t done = 0; done < rows; done += most) {
            const auto first = static_cast<std::uint64_t>(start) + done;
            const auto count = std::min(most, rows - done);
            auto ok = members_.empty() ? fetch_plain(first, done, count, wanted, out) : fetch_members(first, done, count, wanted, out);
            if (!ok) return ok;
        }
        return {};
    }
};

/// The rate that an object's attributes say.
std::optional<double> rate_at(hid_t object) {
    for (const auto& name : hdf5::attributes_of(object))
        if (names_rate(name))
            if (const auto rate = hdf5::number_at(object, name)) return rate;
    return {};
}

/// The rate of a dataset: in its attributes or those of the groups above it, in NWB's starting_time, or a number beside it.
std::optional<double> rate_of(hid_t file, const std::string& name, std::span<const ArrayFacts> arrays) {
    if (const auto dataset = hdf5::open_dataset(file, name))
        if (const auto rate = rate_at(dataset)) return rate;
    for (const auto& a : arrays) {
        if (parent_of(a.name) != parent_of(name)) continue;
        const auto dataset = hdf5::open_dataset(file, a.name);
        if (const auto rate = last_name(a.name) == "starting_time" ? rate_at(dataset) : std::nullopt) return rate;
        if (const auto rate = names_rate(last_name(a.name)) ? hdf5::single_number(dataset) : std::nullopt) return rate;
    }
    for (auto group = parent_of(name);; group = parent_of(group)) {
        if (const Id object(H5Oopen(file, group.c_str(), H5P_DEFAULT), H5Oclose); object)
            if (const auto rate = rate_at(object)) return rate;
        if (group == "/") return {};
    }
}

Result<std::unique_ptr<Hdf5Samples>> samples_of(hid_t file, const std::string& path, const ArrayFacts& facts) {
    auto dataset = hdf5::open_dataset(file, facts.name);
    if (!dataset) return bad_input(fmt::format("{} cannot be opened: damaged?", facts.name), {path});
    auto samples = std::make_unique<Hdf5Samples>(path, facts.name, std::move(dataset));
    if (auto ok = samples->open(facts); !ok) return ok.error();
    return samples;
}

/// The list of times beside a dataset, with as many rows.
const ArrayFacts* times_of(const ArrayFacts& chosen, std::int64_t rows, std::span<const ArrayFacts> arrays) {
    for (const auto& a : arrays)
        if (a.name != chosen.name && parent_of(a.name) == parent_of(chosen.name) && a.numeric && a.shape.size() <= 2 &&
            names_time(parse_heading(last_name(a.name)).name))
            if (const auto extent = extent_of(a, ""); extent && extent->columns == 1 && static_cast<std::int64_t>(extent->rows) == rows)
                return &a;
    return nullptr;
}

/// The whole name of what the user asks for: without the first slash, or the group that holds `data`.
std::optional<std::string> whole_name(std::optional<std::string> wanted, std::span<const ArrayFacts> arrays) {
    if (!wanted) return wanted;
    const auto is_there = [&](const std::string& name) {
        return std::any_of(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == name; });
    };
    if (!wanted->starts_with('/')) wanted = "/" + *wanted;
    return !is_there(*wanted) && is_there(*wanted + "/data") ? *wanted + "/data" : wanted;
}

}  // namespace

SamplesResult open_hdf5_samples(const std::string& path, const std::optional<std::string>& wanted) {
    const auto file = hdf5::open_file(path);
    if (!file) return file.error();
    const auto arrays = hdf5::datasets_in(*file);
    const auto chosen = choose_array(arrays, whole_name(wanted, arrays), path);
    if (!chosen) return chosen.error();
    const auto& facts = arrays[*chosen];
    auto samples = samples_of(*file, path, facts);
    if (!samples) return samples.error();
    (*samples)->set_rate(rate_of(*file, facts.name, arrays));
    const auto* times = times_of(facts, (*samples)->facts().rows, arrays);
    if (!times) return std::unique_ptr<Samples>(*std::move(samples));
    auto clock = samples_of(*file, path, *times);
    if (!clock) return clock.error();
    return with_times(*std::move(clock), *std::move(samples));
}

}  // namespace corpuscle
