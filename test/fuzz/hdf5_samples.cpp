// Valid HDF5 files of any shape, type, storage and attributes. The library writes them, and this process reads them, so that the fuzzer
// reaches the reader's branches. fuzz-hdf5 tests damaged files through the helper process, because they may crash the library.

#include <fuzzer/FuzzedDataProvider.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "hdf5_file.hpp"
#include "helper_main.hpp"

namespace corpuscle::fuzz {
namespace {

using hdf5::Handle;

void require(bool holds) {
    if (!holds) std::abort();
}

constexpr const char* dataset_names[] = {"/force", "/a/force", "/a/b/data", "/t", "/a/time_s", "/fs", "/a/starting_time", "/frame"};
constexpr const char* numeric_attributes[] = {"rate", "Sampling_Rate", "conversion", "offset"};
constexpr const char* text_attributes[] = {"unit", "units", "MATLAB_class", "columns", "channels", "names"};
constexpr const char* text_values[] = {"N", "mN", "fz_N", "frame", "t_s", "", "x y", "double", "\xff"};

hid_t number_type(unsigned k) {
    const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_STD_I8LE,
                           H5T_STD_U8LE,   H5T_STD_I16BE,  H5T_STD_I64LE,  H5T_STD_U32LE};
    return types[k % std::size(types)];
}

/// Value number k; it is exact in every type.
double value_at(std::size_t k) { return static_cast<double>(k * 37 % 101); }

/// Writes an HDF5 file in memory, with contents chosen by the fuzzer's input.
class FileMaker {
    FuzzedDataProvider& input_;
    Handle file_;

    static Handle scalar() { return {H5Screate(H5S_SCALAR), H5Sclose}; }

    void add_number(hid_t object) {
        const auto* const name = input_.PickValueInArray(numeric_attributes);
        const double value = input_.PickValueInArray({1.0, 2.0, 1000.0, -1.0, 0.5, 0.0});
        if (H5Aexists(object, name) > 0) return;
        const Handle space = scalar(), attribute(H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
    }

    void add_words(hid_t object) {
        const auto* const name = input_.PickValueInArray(text_attributes);
        std::vector<std::string> words(input_.ConsumeIntegralInRange<std::size_t>(1, 4));
        for (auto& w : words) w = input_.PickValueInArray(text_values);
        if (H5Aexists(object, name) > 0) return;
        const hsize_t count = words.size();
        const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose),
            type(H5Tcopy(H5T_C_S1), H5Tclose);
        const bool any_length = input_.ConsumeBool();
        H5Tset_size(type, any_length ? H5T_VARIABLE : 8);
        const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        std::vector<const char*> texts;
        std::string fixed;
        for (const auto& w : words) texts.push_back(w.c_str()), fixed += w, fixed.resize(8 * texts.size());
        H5Awrite(attribute, type, any_length ? static_cast<const void*>(texts.data()) : fixed.data());
    }

    /// Creation properties chosen by the input: contiguous, compact, chunked or compressed storage.
    Handle storage(const std::vector<hsize_t>& shape) {
        Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        const auto kind = input_.ConsumeIntegralInRange(0, 3);
        if (shape.empty() || kind == 0) return properties;
        if (kind == 1) return H5Pset_layout(properties, H5D_COMPACT), std::move(properties);
        std::vector<hsize_t> chunk;
        for (const auto n : shape) chunk.push_back(input_.ConsumeIntegralInRange<hsize_t>(1, std::max<hsize_t>(1, n)));
        H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
        if (kind == 3) H5Pset_shuffle(properties), H5Pset_deflate(properties, 1), H5Pset_fletcher32(properties);
        return properties;
    }

    void write(hid_t dataset, hid_t memory, const std::vector<hsize_t>& shape, std::size_t numbers_per_element) {
        std::size_t count = numbers_per_element;
        for (const auto n : shape) count *= n;
        std::vector<double> values(count);
        for (std::size_t k = 0; k < count; ++k) values[k] = value_at(k);
        const auto extent_kind = input_.ConsumeIntegralInRange(0, 2);  // all rows, half of the rows, or nothing
        if (count == 0 || extent_kind == 2) return;
        const Handle space(H5Dget_space(dataset), H5Sclose);
        Handle some(H5Scopy(space), H5Sclose);
        if (extent_kind == 1 && !shape.empty()) {
            std::vector<hsize_t> start(shape.size(), 0), extent = shape;
            extent[0] = (extent[0] + 1) / 2;
            H5Sselect_hyperslab(some, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
        }
        H5Dwrite(dataset, memory, some, some, H5P_DEFAULT, values.data());
    }

public:
    explicit FileMaker(FuzzedDataProvider& input) : input_(input) {
        const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        H5Pset_fapl_core(access, std::size_t{1} << 16, false);
        if (input_.ConsumeBool()) H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
        file_ = Handle(H5Fcreate("made", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
        require(static_cast<bool>(file_));
    }

    void add_dataset() {
        const std::string name = input_.PickValueInArray(dataset_names);
        std::vector<hsize_t> shape(input_.ConsumeIntegralInRange<std::size_t>(0, 3));
        for (auto& n : shape) n = input_.ConsumeIntegralInRange<hsize_t>(0, 20);
        const bool is_compound = input_.ConsumeIntegralInRange(0, 3) == 0;
        const auto kind = input_.ConsumeIntegral<unsigned>();
        Handle type(is_compound ? H5Tcreate(H5T_COMPOUND, 24) : H5Tcopy(number_type(kind)), H5Tclose), memory(H5Tcopy(type), H5Tclose);
        if (is_compound) {
            for (std::size_t k = 0; k < 3; ++k)
                H5Tinsert(type, std::array{"t_s", "frame", "fz_N"}[(k + kind) % 3], 8 * k, k < 2 ? H5T_NATIVE_DOUBLE : H5T_STD_I64LE);
            memory = Handle(H5Tcopy(type), H5Tclose);
        } else {
            memory = Handle(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose);
        }
        const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
        H5Pset_create_intermediate_group(links, 1);
        const Handle space(shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                           H5Sclose);
        const Handle properties = storage(shape),
                     dataset(H5Dcreate2(file_, name.c_str(), type, space, links, properties, H5P_DEFAULT), H5Dclose);
        if (!dataset) return;  // the name exists, or the layout does not allow the shape
        write(dataset, memory, shape, is_compound ? 3 : 1);
        for (auto n = input_.ConsumeIntegralInRange(0, 2); n > 0; --n) add_number(dataset);
        for (auto n = input_.ConsumeIntegralInRange(0, 2); n > 0; --n) add_words(dataset);
    }

    /// Returns a descriptor of the file in memory.
    int finish() {
        H5Fflush(file_, H5F_SCOPE_GLOBAL);
        const auto size = H5Fget_file_image(file_, nullptr, 0);
        require(size > 0);
        std::vector<char> image(static_cast<std::size_t>(size));
        require(H5Fget_file_image(file_, image.data(), image.size()) == size);
        const int file = ::memfd_create("made", MFD_CLOEXEC);
        require(file >= 0 && ::write(file, image.data(), image.size()) == size);
        return file;
    }
};

/// Reads of any rows and columns must equal the same rows and columns of a complete read.
void check_samples(Samples& samples, FuzzedDataProvider& input) {
    const auto& table = samples.info();
    require(table.rows > 0 && !table.columns.empty() && (!table.time_column || *table.time_column < table.columns.size()));
    const auto rows = static_cast<std::size_t>(table.rows), columns = table.columns.size();
    require(rows <= 8000 && columns <= 400);
    const auto fetched = [&](std::size_t from, std::size_t count, const std::vector<std::size_t>& selected) {
        std::optional<std::vector<std::vector<double>>> out(std::in_place, selected.size(), std::vector<double>(count));
        const auto done = samples.fetch(static_cast<std::int64_t>(from), count, selected, *out);
        if (!done) require(!done.error().message.empty()), out.reset();
        return out;
    };
    std::vector<std::size_t> all(columns);
    for (std::size_t c = 0; c < columns; ++c) all[c] = c;
    const auto complete = fetched(0, rows, all);
    for (int k = 0; k < 4; ++k) {
        std::vector<std::size_t> selected;
        for (std::size_t c = 0; c < columns; ++c)
            if (input.ConsumeBool()) selected.push_back(c);
        const auto from = input.ConsumeIntegralInRange<std::size_t>(0, rows - 1),
                   count = input.ConsumeIntegralInRange<std::size_t>(0, rows - from);
        const auto some = fetched(from, count, selected);
        if (!complete || selected.empty()) continue;
        require(some.has_value());
        for (std::size_t i = 0; i < selected.size(); ++i)
            for (std::size_t n = 0; n < count; ++n) {
                const double a = (*some)[i][n], b = (*complete)[selected[i]][from + n];
                require(a == b || (std::isnan(a) && std::isnan(b)));
            }
    }
}

}  // namespace
}  // namespace corpuscle::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace corpuscle;
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    FuzzedDataProvider input(data, size);
    int file = -1;
    {
        fuzz::FileMaker maker(input);
        for (auto n = input.ConsumeIntegralInRange(1, 4); n > 0; --n) maker.add_dataset();
        file = maker.finish();
    }
    TableOptions options;
    if (input.ConsumeBool()) options.transpose = input.ConsumeBool();
    if (input.ConsumeBool()) options.dataset = input.PickValueInArray({"force", "a", "data", "/t", "none"});
    auto samples = open_hdf5_samples(file, "made.h5", options);
    if (samples)
        fuzz::check_samples(**samples, input);
    else
        fuzz::require(!samples.error().message.empty());
    samples = bad_input("closed");
    ::close(file);
    return 0;
}
