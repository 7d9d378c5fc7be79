#pragma once
// Force in, spikes out: afferents on channels, or a skin.

#include "corpuscle/force.hpp"

namespace corpuscle {

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

/// The spikes of all afferents of a run.
struct Response {
    std::vector<double> times = {};                  ///< s, in order
    std::vector<std::uint32_t> indices = {};         ///< for each spike, the index of its afferent
    std::vector<RespondingAfferent> afferents = {};
    double start = 0, duration = 0;             ///< s, of the force
    std::vector<std::string> notes = {}, warnings = {};
    std::function<std::string()> summary = {};       ///< computes the document of summary.json, which costs more than a short run

    /// The spike times of one afferent, s.
    CORPUSCLE_API std::vector<double> train(std::size_t afferent) const;
};

/// Simulates afferents or a skin under a force. Throws InputError.
CORPUSCLE_API Response respond(const ForceView&, const Simulation& = {});
/// Simulates one afferent ("sa1", "sa1b+izhikevich") with settings such as "sa1.f_B=25Hz". Throws InputError.
CORPUSCLE_API Response respond(const std::string& afferent, const ForceView&, const std::vector<std::string>& settings = {});
/// Simulates afferents or a skin under a stimulus or a named touch of a skin ("press", "stroke"). `rate` is the sample rate in Hz; 0: 10 kHz
/// on channels, 1 kHz in a skin. Throws InputError.
CORPUSCLE_API Response respond_to(const std::string& stimulus, const Simulation& = {}, double rate = 0);

}  // namespace corpuscle
