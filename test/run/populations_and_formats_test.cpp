// Every kind of population with every output format: the files have the spikes of spikes.csv, or the table of exceptions has the reason.

#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "io/spikes/events.hpp"
#include "io/spikes/spike_files.hpp"
#include "io/table/npz.hpp"
#include "run/earlier_outputs.hpp"
#include "run/population_exceptions.hpp"
#include "run/sinks.hpp"
#include "support/program.hpp"
#include "support/sinks.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
using test::read_file, test::run_program, test::TemporaryFolder, test::value_or_throw;

struct PopulationCase {
    std::string name, arguments;
    PopulationKind kind;
};

/// Every afferent of a population on channels is beside one with a converter, for the vectors.
const PopulationCase populations[] = {
    {"models", "press --rate 1kHz -a sa1,sa1-kim", PopulationKind::channels},
    {"two-inputs", "press sine --rate 1kHz -a sa1,sa1-kim", PopulationKind::channels},
    {"netlist", "press --rate 1kHz -a sa1-circuit,sa1-kim", PopulationKind::channels},
    {"copies", "press --rate 1kHz -a sa1,sa1-kim --copies 3 --spread sa1.f_B=10%", PopulationKind::channels},
    {"layout", "four.csv --layout places.csv -a sa1-kim,fa1", PopulationKind::channels},
    {"skin", "press --population 'grid 3x2'", PopulationKind::skin},
    {"sensors", "four.csv --population 'grid 2x2'", PopulationKind::skin},
};

/// A recording of four channels, and a layout that names two of them.
void write_inputs(const TemporaryFolder& folder) {
    std::string text = "time_s,a_N,b_N,c_N,d_N\n";
    for (int k = 0; k < 1200; ++k)
        text += fmt::format("{:.3f},{:.4f},{:.4f},0,{:.4f}\n", k / 1000.0, std::min(3.0, k * 0.005), k > 400 ? 2.0 : 0.1, k % 300 / 100.0);
    folder.write("four.csv", text);
    folder.write("places.csv", "channel,name,x_mm,y_mm\n1,thumb,0,0\n2,palm,30,4\n");
}

/// Runs a population and returns its folder.
std::string respond_into(const TemporaryFolder& folder, const PopulationCase& population, const std::string& name,
                         const std::string& options) {
    const auto directory = population.name + "-" + name;
    const auto ran = run_program(folder, fmt::format("respond {} {} -q -o {}", population.arguments, options, directory));
    EXPECT_EQ(ran.status, 0) << population.name << ' ' << options << '\n' << ran.err;
    return folder / directory;
}

using Trains = std::map<std::string, std::vector<std::int64_t>>;

/// The times of each train, to the nanosecond, by its name; trains without spikes are left out.
Trains trains_in(const std::vector<std::string>& paths) {
    Trains out;
    for (const auto& path : paths)
        for (const auto& train : value_or_throw(read_spikes(path)))
            for (const double t : train.times) out[train.name()].push_back(std::llround(t * 1e9));
    return out;
}

/// The trains with their names up to the comma: binary events of a skin do not name the region.
Trains without_channels(const Trains& trains) {
    Trains out;
    for (const auto& [name, times] : trains) out[name.substr(0, name.find(','))] = times;
    return out;
}

/// The files in a folder that a format can write, in order of their names.
std::vector<std::string> files_of(const OutputFormat& format, const std::string& directory) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(directory))
        if (can_write(format, entry.path().filename().string())) paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths) EXPECT_GT(fs::file_size(path), 0U) << path;
    return paths;
}

/// The sum of the fields of each column of a CSV file whose heading a function selects. Lines that begin with # are left out.
double sum_of_columns(const std::string& path, const std::function<bool(const std::string&)>& is_selected) {
    std::istringstream text(read_file(path));
    std::vector<std::string> heading;
    double sum = 0;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with('#')) continue;
        std::istringstream fields(line + ",");
        const bool is_heading = heading.empty();
        std::size_t column = 0;
        for (std::string field; std::getline(fields, field, ','); ++column) {
            if (is_heading)
                heading.push_back(field);
            else if (is_selected(heading.at(column)))
                sum += std::stod(field);
        }
    }
    return sum;
}

std::size_t count_of(const Trains& trains, const std::string& name = "") {
    std::size_t count = 0;
    for (const auto& [train, times] : trains) count += train.find(name) != train.npos ? times.size() : 0;
    return count;
}

/// The number of non-zero bytes after the header of a sound.
std::size_t loud_bytes(const std::string& path) {
    const auto bytes = read_file(path).substr(44);
    return bytes.size() - static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\0'));
}

/// The options of all output formats that this kind of population has, except --events, which replaces spikes.csv.
std::string all_options(PopulationKind kind) {
    std::string options = "--report ";
    for (const auto* format : output_formats)
        if (!format->option.empty() && format != &events_format && !find_exception(kind, format->option))
            options += fmt::format("{} {} ", format->option, format == &psth_format ? "7ms" : "");
    return options;
}

/// Compares the files of a format with the trains of spikes.csv.
void expect_same_spikes(const OutputFormat& format, const std::vector<std::string>& paths, const Trains& expected) {
    if (format.names[0] == "spikes.csv" || format.names[0] == "spikes.npz" || &format == &nwb_format) {
        EXPECT_EQ(trains_in(paths), expected);
        return;
    }
    double counted = 0;
    for (const auto& path : paths) {
        if (&format == &sound_format) {
            EXPECT_GT(loud_bytes(path), 100U) << path;
        } else if (&format == &probes_format) {
            EXPECT_GT(sum_of_columns(path, [](const std::string& heading) { return heading.ends_with("_N"); }), 0) << path;
        } else {  // a column of spike counts or, for vectors, a column s, sA ... with 1 for each spike
            counted += sum_of_columns(
                path, [](const std::string& heading) { return heading == "spikes" || (heading.size() < 3 && heading.starts_with('s')); });
        }
    }
    if (&format != &sound_format && &format != &probes_format) {
        EXPECT_EQ(counted, static_cast<double>(count_of(expected, &format == &vectors_format ? "sa1-kim" : ""))) << paths[0];
    }
}

TEST(PopulationsAndFormats, EveryFileHasTheSpikesOfTheTable) {
    const TemporaryFolder folder;
    write_inputs(folder);
    for (const auto& population : populations) {
        SCOPED_TRACE(population.name);
        const auto directory = respond_into(folder, population, "all", all_options(population.kind));
        const auto expected = trains_in(files_of(spikes_format, directory));
        ASSERT_GT(count_of(expected), 10U);
        for (const auto* format : output_formats) {
            if (format == &events_format || find_exception(population.kind, format->name())) continue;
            const auto paths = files_of(*format, directory);
            EXPECT_EQ(paths.empty(), (format == &copies_format && population.name != "copies") || format == &trials_format)
                << format->name();
            if (!paths.empty()) expect_same_spikes(*format, paths, expected);
        }
        const auto trials = respond_into(folder, population, "trials", "--align start");  // each input is a trial
        expect_same_spikes(trials_format, files_of(trials_format, trials), expected);
        const auto summary = nlohmann::json::parse(read_file(directory + "/summary.json"));
        EXPECT_EQ(summary["work"]["spikes"], count_of(expected));
        for (const auto& file : summary["files"]) EXPECT_TRUE(is_output_name(file.get<std::string>())) << file;
        EXPECT_NE(read_file(directory + "/report.html").find("id=\"data\""), std::string::npos);
    }
}

TEST(PopulationsAndFormats, EveryEventFormatHasTheSpikesOfTheTable) {
    const TemporaryFolder folder;
    write_inputs(folder);
    for (const auto& population : populations) {
        const auto expected = trains_in({respond_into(folder, population, "table", "") + "/spikes.csv"});
        for (const auto& format : event_formats()) {
            SCOPED_TRACE(fmt::format("{} {}", population.name, format.name));
            const auto directory = respond_into(folder, population, std::string(format.name), fmt::format("--events {}", format.name));
            const auto paths = files_of(events_format, directory);
            EXPECT_EQ(paths.size(), population.name == "two-inputs" ? 2U : 1U);
            if (format.name == "aedat2")  // its trains are named by their addresses, its times are rounded to a microsecond
                EXPECT_EQ(count_of(trains_in(paths)), count_of(expected));
            else if (format.name == "aer" && population.kind == PopulationKind::skin)
                EXPECT_EQ(trains_in(paths), without_channels(expected));
            else
                EXPECT_EQ(trains_in(paths), expected);
        }
    }
}

TEST(PopulationsAndFormats, AnOptionInTheTableOfExceptionsIsRefusedWithItsReasonAndRemedy) {
    const TemporaryFolder folder;
    int options = 0;
    for (const auto& exception : population_exceptions()) {
        if (!exception.option.starts_with("--")) continue;
        const auto population = exception.population == PopulationKind::skin ? "--population 'grid 2x2'" : "";
        const std::map<std::string_view, std::string_view> values = {
            {"--float", ""}, {"--vectors", ""}, {"--afferent", "sa1"}, {"--spread", "sa1.f_B=10%"}};
        const auto value = values.contains(exception.option) ? values.at(exception.option) : "1";
        const auto ran = run_program(folder, fmt::format("respond press {} {} {} -o out", population, exception.option, value));
        EXPECT_EQ(ran.status, 2) << exception.option;
        for (const auto text : {exception.option, exception.reason, exception.remedy})
            EXPECT_NE(ran.err.find(text), std::string::npos) << ran.err;
        EXPECT_FALSE(fs::exists(folder / "out"));
        ++options;
    }
    EXPECT_GT(options, 10);
}

TEST(PopulationsAndFormats, TheDocumentHasTheTableOfExceptions) {
    const auto text = read_file(test::source_root() + "/doc/recordings.md");
    std::string table;
    for (const auto& e : population_exceptions())
        table += fmt::format("| `{}` | {} | {} | {} |\n", e.option, e.population == PopulationKind::skin ? "a skin" : "channels", e.reason,
                             e.remedy);
    EXPECT_NE(text.find("| --- | --- | --- | --- |\n" + table + "\n"), std::string::npos) << "the table should be\n" << table;
}

TEST(PopulationsAndFormats, AffordProbesOnlyOfASmallSkin) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press --population fingertip --probe-files -o out");
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.err.find("--probe-files works with at most 50 afferents of a class, but fingertip has 290 of sa1"), std::string::npos)
        << ran.err;
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(PopulationsAndFormats, TheHelpHasTheOptionOfEachFormat) {
    const TemporaryFolder folder;
    const auto help = run_program(folder, "respond --help-all").out;
    for (const auto* format : output_formats) EXPECT_NE(help.find(format->option), std::string::npos) << format->name();
}

}  // namespace
}  // namespace corpuscle
