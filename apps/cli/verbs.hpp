#pragma once
// What each verb is asked for, as typed; main.cpp fills these in, a file a verb does the work and gives the exit status.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle {

struct Common {
    bool json = false, quiet = false;
    std::string command;  ///< as it was typed, for the report
};

/// What is set of every netlist that takes part, and shown of it.
struct NetlistWords {
    std::optional<std::string> supply, temp, corner, mismatch;
    std::vector<std::string> traces;
};

struct RespondWords {
    NetlistWords netlists;
    std::vector<std::string> forces, afferents = {"sa1", "fa1"}, settings, spreads, channels;
    std::optional<std::string> rate, dataset, time, time_unit, unit, scale, resample, offset, range, bad_fields, despike, lowpass, noise,
        bin;
    std::optional<bool> transpose;
    std::vector<std::string> notch;
    std::string layout;
    std::string method = "exact";
    bool sampled = false, absolute = false, traces = false, vectors = false, report = false, npz = false, wav = false;
    std::string out, report_file;
    std::string population, contact, events, checkpoint;  ///< of a skin; "": not said
    std::uint64_t seed = 0;
    std::uint32_t copies = 0;   ///< 0: not asked for
    std::uint32_t threads = 0;  ///< 0: as many as there are cores
    bool in_float = false;
};

struct CompareWords {
    std::vector<std::string> files, pairs;
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
    std::uint32_t threads = 0;  ///< 0: as many as there are cores; of ranks: one each
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

struct StreamWords {
    std::string population = "sa1,fa1", in = "-", listen = "127.0.0.1", frames = "csv", stamp = "none", pace = "real", layout;
    std::vector<std::string> settings, channels;
    std::optional<std::string> rate, scale, offset, unit;
    std::optional<bool> transpose;
    std::string limit = "1kN", hold = "100ms", longest = "10s", buffer = "1M";
    std::string out = "-", to, format = "lines", save, resume;
    std::size_t count = 1;     ///< channels
    std::size_t together = 1;  ///< frames
    std::int64_t clients = 0;  ///< 0: without end
    long baud = 115200;
    bool sampled = false, spin = false;
};

struct ListWords {
    std::vector<std::string> what;
};

int respond(const RespondWords&, const Common&);
int respond_skin(const RespondWords&, const Common&);
int compare(const CompareWords&, const Common&);
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
