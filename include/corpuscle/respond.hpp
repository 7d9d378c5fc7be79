#pragma once
// Force in, spikes out: afferents on channels, or a skin.

#include "corpuscle/force.hpp"

namespace corpuscle {

/// The report page that a run prepares, which takes time and memory. `brief` is for a notebook: a page of at most 2 MB, which names what it
/// leaves out.
enum class ReportDetail { none, brief, complete };

/// The subject of a run and its options. Each text is as on the command line.
struct Simulation {
    std::vector<std::string> afferents = {"sa1", "fa1"};  ///< on every channel; not used with a population
    std::string population = {};                          ///< "hand", "fingertip", "grid 8x8" or a file; "": afferents on channels
    std::string contact = {};                             ///< how one channel presses a population: "flat", "sphere", "edge", "grating"
    std::string taxels = {};                              ///< path of the layout of the taxels that the channels are (doc/taxels.md)
    std::vector<std::string> settings = {};               ///< "sa1.f_B=25Hz", "contact.radius=5mm"
    std::uint32_t copies = 0;                             ///< of each afferent, which vary by `spreads`; 0: the afferents themselves
    std::vector<std::string> spreads = {};                ///< "sa1.f_B=10%"
    std::uint64_t seed = 0;                               ///< of all random numbers
    double noise = 0;                                     ///< A, of the current of each afferent
    bool backward_euler = false;                          ///< the thesis's integration; default: exact
    bool sampled = false;                                 ///< spikes have the times of samples, as in the thesis
    bool single_precision = false;                        ///< float instead of double: twice as many afferents a second
    unsigned threads = 0;                                 ///< 0: one for each core; the response does not depend on it
    ReportDetail report = ReportDetail::none;             ///< fills Response::report
    /// Called with the completed fraction of the run, 0 to 1. If it returns false, the run stops with InterruptedError.
    std::function<bool(double)> progress = {};
};

/// An afferent that responded.
struct RespondingAfferent {
    std::string name;     ///< "sa1"; of a copy or in a skin "sa1#17"
    std::string type;     ///< the afferent or class without the number
    std::string channel;  ///< the channel of the force, or the region of the skin
    double x = 0, y = 0;  ///< position in a skin, m; NaN on channels
};

/// A parameter of the afferents of a run.
struct ModelParameter {
    std::string name, unit, description;
    std::vector<double> values;  ///< for each afferent, SI; NaN if it has no such parameter
};

/// The models of the afferents of a run, for each afferent.
struct AfferentModels {
    std::vector<std::string> models;      ///< "sa1b+lif-b", "netlist"
    std::vector<std::string> properties;  ///< those that are not numbers: "receptor = sa1b, neuron = lif-b"
    std::vector<ModelParameter> parameters;
};

/// The spikes of all afferents of a run.
struct Response {
    std::vector<double> times = {};           ///< s, in order
    std::vector<std::uint32_t> indices = {};  ///< for each spike, the index of its afferent
    std::vector<RespondingAfferent> afferents = {};
    double start = 0, duration = 0;                      ///< s, of the force
    /// The total normal force on a skin under a stimulus or touch by name, one channel. Otherwise null: the caller has the force.
    std::shared_ptr<const Force> skin_force = {};
    std::vector<std::string> notes = {}, warnings = {};  ///< those of the command line
    /// Computes notes about afferents on channels that never fired, with the force that they need. It simulates them some ten times.
    std::function<std::vector<std::string>()> silence_notes = {};
    std::function<AfferentModels()> models = {};  ///< computes the models of the afferents
    std::function<std::string()> summary = {};    ///< computes the document of summary.json, which costs more than a short run
    /// Makes the report page, self-contained HTML; null without Simulation::report. `command`: the text that the page shows as its command.
    std::function<std::string(const std::string& command)> report = {};

    /// The spike times of one afferent, s.
    CORPUSCLE_API std::vector<double> train(std::size_t afferent) const;
};

/// Throws InputError if a report page may not have this path: it must end in .html, and not name a file that is not such a page.
CORPUSCLE_API void check_report(const std::string& path);
/// Writes a report page, after that check.
CORPUSCLE_API void write_report(const std::string& path, const std::string& page);

/// Simulates afferents or a skin under a force. Throws InputError.
CORPUSCLE_API Response respond(const ForceView&, const Simulation& = {});
/// Simulates one afferent ("sa1", "sa1b+izhikevich") with settings such as "sa1.f_B=25Hz". Throws InputError.
CORPUSCLE_API Response respond(const std::string& afferent, const ForceView&, const std::vector<std::string>& settings = {});
/// Simulates afferents or a skin under a stimulus or a named touch of a skin ("press", "stroke"). `rate` is the sample rate in Hz; 0: 10
/// kHz on channels, 1 kHz in a skin. Throws InputError.
CORPUSCLE_API Response respond_to(const std::string& stimulus, const Simulation& = {}, double rate = 0);

}  // namespace corpuscle
