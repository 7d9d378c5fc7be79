// NWB files of our own are read again to the bit. Files of other programs are read, damaged ones are refused.

#include "io/nwb/nwb_file.hpp"
#include "io/spikes/spike_files.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::Hdf5File, test::load_error, test::load_recording, test::read_file, test::TemporaryFolder, test::value_or_throw;

using Trains = std::vector<std::vector<double>>;

/// Units named sa1#1, sa1#2 ... on the channel "a, b", observed long enough for their spikes.
NwbUnits units_of(const Trains& trains) {
    NwbUnits out{.description = "units", .trains = trains, .from = 0, .to = 1e9, .columns = {}};
    out.columns = {{"afferent", "name", {}, {}}, {"channel", "channel", {}, {}}, {"f_B", "cutoff", {}, {}}};
    for (std::size_t u = 0; u < trains.size(); ++u) {
        out.columns[0].texts.push_back(fmt::format("sa1#{}", u + 1)), out.columns[1].texts.emplace_back("a, b");
        out.columns[2].numbers.push_back(20 + static_cast<double>(u));
    }
    return out;
}

Result<void> write(const std::string& path, const NwbUnits& units, const std::vector<double>& force = {0, 0.5, 0.25}) {
    auto nwb = value_or_throw(NwbFile::create(path, {}));
    nwb.set_default_description("a test");
    nwb.add_provenance("corpuscle respond press", "seed 0");
    nwb.add_force({.name = "press/1", .description = "force", .channels = {"a, b"}, .start = 2, .rate = 100});
    nwb.append_force(force);
    TRY(nwb.add_units(units));
    TRY(nwb.add_trials(std::vector<NwbTrial>{{2, 2.02, "first"}}));
    return nwb.commit();
}

void written(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().text());
}

/// A valid file of two units and a force.
std::string write_small(const std::string& path) {
    written(write(path, units_of({{0.1, 0.25}, {}})));
    return path;
}

std::string spike_error(const std::string& path, const SpikeColumns& columns = {}) {
    const auto trains = read_spikes(path, columns);
    return trains ? "read" : trains.error().text().substr(path.rfind('/') + 1);
}

TEST(Nwb, TrainsAreReadAsTheyWereWritten) {
    const TemporaryFolder folder;
    EXPECT_TRUE(rc::check("round trip", [&](const std::vector<std::set<std::uint32_t>>& all) {
        Trains trains;
        for (const auto& one : all) {
            trains.emplace_back();
            for (const auto t : one) trains.back().push_back(t * 0.1);  // not exact in decimal digits
        }
        RC_PRE(!trains.empty());
        written(write(folder / "x.nwb", units_of(trains)));
        const auto read = value_or_throw(read_spikes(folder / "x.nwb"));
        RC_ASSERT(read.size() == trains.size());
        for (std::size_t u = 0; u < trains.size(); ++u) {
            RC_ASSERT(read[u].name() == fmt::format("sa1#{},a, b", u + 1));
            RC_ASSERT(read[u].times == trains[u]);
        }
    }));
}

TEST(Nwb, TheForceIsReadAsItWasWritten) {
    const TemporaryFolder folder;
    std::vector<double> force(20000);
    for (std::size_t k = 0; k < force.size(); ++k) force[k] = 1.0 / static_cast<double>(k + 1);
    written(write(folder / "x.nwb", units_of({{0.5}}), force));
    const auto read = load_recording(folder / "x.nwb");
    EXPECT_EQ(read.force[0], force);
    EXPECT_EQ(read.clock.rate(), 100);
    EXPECT_EQ(read.clock.t0, 2);
}

TEST(Nwb, EqualContentsGiveEqualBytes) {
    const TemporaryFolder folder;
    const auto bytes = read_file(write_small(folder / "x.nwb"));
    EXPECT_EQ(read_file(write_small(folder / "y.nwb")), bytes);
    written(write(folder / "z.nwb", units_of({{0.1, 0.26}, {}})));
    EXPECT_NE(read_file(folder / "z.nwb"), bytes);
}

TEST(Nwb, TrainsThatNwbDoesNotAllowAreRefused) {
    const TemporaryFolder folder;
    const auto refused = [&](NwbUnits units) {
        const auto ok = write(folder / "x.nwb", units);
        return ok ? "written" : ok.error().text();
    };
    auto short_interval = units_of({{0.1, 0.3}});
    short_interval.to = 0.2;
    auto with_t_ref = units_of({{0.1, 0.1}});
    with_t_ref.columns.push_back({"t_ref", "refractory time", {}, {0}});
    EXPECT_NE(refused(units_of({{0.1, 0.1}})).find("x.nwb: sa1#1 on a, b has two spikes at 0.1 s. NWB needs different times"),
              std::string::npos);
    EXPECT_NE(refused(with_t_ref).find("--set .t_ref=1ms"), std::string::npos);
    EXPECT_NE(refused(units_of({{0.2, 0.1}})).find("has spikes that are not in order, at 0.1 s"), std::string::npos);
    EXPECT_NE(refused(units_of({{-0.1}})).find("has a spike at -0.1 s. NWB counts times from the start of the session"), std::string::npos);
    EXPECT_NE(refused(short_interval).find("has a spike at 0.3 s, outside the observed 0 s to 0.2 s"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "x.nwb"));
}

TEST(Nwb, AnUnfinishedFileLeavesNothing) {
    const TemporaryFolder folder;
    {
        auto nwb = value_or_throw(NwbFile::create(folder / "new/x.nwb", {}));
        nwb.add_force({.name = "press", .description = "force", .channels = {"a"}});
        EXPECT_TRUE(std::filesystem::exists(folder / "new"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
}

TEST(Nwb, AFullDiskIsAnError) {
    auto file = value_or_throw(NwbFile::create("/dev/full", {}));
    const auto ok = file.commit();
    ASSERT_FALSE(ok);
    EXPECT_EQ(ok.error().text().substr(0, 39), "/dev/full: could not be written complet");
}

/// The units of another program: ids, and a column of unit_name.
void write_foreign(const std::string& path, const std::vector<double>& ends) {
    Hdf5File file(path);
    file.write_attribute("/", "neurodata_type", "NWBFile");
    file.write_numbers("/units/id", {2}, {7, 12}, H5T_STD_I64LE);
    file.write_numbers("/units/spike_times", {3}, {0.5, 1.5, 0.25});
    file.write_numbers("/units/spike_times_index", {ends.size()}, ends, H5T_STD_U8LE);
    file.write_numbers("/units/cluster", {2}, {3, 3}, H5T_STD_I32LE);
}

TEST(Nwb, UnitsOfOtherProgramsAreNamedByTheirIds) {
    const TemporaryFolder folder;
    write_foreign(folder / "x.nwb", {2, 3});
    const auto trains = value_or_throw(read_spikes(folder / "x.nwb"));
    ASSERT_EQ(trains.size(), 2U);
    EXPECT_EQ(trains[0].name(), "7");
    EXPECT_EQ(trains[0].times, (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(trains[1].name(), "12");
    EXPECT_EQ(spike_error(folder / "x.nwb", {{}, "cluster"}),
              "x.nwb: several units have '3' in the column 'cluster'; select a column with different values, such as --train id. Columns: "
              "cluster, id");
    EXPECT_EQ(spike_error(folder / "x.nwb", {{}, "name"}), "x.nwb: --train name: there is no such column of units. Columns: cluster, id");
    EXPECT_EQ(read_spikes(folder / "x.nwb", {"t", {}}).error().text(),
              "--time t: the spike times of an NWB file are in its column spike_times");
}

TEST(Nwb, WrongUnitsAreRefused) {
    const TemporaryFolder folder;
    write_foreign(folder / "a.nwb", {2, 4});
    EXPECT_EQ(spike_error(folder / "a.nwb"), "a.nwb: /units/spike_times_index: element 1 is 4, which is not between 2 and 3");
    write_foreign(folder / "b.nwb", {2, 1});
    EXPECT_EQ(spike_error(folder / "b.nwb"), "b.nwb: /units/spike_times_index: element 1 is 1, which is not between 2 and 3");
    write_foreign(folder / "c.nwb", {3});
    EXPECT_EQ(spike_error(folder / "c.nwb"), "c.nwb: /units has 1 units, but its column 'id' has 2 elements");
    Hdf5File(folder / "d.nwb").write_numbers("/units/id", {1}, {0});
    EXPECT_EQ(spike_error(folder / "d.nwb"),
              "d.nwb: this HDF5 file is not an NWB file, the only HDF5 format with spikes that is read: its root has no attribute "
              "neurodata_type = NWBFile");
    Hdf5File(folder / "e.nwb").write_attribute("/", "neurodata_type", "NWBFile");
    EXPECT_EQ(spike_error(folder / "e.nwb"), "e.nwb: this NWB file has no units, and so no spikes");
}

TEST(Nwb, TheOnlySeriesInNewtonsIsTheForce) {
    const TemporaryFolder folder;
    const auto write_series = [&](const std::string& name, const std::map<std::string, std::string>& units) {
        Hdf5File file(folder / name);
        file.write_attribute("/", "neurodata_type", "NWBFile");
        for (const auto& [path, unit] : units) {
            file.write_numbers(path + "/data", {4}, {1, 2, 3, 4});
            file.write_attribute(path, "neurodata_type", "TimeSeries");
            file.write_attribute(path + "/data", "unit", unit);
            file.write_numbers(path + "/starting_time", {}, {0.5});
            file.write_attribute(path + "/starting_time", "rate", 100.0);
        }
        return folder / name;
    };
    const auto one = write_series("one.nwb", {{"/acquisition/emg", "V"}, {"/acquisition/grip", "mN"}});
    EXPECT_EQ(load_recording(one).names, std::vector<std::string>{"grip"});
    EXPECT_EQ(load_recording(one).force[0][3], 0.004);
    EXPECT_EQ(load_error(write_series("two.nwb", {{"/acquisition/a", "N"}, {"/stimulus/presentation/b", "newtons"}})),
              "two.nwb: several time series are in newtons; select one with --dataset NAME: /acquisition/a (4) in N, "
              "/stimulus/presentation/b (4) in newtons");
    EXPECT_EQ(load_error(write_series("none.nwb", {{"/acquisition/a", "V"}, {"/acquisition/b", "A"}})),
              "none.nwb: no time series is in newtons; select one with --dataset NAME, and give its unit with --unit or --scale: "
              "/acquisition/a (4) in V, /acquisition/b (4) in A");
}

TEST(Nwb, DamagedFilesGiveAnErrorOrAreReadWithoutACrash) {
    const TemporaryFolder folder;
    const auto bytes = read_file(write_small(folder / "x.nwb"));
    ASSERT_EQ(spike_error(folder / "x.nwb"), "read");
    std::size_t refused = 0;
    for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 150) {
        auto damaged = bytes;
        damaged[at] = static_cast<char>(~damaged[at]);
        const auto path = folder.write("y.nwb", damaged);
        EXPECT_FALSE(spike_error(path).empty());
        refused += spike_error(path) != "read";
    }
    EXPECT_GT(refused, 0U);
    for (std::size_t end = 0; end < bytes.size(); end += bytes.size() / 40 + 1)
        EXPECT_NE(spike_error(folder.write("y.nwb", bytes.substr(0, end))), "read") << end;
}

}  // namespace
}  // namespace corpuscle
