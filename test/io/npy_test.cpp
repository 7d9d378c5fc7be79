// NumPy arrays as recordings: every number type, both memory orders, both byte orders, structures; alone and in an archive.

#include <zip.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/table/archive.hpp"
#include "io/table/npz.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::npy_bytes, test::load_recording, test::load_error;

template <class T>
std::string bytes_of(T x, bool big_endian) {
    std::string s(reinterpret_cast<const char*>(&x), sizeof x);
    if (big_endian) std::reverse(s.begin(), s.end());
    return s;
}

/// A number type: its NumPy code, a range of integers that it represents exactly, and its encoder.
struct NumberType {
    const char* code;
    int low, high;
    std::string (*bytes)(int, bool);
};

template <class T>
std::string encode_number(int x, bool big_endian) {
    return bytes_of(static_cast<T>(x), big_endian);
}

const NumberType number_types[] = {{"f8", -1000000, 1000000, encode_number<double>},
                                   {"f4", -1000000, 1000000, encode_number<float>},
                                   {"i1", -128, 128, encode_number<std::int8_t>},
                                   {"i2", -32768, 32768, encode_number<std::int16_t>},
                                   {"i4", -1000000, 1000000, encode_number<std::int32_t>},
                                   {"i8", -1000000, 1000000, encode_number<std::int64_t>},
                                   {"u1", 0, 256, encode_number<std::uint8_t>},
                                   {"u2", 0, 65536, encode_number<std::uint16_t>},
                                   {"u4", 0, 1000000, encode_number<std::uint32_t>},
                                   {"u8", 0, 1000000, encode_number<std::uint64_t>},
                                   {"b1", 0, 2, encode_number<std::uint8_t>}};

TEST(Npy, EveryNumberTypeInBothMemoryAndByteOrdersIsReadAsItWasWritten) {
    EXPECT_TRUE(rc::check("round trip", [] {
        const auto& kind = *rc::gen::elementOf(std::vector<NumberType>(std::begin(number_types), std::end(number_types)));
        const auto rows = *rc::gen::inRange<std::size_t>(2, 300), columns = *rc::gen::inRange<std::size_t>(1, 5);
        const bool big_endian = *rc::gen::arbitrary<bool>(), by_columns = *rc::gen::arbitrary<bool>();
        const int version = *rc::gen::inRange(1, 4);
        std::vector<std::vector<double>> force(columns, std::vector<double>(rows));
        std::vector<std::string> cells(rows * columns);
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) {
                const int x = *rc::gen::inRange(kind.low, kind.high);
                force[c][r] = x;
                cells[by_columns ? c * rows + r : r * columns + c] = kind.bytes(x, big_endian);
            }
        std::string data;
        for (const auto& cell : cells) data += cell;
        const auto type = fmt::format("'{}{}'", big_endian ? '>' : '<', kind.code);
        const auto path = (std::filesystem::temp_directory_path() / fmt::format("corpuscle-npy-{}.npy", ::getpid())).string();
        std::ofstream(path, std::ios::binary) << npy_bytes(type, fmt::format("({}, {})", rows, columns), data, by_columns, version);
        const auto recording = test::try_load_recording(path, {.table = {{}, false}, .rate = 100});
        std::filesystem::remove(path);
        RC_ASSERT(static_cast<bool>(recording));
        RC_ASSERT(recording->force == force);
    }));
}

TEST(Npy, HalfPrecisionNumbersAreReadExactly) {
    const auto half = NpyField{"", 'f', 2, 0, false}.decoder();
    const auto value = [&](std::uint16_t bits) { return half(reinterpret_cast<const std::byte*>(&bits)); };
    EXPECT_EQ(value(0x3c00), 1);
    EXPECT_EQ(value(0xc000), -2);
    EXPECT_EQ(value(0x7bff), 65504);
    EXPECT_EQ(value(0x0400), std::ldexp(1, -14)) << "the smallest normal number";
    EXPECT_EQ(value(0x0001), std::ldexp(1, -24)) << "the smallest subnormal number";
    EXPECT_EQ(value(0x3555), 1365.0 / 4096) << "a third";
    EXPECT_TRUE(std::isinf(value(0xfc00)) && value(0xfc00) < 0);
    EXPECT_TRUE(std::isnan(value(0x7e00)));
}

TEST(Npy, NumericFieldsOfAStructureAreColumnsWithNameAndUnit) {
    const TemporaryFolder folder;
    std::string data;
    for (int k = 0; k < 5000; ++k) data += bytes_of(std::uint32_t(k), false) + "ab" + bytes_of(static_cast<float>(k) * 30, true);
    const auto path = folder.write("x.npy", npy_bytes("[('t_ms', '<u4'), ('note', '|S2'), ('fz_mN', '>f4')]", "(5000,)", data));
    const auto recording = load_recording(path);
    EXPECT_EQ(recording.names, std::vector<std::string>{"fz"});
    EXPECT_EQ(recording.clock.rate(), 1000);
    ASSERT_EQ(recording.force[0].size(), 5000U);
    EXPECT_EQ(recording.force[0][4321], 4321 * 30.0 * 1e-3);
}

/// A table whose first column is the row number, as pandas' to_records() or a logger's frame counter writes it.
std::string records(const std::string& index, std::size_t rows = 500) {
    std::string data;
    for (std::size_t k = 0; k < rows; ++k)
        data += bytes_of(static_cast<std::int64_t>(k), false) + bytes_of(std::sin(static_cast<double>(k)), false);
    return npy_bytes(fmt::format("[('{}', '<i8'), ('fz_N', '<f8')]", index), fmt::format("({},)", rows), data);
}

TEST(Npy, AColumnThatCountsTheRowsIsNotAForce) {
    const TemporaryFolder folder;
    for (const std::string index : {"index", "sample", "frame", "level_0"}) {  // the last is recognised only by its numbers
        const auto recording = load_recording(folder.write("x.npy", records(index)), {.rate = 100});
        EXPECT_EQ(recording.names, std::vector<std::string>{"fz"}) << index;
        EXPECT_EQ(recording.force[0][7], std::sin(7.0));
        ASSERT_FALSE(recording.notes.empty());
        EXPECT_EQ(recording.notes[0], fmt::format("'{}' was ignored: it counts the rows (use --channel 1 to include it)", index));
        EXPECT_EQ(load_recording(folder / "x.npy", {.channels = {index}, .rate = 100}).force[0][7], 7);
        const auto packed = make_archive({{"log.npy", records(index)}});
        EXPECT_EQ(load_recording(folder.write("x.npz", test::value_or_throw(packed)), {.rate = 100}).names, std::vector<std::string>{"fz"})
            << index;
    }
}

TEST(Npy, AColumnInSecondsIsTheTimeUnderAnyName) {
    const TemporaryFolder folder;
    std::string data;
    for (int k = 0; k < 500; ++k) data += bytes_of(0.01 * k, false) + bytes_of(2.0, false);
    const auto recording = load_recording(folder.write("x.npy", npy_bytes("[('Zeit_s', '<f8'), ('fz_N', '<f8')]", "(500,)", data)));
    EXPECT_EQ(recording.names, std::vector<std::string>{"fz"});
    EXPECT_NEAR(recording.clock.rate(), 100, 1e-6);
}

TEST(Npy, AnArrayOfOneRowIsOneChannel) {
    const TemporaryFolder folder;
    const auto recording = load_recording(folder.write("x.npy", npy_bytes("'|u1'", "(1, 3)", "\1\2\3")), {.rate = 10});
    EXPECT_EQ(recording.force, (std::vector<std::vector<double>>{{1, 2, 3}}));
}

TEST(Npy, UnreadableArraysGiveAnError) {
    const TemporaryFolder folder;
    const auto error_text = [&](const std::string& bytes, const RecordingOptions& options = {.rate = 10}) {
        return load_error(folder.write("x.npy", bytes), options);
    };
    const auto nan = bytes_of(std::nan(""), false), one = bytes_of(1.0, false);
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(2, 2)", one + one + one + nan)),
              "x.npy: row 2: column 'ch2': nan where a number is expected");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(2, 2)", one + one + one)),
              "x.npy: the array needs 32 bytes, but the file has 24; it may be incomplete");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(99999999999, 99999999999)", one)),
              "x.npy: the array needs more than 2^64 bytes, but the file has 8; it may be incomplete");
    EXPECT_EQ(error_text(npy_bytes("'<c16'", "(2,)", std::string(32, '\0'))),
              "x.npy: the array holds '<c16' (complex numbers); save the real part or the magnitude instead");
    EXPECT_EQ(error_text(npy_bytes("'|O'", "(2,)", "\x80\x04")),
              "x.npy: the array holds '|O' (Python objects), which are not supported because loading them can run any code; save numbers "
              "instead");
    EXPECT_EQ(error_text(npy_bytes("'<U3'", "(1,)", std::string(12, 'a'))),
              "x.npy: the array holds '<U3' (not a supported number type); supported are floats up to 64 bits, integers and booleans");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(0, 3)", "")), "x.npy: the array (0 x 3): it has no samples");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "()", one)),
              "x.npy: the array (scalar): a recording must have one dimension, or two (rows and channels)");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(1, 1, 1)", one)),
              "x.npy: the array (1 x 1 x 1): a recording must have one dimension, or two (rows and channels)");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(-1,)", one)), "x.npy: the shape in the header is not a list of non-negative integers");
    EXPECT_EQ(error_text(npy_bytes("'<q8'", "(1,)", one)), "x.npy: unknown NumPy type '<q8' in the header");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(1,", one)), "x.npy: the header does not contain descr, fortran_order and shape");
    EXPECT_EQ(error_text("\x93NUMPY\x04\x01 and so on"), "x.npy: NPY version 4 is not supported (only 1, 2, 3)");
    EXPECT_EQ(error_text("a,b\n1,2\n3,4\n"), "x.npy: not an NPY file");
    EXPECT_EQ(error_text(""), "x.npy: not an NPY file");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(1,)", one), {.table = {"a"}, .rate = 10}), "--dataset a: an NPY file has only one array");
    EXPECT_EQ(error_text(npy_bytes("'<f8'", "(1,)", one), {}),
              "x.npy: no time column found (columns: ch1); name one with --time, or give a rate, such as --rate 1kHz");
}

/// Writes a compressed archive, as numpy.savez_compressed does.
void write_deflated(const std::string& path, const std::vector<ArchiveEntry>& members) {
    int code = 0;
    zip_t* z = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    for (const auto& m : members) zip_file_add(z, m.name.c_str(), zip_source_buffer(z, m.bytes.data(), m.bytes.size(), 0), 0);
    ASSERT_EQ(zip_close(z), 0);
}

std::string ramp_of(std::size_t count, double step = 1) {
    std::string data;
    for (std::size_t k = 0; k < count; ++k) data += bytes_of(static_cast<double>(k) * step, false);
    return data;
}

TEST(Npz, TheArrayIsChosenByNameAndMayHaveARateOrTimesBesideIt) {
    const TemporaryFolder folder;
    const ArchiveEntry force{"force_mN.npy", npy_bytes("'<f8'", "(9000, 2)", ramp_of(18000))},
        transposed{"turned.npy", npy_bytes("'<f8'", "(9000, 2)", ramp_of(18000), true)},
        rate{"fs.npy", npy_bytes("'<i8'", "()", bytes_of(std::int64_t(250), false))},
        times{"t.npy", npy_bytes("'<f8'", "(9000,)", ramp_of(9000, 0.01))},
        text_array{"who.npy", npy_bytes("'<U1'", "(1,)", std::string(4, 'a'))};
    const auto path = folder / "x.npz";
    for (const bool deflated : {false, true}) {
        const auto write = [&](const std::vector<ArchiveEntry>& members) {
            deflated ? write_deflated(path, members) : void(folder.write("x.npz", test::value_or_throw(make_archive(members))));
        };
        write({force, rate, text_array});
        const auto recording = load_recording(path);
        EXPECT_EQ(recording.clock.rate(), 250);
        EXPECT_EQ(recording.names, (std::vector<std::string>{"ch1", "ch2"}));
        EXPECT_EQ(recording.force[1][8999], 17999 * 1e-3);
        write({times, force});
        EXPECT_EQ(load_recording(path).clock.rate(), 100);
        EXPECT_EQ(load_recording(path, {.channels = {"2"}}).force[0][8999], 17999 * 1e-3);
        write({force, rate, transposed});
        EXPECT_EQ(load_error(path),
                  "x.npz: several arrays could be the recording; select one with --dataset NAME: force_mN (9000 x 2), turned (9000 x 2)");
        EXPECT_EQ(load_recording(path, {.table = {"turned"}}).force[1][10], 9010);
        EXPECT_EQ(load_error(path, {.table = {"forces_mN"}}),
                  "x.npz: no array 'forces_mN'; did you mean 'force_mN'?; arrays: force_mN (9000 x 2), fs (scalar), turned (9000 x 2)");
        write({text_array});
        EXPECT_EQ(load_error(path),
                  "x.npz: no array can be the recording, which must be numeric with one or two dimensions; arrays: who (1, not numeric)");
    }
}

}  // namespace
}  // namespace corpuscle
