// HDF5 files as recordings: plain, compressed and compound datasets, NWB and MATLAB. A damaged file gives an error or is read, but never
// crashes the program.

#include <sys/wait.h>

#include <complex>

#include "io/recording/recording_formats.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::Hdf5File, test::load_recording, test::load_error;

std::vector<double> ramp(std::size_t count, double step = 1) {
    std::vector<double> out(count);
    for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<double>(k) * step;
    return out;
}

TEST(Hdf5, EveryShapeAndTypeIsReadAsItWasWritten) {
    const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_STD_I16LE, H5T_STD_I32BE, H5T_STD_I64LE, H5T_STD_U16BE};
    EXPECT_TRUE(rc::check("round trip", [&] {
        const auto type = *rc::gen::elementOf(std::vector(std::begin(types), std::end(types)));
        const auto rows = *rc::gen::inRange<std::size_t>(2, 300), columns = *rc::gen::inRange<std::size_t>(1, 5);
        const bool packed = *rc::gen::arbitrary<bool>();
        const auto values = *rc::gen::container<std::vector<double>>(
            rows * columns, rc::gen::map(rc::gen::inRange(0, 30000), [](int x) { return double(x); }));
        const auto path = (std::filesystem::temp_directory_path() / fmt::format("corpuscle-{}.h5", ::getpid())).string();
        Hdf5File(path).write_numbers("/force", {rows, columns}, values, type,
                                     packed ? std::vector<hsize_t>{rows / 2, columns} : std::vector<hsize_t>{});
        const auto recording = test::try_load_recording(path, {.table = {{}, false}, .rate = 100});
        std::filesystem::remove(path);
        RC_ASSERT(static_cast<bool>(recording));
        RC_ASSERT(recording->force.size() == columns);
        for (std::size_t c = 0; c < columns; ++c) {
            RC_ASSERT(recording->force[c].size() == rows);
            for (std::size_t r = 0; r < rows; ++r) RC_ASSERT(recording->force[c][r] == values[r * columns + c]);
        }
    }));
}

TEST(Hdf5, UnitsNamesAndRateAreAttributes) {
    const TemporaryFolder folder;
    {
        Hdf5File file(folder / "x.h5");
        file.write_numbers("/trial/force", {5000, 2}, ramp(10000));
        file.write_attribute("/trial/force", "units", "mN");
        file.write_string_array_attribute("/trial/force", "columns", {"fx", "fz"});
        file.write_attribute("/", "Sampling_Rate", 250.0);
    }
    const auto recording = load_recording(folder / "x.h5");
    EXPECT_EQ(recording.names, (std::vector<std::string>{"fx", "fz"}));
    EXPECT_EQ(recording.clock.rate(), 250);
    EXPECT_EQ(recording.force[1][4999], 9999 * 1e-3);
    EXPECT_TRUE(recording.notes.empty());
}

TEST(Hdf5, ATimeSeriesOfNwbIsReadInItsUnit) {
    const TemporaryFolder folder;
    {
        Hdf5File file(folder / "x.nwb");
        file.write_numbers("/acquisition/grip/data", {4}, {0, 1, 2, 3}, H5T_STD_I16LE);
        file.write_attribute("/acquisition/grip/data", "unit", "N");
        file.write_attribute("/acquisition/grip/data", "conversion", 0.25);
        file.write_attribute("/acquisition/grip/data", "offset", 1.0);
        file.write_numbers("/acquisition/grip/starting_time", {}, {12.0});
        file.write_attribute("/acquisition/grip/starting_time", "rate", 500.0);
        file.write_attribute("/acquisition/grip/starting_time", "unit", "seconds");
        file.write_numbers("/acquisition/skin/data", {4}, {0, 1, 2, 3});
        file.write_attribute("/acquisition/skin/data", "unit", "volts");
        file.write_numbers("/acquisition/skin/timestamps", {4}, {5, 5.01, 5.02, 5.03});
        file.write_attribute("/acquisition/skin/timestamps", "unit", "seconds");
    }
    EXPECT_EQ(load_error(folder / "x.nwb"),
              "x.nwb: several arrays could be the recording; select one with --dataset NAME: /acquisition/grip/data (4), "
              "/acquisition/skin/data (4)");
    const auto grip = load_recording(folder / "x.nwb", {.table = {"/acquisition/grip"}});
    EXPECT_EQ(grip.names, std::vector<std::string>{"grip"});
    EXPECT_EQ(grip.force[0], (std::vector<double>{1, 1.25, 1.5, 1.75}));
    EXPECT_EQ(grip.clock.rate(), 500);
    EXPECT_EQ(grip.clock.t0, 12);
    const auto skin = load_recording(folder / "x.nwb", {.table = {"acquisition/skin/data"}, .scale = 2});
    EXPECT_EQ(skin.force[0], (std::vector<double>{0, 2, 4, 6}));
    EXPECT_EQ(skin.clock.rate(), 100);
    EXPECT_EQ(skin.clock.t0, 5);
}

TEST(Hdf5, MembersOfACompoundAreColumns) {
    const TemporaryFolder folder;
    struct Row {
        double time;
        char note[4];
        float fz;
    };
    std::vector<Row> rows;
    for (int k = 0; k < 5000; ++k) rows.push_back({k * 0.001, "abc", static_cast<float>(k) * 0.5F});
    const hid_t text = H5Tcopy(H5T_C_S1), type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
    H5Tset_size(text, 4);
    H5Tinsert(type, "time", HOFFSET(Row, time), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "note", HOFFSET(Row, note), text);
    H5Tinsert(type, "fz_N", HOFFSET(Row, fz), H5T_NATIVE_FLOAT);
    Hdf5File(folder / "x.h5").write_raw("/log", type, type, {rows.size()}, rows.data());
    H5Tclose(text), H5Tclose(type);
    const auto recording = load_recording(folder / "x.h5");
    EXPECT_EQ(recording.names, std::vector<std::string>{"fz"});
    EXPECT_EQ(recording.clock.rate(), 1000);
    EXPECT_EQ(recording.force[0][4999], 2499.5);
}

TEST(Hdf5, MembersOfACompoundInASingleRowAreColumns) {
    const TemporaryFolder folder;
    struct Row {
        double fx, fz;
    };
    std::vector<Row> rows;
    for (int k = 0; k < 50; ++k) rows.push_back({k * 1.0, 100.0 + k});
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
    H5Tinsert(type, "fx_N", HOFFSET(Row, fx), H5T_NATIVE_DOUBLE), H5Tinsert(type, "fz_N", HOFFSET(Row, fz), H5T_NATIVE_DOUBLE);
    Hdf5File(folder / "x.h5").write_raw("/log", type, type, {1, rows.size()}, rows.data());
    H5Tclose(type);
    const auto recording = load_recording(folder / "x.h5", {.rate = 100});
    ASSERT_EQ(recording.force.size(), 2U);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_EQ(recording.force[0][k], rows[k].fx) << k;
        EXPECT_EQ(recording.force[1][k], rows[k].fz) << k;
    }
}

TEST(Hdf5, AColumnThatCountsTheRowsIsNotAForce) {
    const TemporaryFolder folder;
    std::vector<double> rows;
    for (int k = 0; k < 500; ++k) rows.insert(rows.end(), {static_cast<double>(k), std::sin(k), 2.0});
    {
        Hdf5File file(folder / "x.h5");
        file.write_numbers("/force", {500, 3}, rows);
        file.write_string_array_attribute("/force", "columns", {"frame", "fx_N", "fz_N"});
    }
    const auto recording = load_recording(folder / "x.h5", {.rate = 100});
    EXPECT_EQ(recording.names, (std::vector<std::string>{"fx", "fz"}));
    EXPECT_EQ(recording.force[0][7], std::sin(7));
    ASSERT_FALSE(recording.notes.empty());
    EXPECT_EQ(recording.notes[0], "'frame' was ignored: it counts the rows (use --channel 1 to include it)");
}

TEST(Hdf5, MatlabsMatricesAreTransposed) {
    const TemporaryFolder folder;
    {
        Hdf5File file(folder / "x.mat");
        file.write_numbers("/force", {2, 3}, {1, 2, 3, 4, 5, 6});  // 3 rows, 2 columns in MATLAB
        file.write_attribute("/force", "MATLAB_class", "double");
        file.write_numbers("/fs", {1, 1}, {10});
        file.write_attribute("/fs", "MATLAB_class", "double");
        file.write_numbers("/t", {1, 3}, {0, 0.5, 1});
    }
    const auto recording = load_recording(folder / "x.mat");
    EXPECT_EQ(recording.force, (std::vector<std::vector<double>>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(recording.clock.rate(), 2) << "times take precedence over a rate";
    EXPECT_EQ(load_recording(folder / "x.mat", {.channels = {"2"}, .time = "none"}).clock.rate(), 10);
}

TEST(Hdf5, UnreadableFilesGiveAnError) {
    const TemporaryFolder folder;
    const auto error_text = [&](const auto& fill, const RecordingOptions& options = {.rate = 10}) {
        {
            Hdf5File file(folder / "x.h5");
            fill(file);
        }
        return load_error(folder / "x.h5", options);
    };
    EXPECT_EQ(load_error(folder.write("y.mat", "MATLAB")), "y.mat: not an HDF5 file (in MATLAB use save -v7.3)");
    EXPECT_EQ(error_text([](auto&) {}), "x.h5: there is no array in this file");
    EXPECT_EQ(error_text([](auto& f) { f.write_numbers("/a", {2, 2, 2}, ramp(8)); }),
              "x.h5: no array can be the recording, which must be numeric with one or two dimensions; arrays: /a (2 x 2 x 2)");
    EXPECT_EQ(error_text([](auto& f) { f.write_numbers("/a", {2, 2, 2}, ramp(8)); }, {.table = {"a"}, .rate = 10}),
              "x.h5: /a (2 x 2 x 2): a recording must be numeric with one dimension, or two (rows and channels)");
    EXPECT_EQ(error_text([](auto& f) { f.write_numbers("/force", {2}, ramp(2)); }, {.table = {"/farce"}, .rate = 10}),
              "x.h5: no array '/farce'; did you mean '/force'?; arrays: /force (2)");
    EXPECT_EQ(error_text([](auto& f) { f.write_numbers("/a", {0, 3}, {}); }), "x.h5: /a (0 x 3): it has no samples");
    EXPECT_EQ(error_text([](auto& f) { f.write_numbers("/a", {2, 2}, {0, 1, 2, INFINITY}); }),
              "x.h5: row 2: column 'ch2': inf where a number is expected");
    const auto complete = test::read_file(folder / "x.h5");
    EXPECT_EQ(load_error(folder.write("cut.h5", complete.substr(0, complete.size() - 100)), {.rate = 10}),
              "cut.h5: cannot open this HDF5 file; it may be damaged or truncated");
    const std::complex<double> z[2] = {};
    const hid_t complex = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(complex, "r", 0, H5T_NATIVE_DOUBLE), H5Tinsert(complex, "i", 8, H5T_NATIVE_DOUBLE);
    EXPECT_EQ(error_text([&](auto& f) { f.write_raw("/z", complex, complex, {2}, z); }),
              "x.h5: no array can be the recording, which must be numeric with one or two dimensions; arrays: /z (2, not numeric)");
    H5Tclose(complex);
}

/// Creates a file and returns its path. `fill` receives the file and a property list for the creation of a dataset.
template <class Fill>
std::string write_file_with(const TemporaryFolder& folder, const std::string& name, const Fill& fill) {
    const auto path = folder / name;
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), properties = H5Pcreate(H5P_DATASET_CREATE);
    fill(file, properties);
    H5Pclose(properties), H5Fclose(file);
    return path;
}

void make_dataset(hid_t file, hid_t properties, const std::vector<hsize_t>& shape, const std::vector<double>* values = nullptr,
                  const char* name = "force") {
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t d = H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    if (values) {
        const hsize_t count = values->size();
        const hid_t memory = H5Screate_simple(1, &count, nullptr);
        const hsize_t first = 0;
        H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr);
        H5Dwrite(d, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values->data());
        H5Sclose(memory);
    }
    H5Dclose(d), H5Sclose(space);
}

TEST(Hdf5, DataInOtherFilesAreNotRead) {
    const TemporaryFolder folder;
    const auto secret = folder.write("secret", std::string(800, 'x'));
    const auto external = write_file_with(folder, "x.h5", [&](hid_t file, hid_t properties) {
        H5Pset_external(properties, secret.c_str(), 0, 800);
        make_dataset(file, properties, {100});
    });
    EXPECT_NE(load_error(external, {.rate = 10})
                  .find("x.h5: /force (100): its data are in '" + secret + "', and other files are not read. Copy the data"),
              std::string::npos);
    Hdf5File(folder / "source.h5").write_numbers("/data", {100}, ramp(100));
    for (const auto* source : {"source.h5", "not-copied-along.h5"}) {
        const auto assembled = write_file_with(folder, "v.h5", [&](hid_t file, hid_t properties) {
            const hsize_t count = 100;
            const hid_t all = H5Screate_simple(1, &count, nullptr);
            H5Pset_virtual(properties, all, source, "/data", all);
            make_dataset(file, properties, {100});
            H5Sclose(all);
        });
        EXPECT_NE(
            load_error(assembled, {.rate = 10}).find(fmt::format("v.h5: /force (100): its data are in '{}', and other files", source)),
            std::string::npos);
    }
    const auto linked = write_file_with(folder, "l.h5", [&](hid_t file, hid_t properties) {
        make_dataset(file, properties, {100}, nullptr, "own");
        H5Lcreate_external("source.h5", "/data", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    });
    EXPECT_EQ(load_error(linked, {.table = {"elsewhere"}, .rate = 10}),
              "l.h5: 'elsewhere' is a link to another file, which is not followed; open that file instead");
}

TEST(Hdf5, DataThatWereNeverWrittenAreNotAForce) {
    const TemporaryFolder folder;
    const auto chunked = [](hid_t properties, hsize_t rows) { H5Pset_chunk(properties, 1, &rows); };
    EXPECT_EQ(
        load_error(write_file_with(folder, "x.h5", [&](hid_t f, hid_t properties) { make_dataset(f, properties, {1000}); }), {.rate = 10}),
        "x.h5: /force (1000): no data were written into it");
    for (const hsize_t rows : {hsize_t{1000}, hsize_t{1'000'000'000'000'000}})
        EXPECT_EQ(
            load_error(write_file_with(folder, "x.h5",
                                       [&](hid_t f, hid_t properties) { chunked(properties, 100), make_dataset(f, properties, {rows}); }),
                       {.rate = 10}),
            fmt::format("x.h5: /force ({}): no data were written into it", rows));
    const auto partial = ramp(150);
    EXPECT_EQ(load_error(write_file_with(folder, "x.h5",
                                         [&](hid_t f, hid_t properties) {
                                             chunked(properties, 100), make_dataset(f, properties, {1'000'000'000'000'000}, &partial);
                                         }),
                         {.rate = 10})
                  .substr(0, 82),
              "x.h5: /force (1000000000000000): only 2 of its 10000000000000 chunks were written.");
    const auto first_part = ramp(600);
    const auto path = write_file_with(
        folder, "x.h5", [&](hid_t f, hid_t properties) { chunked(properties, 100), make_dataset(f, properties, {1000}, &first_part); });
    EXPECT_EQ(load_error(path, {.rate = 10}).substr(0, 18), "x.h5: row 601: col");
    const auto kept = load_recording(path, {.rate = 10, .bad_fields = BadFields::drop});
    EXPECT_EQ(kept.force[0], ramp(600));
    EXPECT_EQ(kept.notes.at(0), "/force: 4 of its 10 chunks were never written; their readings are treated as bad");
    const auto filled = write_file_with(folder, "y.h5", [&](hid_t f, hid_t properties) {
        const double nothing = 0.5;
        H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &nothing);
        chunked(properties, 100), make_dataset(f, properties, {1000}, &first_part);
    });
    const auto read = load_recording(filled, {.rate = 10});
    EXPECT_EQ(read.force[0][999], 0.5) << "the fill value of the file";
    EXPECT_EQ(read.notes.at(0), "/force: 4 of its 10 chunks were never written; their readings are the fill value of the file");
}

TEST(Hdf5, ChunksOfAnyShapeGiveTheSameRows) {
    const TemporaryFolder folder;
    const std::vector<double> values = ramp(4000 * 6);
    for (const std::vector<hsize_t>& chunk : {std::vector<hsize_t>{}, {4000, 6}, {4000, 1}, {1, 6}, {7, 6}, {1000, 4}, {3999, 5}}) {
        Hdf5File(folder / "x.h5").write_numbers("/force", {4000, 6}, values, H5T_NATIVE_DOUBLE, chunk);
        const auto recording = load_recording(folder / "x.h5", {.channels = {"2", "5"}, .rate = 100}, 100);
        ASSERT_EQ(recording.force[1].size(), 4000U);
        for (std::size_t r = 0; r < 4000; ++r) {
            ASSERT_EQ(recording.force[0][r], values[r * 6 + 1]);
            ASSERT_EQ(recording.force[1][r], values[r * 6 + 4]);
        }
        Hdf5File(folder / "y.h5")
            .write_numbers("/force", {6, 4000}, values, H5T_NATIVE_DOUBLE, chunk.empty() ? chunk : std::vector{chunk[1], chunk[0]});
        const auto transposed = load_recording(folder / "y.h5", {.table = {{}, true}, .channels = {"2", "5"}, .rate = 100}, 100);
        for (std::size_t r = 0; r < 4000; ++r) ASSERT_EQ(transposed.force[1][r], values[4 * 4000 + r]);
    }
}

TEST(Hdf5, AnArrayWithExchangedDimensionsIsRefusedOrTransposed) {
    const TemporaryFolder folder;
    const auto row_array = [&](const auto& more) {
        Hdf5File file(folder / "x.h5");
        file.write_numbers("/force", {2, 3000}, ramp(6000));
        more(file);
    };
    row_array([](auto&) {});
    EXPECT_EQ(load_error(folder / "x.h5", {.rate = 500}),
              "x.h5: /force (2 x 3000): 3000 channels of only 2 samples? Use --transpose if each row is a channel, or "
              "--no-transpose if each row is a sample");
    const auto transposed = load_recording(folder / "x.h5", {.table = {{}, true}, .rate = 500});
    EXPECT_EQ(transposed.names, (std::vector<std::string>{"ch1", "ch2"}));
    EXPECT_EQ(transposed.force[1][2999], 5999);
    EXPECT_EQ(load_recording(folder / "x.h5", {.table = {{}, false}, .rate = 500}).names.size(), 3000U);
    row_array([](auto& f) { f.write_numbers("/timestamps", {3000}, ramp(3000, 0.002)); });
    const auto timed = load_recording(folder / "x.h5");
    EXPECT_EQ(timed.force.size(), 2U) << "the times determine their dimension";
    EXPECT_EQ(timed.notes.at(0),
              "/force (2 x 3000): taken as 2 channels of 3000 samples, to match the times; use --no-transpose if each row is a sample");
    row_array([](auto& f) { f.write_string_array_attribute("/force", "channels", {"fx_N", "fz_N"}); });
    EXPECT_EQ(load_recording(folder / "x.h5", {.rate = 500}).names, (std::vector<std::string>{"fx", "fz"}));
    row_array([](auto& f) { f.write_numbers("/timestamps", {2}, ramp(2, 0.002)); });
    EXPECT_EQ(load_recording(folder / "x.h5").force.size(), 3000U) << "few samples of many electrodes";
    row_array([](auto& f) { f.write_attribute("/force", "MATLAB_class", "double"); });
    EXPECT_EQ(load_recording(folder / "x.h5", {.rate = 500}).force.size(), 2U);
    EXPECT_NE(load_error(folder / "x.h5", {.table = {{}, true}, .rate = 500}), "");
}

TEST(Hdf5, TheEndOfAPathSelectsADatasetIfItIsUnique) {
    const TemporaryFolder folder;
    {
        Hdf5File file(folder / "x.nwb");
        file.write_numbers("/acquisition/FingerForce/data", {4}, ramp(4));
        file.write_numbers("/acquisition/skin/data", {4}, ramp(4, 2));
        file.write_numbers("/processing/skin/data", {4}, ramp(4, 3));
    }
    EXPECT_EQ(load_recording(folder / "x.nwb", {.table = {"FingerForce"}, .rate = 10}).force[0], ramp(4));
    EXPECT_EQ(load_recording(folder / "x.nwb", {.table = {"FingerForce/data"}, .rate = 10}).force[0], ramp(4));
    EXPECT_EQ(load_recording(folder / "x.nwb", {.table = {"/processing/skin"}, .rate = 10}).force[0], ramp(4, 3));
    EXPECT_EQ(load_error(folder / "x.nwb", {.table = {"skin"}, .rate = 10}),
              "x.nwb: several arrays match 'skin'; select one with --dataset PATH: /acquisition/skin/data (4), /processing/skin/data (4)");
    EXPECT_NE(load_error(folder / "x.nwb", {.table = {"Force"}, .rate = 10}).find("no array 'Force'"), std::string::npos);
}

TEST(Hdf5, AMissingFilterIsNamed) {
    const TemporaryFolder folder;
    const auto path = write_file_with(folder, "x.h5", [&](hid_t file, hid_t properties) {
        const hsize_t rows = 100;
        H5Pset_chunk(properties, 1, &rows), H5Pset_deflate(properties, 1);
        const auto values = ramp(1000);
        make_dataset(file, properties, {1000}, &values);
    });
    auto bytes = test::read_file(path);
    const auto message = bytes.find("deflate");  // the name follows the filter's number, flags and count of values
    ASSERT_NE(message, std::string::npos);
    bytes[message - 8] = '\x0f', bytes[message - 7] = '\x7d', bytes[message - 4] = '\0';  // 32015: zstd; not optional
    EXPECT_NE(load_error(folder.write("z.h5", bytes), {.rate = 10})
                  .find("compressed by filter 32015 (deflate), which is not available here. Repack the file where"),
              std::string::npos);
}

std::string seed(const char* name) { return test::read_file(test::source_root() + "/test/fuzz/seeds/hdf5/" + name).substr(1); }

TEST(Hdf5, DamagedFilesGiveAnErrorOrAreReadWithoutACrash) {
    const TemporaryFolder folder;
    const auto expect_no_crash = [&](std::string bytes, std::size_t at, int to) {
        bytes.at(at) = static_cast<char>(to);
        EXPECT_FALSE(load_error(folder.write("x.h5", bytes), {.rate = 10}).empty()) << at;
    };
    const auto undamaged = seed("latest");
    ASSERT_EQ(load_error(folder.write("x.h5", undamaged), {.rate = 10}), "read");
    for (std::size_t at = 0; at < undamaged.size(); at += 23) expect_no_crash(undamaged, at, ~undamaged[at]);
    // These files were found by changing bytes at random. HDF5 1.10.8 reads beyond its memory when it opens or reads them, and often
    // crashes.
    auto on_opening = seed("plain"), on_reading = seed("packed");  // where HDF5 crashes
    on_opening.at(1485) = '\xff', on_reading.at(3744) = '\xff';
    for (int k = 0; k < 10; ++k) expect_no_crash(on_opening, 2175, 97), expect_no_crash(on_reading, 968, 98);
}

TEST(Hdf5, SeveralFilesAreOpenAtOnceAndLeaveNoChildren) {
    const TemporaryFolder folder;
    for (int k = 0; k < 4; ++k) Hdf5File(folder / fmt::format("{}.h5", k)).write_numbers("/f", {5000}, ramp(5000, k));
    {
        std::vector<std::unique_ptr<Table>> tables;
        for (int k = 0; k < 4; ++k) tables.push_back(test::value_or_throw(open_hdf5_table(folder / fmt::format("{}.h5", k))));
        std::vector<std::vector<double>> out(1);
        tables[1].reset();  // the other helpers must not hold its socket open
        for (const std::size_t k : {0U, 2U, 3U})
            for (const std::size_t rows : {4096U, 904U}) {
                EXPECT_EQ(test::value_or_throw(tables[k]->read({0}, 4096, out)), rows);
                EXPECT_EQ(out[0][rows - 1], static_cast<double>(k * (rows == 904 ? 4999 : 4095)));
            }
    }
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child process is left";
    EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace corpuscle
