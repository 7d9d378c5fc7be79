#pragma once
// The command-line arguments of each verb, as typed or with their defaults. Members are named after their options unless a comment says
// otherwise. main.cpp, option_groups.cpp and the *_verbs.cpp files declare the options. The functions at the end run the verbs and return
// the exit status.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle {

/// An option or positional argument as typed. `name` is the long name of an option: "--afferent".
struct TypedOption {
    std::string name;
    std::vector<std::string> values;
};

struct CommonArguments {
    bool json = false;                    ///< print one JSON document on standard output
    bool quiet = false;                   ///< print neither tables nor progress nor notes
    bool overwrite = false;               ///< also replace files that were not written by an earlier run
    std::string command;                  ///< the command line, see quote_command(); for the report page
    std::vector<TypedOption> typed = {};  ///< the options that were given to the verb, in the order of --help-all
};

/// Options that apply to every netlist of the run.
struct NetlistArguments {
    std::optional<std::string> supply, temp, corner, mismatch;
    std::vector<std::string> probes;
};

/// The options for reading a recording; recording_options() converts them to RecordingOptions.
struct RecordingArguments {
    std::vector<std::string> channels, notch;  ///< all --channel and --notch options
    std::optional<std::string> rate, dataset, time, time_unit, unit, scale, resample, offset, range, bad_fields, despike, lowpass;
    std::string layout;
    std::optional<std::uint32_t> skip;  ///< number of lines at the beginning of a text file
    std::optional<bool> transpose;      ///< true: --transpose; false: --no-transpose
    bool absolute = false;              ///< --abs
};

struct RespondArguments : RecordingArguments {
    NetlistArguments netlists;
    std::vector<std::string> forces, afferents = {"sa1", "fa1"}, settings, spreads;
    std::optional<std::string> noise;
    std::string method = "exact";
    bool sampled = false;
    bool has_report = false;                      ///< --report was given
    std::string out, report_file;                 ///< report_file: of --report; "" without a name
    std::string population, contact, checkpoint;  ///< options of a skin; "": not given
    /// The options of the output formats (run/sinks.hpp) with their values; "" for a flag.
    std::map<std::string, std::string, std::less<>> outputs;
    std::uint64_t seed = 0;
    std::uint32_t copies = 0;   ///< 0: not given
    std::uint32_t threads = 0;  ///< 0: one per core
    bool use_float = false;     ///< --float
};

struct CompareArguments {
    std::vector<std::string> files, pairs;
    std::optional<std::string> time_column, train_column;  ///< columns of the spike files, by name or number
    bool by_order = false;
    std::string window = "5ms", cost = "100Hz", tau = "10ms";
};

struct RunArguments {
    NetlistArguments netlists;
    std::vector<std::string> settings;
    std::string netlist, out;
    bool ascii = false, budget = false;
};

struct ExportArguments {
    std::string netlist, target = "ngspice", out;
};

struct SweepArguments {
    std::string file, out, shard;
    std::optional<std::uint64_t> seed;
    std::optional<std::int64_t> samples;
    std::size_t lanes = 8;      ///< number of chips that one thread simulates at once: 1, 4 or 8
    std::uint32_t threads = 0;  ///< 0: one per core, or one per MPI rank
    bool status = false;        ///< only print the status of the sweep
};

/// corpuscle sweep merge OUT IN...
struct SweepMergeArguments {
    std::string out;
    std::vector<std::string> in;
};

/// corpuscle sweep show RESULTS
struct SweepShowArguments {
    std::string results, report_file;
    std::vector<std::string> by, measures;
    std::vector<double> quantiles;
};

/// corpuscle sweep calibrate NETLIST
struct SweepCalibrateArguments {
    std::string netlist, like, force = "press", corner = "mc";
    std::vector<std::string> trims;
    int bits = 4;               ///< maximum number of bits of each trim
    std::int64_t samples = 64;  ///< number of chips
    std::uint64_t seed = 1;
    std::uint32_t threads = 0;  ///< 0: one per core
    bool separately = false;    ///< also evaluate each trim alone
};

struct StreamArguments : RecordingArguments {
    std::string population = "sa1,fa1", in = "-", listen = "127.0.0.1", frames = "csv", stamp = "none", pace = "real";
    std::vector<std::string> settings;
    std::string max_force = "1kN", hold = "100ms", max_gap = "10s", buffer = "1M", idle_timeout = "10s";
    std::string out = "-", to, format = "lines", save_state, resume;
    std::size_t channel_count = 1;  ///< forces per frame, if `population` is a list of afferents
    std::size_t batch_frames = 1;   ///< frames per batch
    std::int64_t clients = 0;       ///< number of senders, one after another, after which the stream ends; 0: unlimited
    long baud = 115200;
    bool sampled = false, busy_poll = false, allow_drops = false;
};

struct ListArguments {
    std::vector<std::string> names;
    bool list_sites = false;  ///< list the sites of the population that `names` contains
};

int respond(const RespondArguments&, const CommonArguments&);
int compare_trains(const CompareArguments&, const CommonArguments&);
int run(const RunArguments&, const CommonArguments&);
int export_to(const ExportArguments&, const CommonArguments&);
int sweep(const SweepArguments&, const CommonArguments&);
int sweep_merge(const SweepMergeArguments&, const CommonArguments&);
int sweep_calibrate(const SweepCalibrateArguments&, const CommonArguments&);
int sweep_dump(const std::string& results, const CommonArguments&);
int sweep_show(const SweepShowArguments&, const CommonArguments&);
int stream(const StreamArguments&, const CommonArguments&);
int list(const ListArguments&, const CommonArguments&);

}  // namespace corpuscle
