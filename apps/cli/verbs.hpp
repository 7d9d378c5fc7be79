#pragma once
// The command-line arguments of each verb as typed. main.cpp fills these structures; one file per verb does the work and returns the
// exit status.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle {

/// An option as typed, under its long name.
struct TypedOption {
    std::string name;
    std::vector<std::string> values;
};

struct Common {
    bool json = false, quiet = false;
    bool overwrite = false;               ///< replace files that no earlier run wrote
    std::string command;                  ///< as typed, for the report page
    std::vector<TypedOption> typed = {};  ///< the verb's options, in the order of --help
};

/// Overrides and probes, which apply to every netlist of the run.
struct NetlistWords {
    std::optional<std::string> supply, temp, corner, mismatch;
    std::vector<std::string> traces;
};

/// How to read a recording; recording_options() converts this to options of the reader.
struct RecordingWords {
    std::vector<std::string> channels, notch;
    std::optional<std::string> rate, dataset, time, time_unit, unit, scale, resample, offset, range, bad_fields, despike, lowpass;
    std::string layout;
    std::optional<std::uint32_t> skip;  ///< lines
    std::optional<bool> transpose;
    bool absolute = false;
};

struct RespondWords : RecordingWords {
    NetlistWords netlists;
    std::vector<std::string> forces, afferents = {"sa1", "fa1"}, settings, spreads;
    std::optional<std::string> noise, bin;
    std::string method = "exact";
    bool sampled = false, traces = false, vectors = false, report = false, npz = false, wav = false;
    std::string out, report_file;
    std::string population, contact, events, checkpoint;  ///< of a skin; "": not given
    std::uint64_t seed = 0;
    std::uint32_t copies = 0;   ///< 0: not given
    std::uint32_t threads = 0;  ///< 0: one per core
    bool in_float = false;
};

struct CompareWords {
    std::vector<std::string> files, pairs;
    std::optional<std::string> time, unit;  ///< columns of the spike tables
    bool by_order = false;
    std::string window = "5ms", cost = "100Hz", tau = "10ms";
};

struct StudyWords {
    std::vector<std::string> names;
    std::string report_file, markdown_file;
};

struct RunWords {
    NetlistWords netlists;
    std::vector<std::string> settings;
    std::string netlist, out;
    bool ascii = false, budget = false;
};

struct ExportWords {
    std::string netlist, target = "ngspice", out;
};

struct SweepWords {
    std::string file, out, shard;
    std::optional<std::uint64_t> seed;
    std::optional<std::int64_t> units;
    std::size_t lanes = 8;
    std::uint32_t threads = 0;  ///< 0: one per core, or one per MPI rank
    bool status = false;
};

/// corpuscle sweep merge OUT IN...
struct SweepMergeWords {
    std::string out;
    std::vector<std::string> in;
};

/// corpuscle sweep show RESULTS
struct SweepShowWords {
    std::string results, report_file;
    std::vector<std::string> by, measures;
    std::vector<double> quantiles;
};

/// corpuscle sweep calibrate NETLIST
struct SweepCalibrateWords {
    std::string netlist, like, force = "press", corner = "mc";
    std::vector<std::string> trims;
    int bits = 4;
    std::int64_t units = 64;
    std::uint64_t seed = 1;
    std::uint32_t threads = 0;
    bool apart = false;
};

struct StreamWords : RecordingWords {
    std::string population = "sa1,fa1", in = "-", listen = "127.0.0.1", frames = "csv", stamp = "none", pace = "real";
    std::vector<std::string> settings;
    std::string limit = "1kN", hold = "100ms", longest = "10s", buffer = "1M", idle = "10s";
    std::string out = "-", to, format = "lines", save, resume;
    std::size_t count = 1;     ///< channels
    std::size_t together = 1;  ///< frames per batch
    std::int64_t clients = 0;  ///< 0: unlimited
    long baud = 115200;
    bool sampled = false, spin = false, allow_drops = false;
};

struct ListWords {
    std::vector<std::string> what;
    bool sites = false;  ///< list the sites of a population
};

int respond(const RespondWords&, const Common&);
int respond_skin(const RespondWords&, const Common&);
int compare_trains(const CompareWords&, const Common&);
int study(const StudyWords&, const Common&);
int run(const RunWords&, const Common&);
int export_to(const ExportWords&, const Common&);
int sweep(const SweepWords&, const Common&);
int sweep_merge(const SweepMergeWords&, const Common&);
int sweep_calibrate(const SweepCalibrateWords&, const Common&);
int sweep_dump(const std::string& results, const Common&);
int sweep_show(const SweepShowWords&, const Common&);
int stream(const StreamWords&, const Common&);
int list(const ListWords&, const Common&);

}  // namespace corpuscle
