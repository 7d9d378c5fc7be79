#pragma once
// Parameters of an afferent from recorded spikes, or from published numbers (doc/fit.md).

#include <optional>

#include "corpuscle/force.hpp"

namespace corpuscle {

/// A force, and the spike trains of one afferent that were recorded under it.
struct FitRecording {
    ForceView force;                          ///< of one channel
    std::vector<std::vector<double>> trains;  ///< s, in the time of the force, ascending; several are repetitions
    std::string spike_file = "spikes";        ///< for messages
};

/// The options of a fit, as those of `corpuscle fit afferent`. Each text is as on the command line.
struct FitOptions {
    std::string afferent = "sa1";            ///< to fit; one of equations
    std::vector<std::string> free = {};      ///< names of the parameters to fit
    std::vector<std::string> bounds = {};    ///< "f_B=5Hz:50Hz"; such a parameter need not be in `free`
    std::vector<std::string> settings = {};  ///< of parameters that are kept, and starts of the search
    double tau = 10e-3;                      ///< s, width of the Gaussian that smooths the spikes
    double delay = 0;                        ///< s, conduction delay, which is subtracted from the recorded times
    double hold_out = 0;                     ///< this fraction of the data is not fitted, but scored; 0 to 0.9
    double rate = 0;                         ///< Hz, sample rate of the stimuli of a table of targets; 0: 10 kHz
    std::uint32_t points = 256;              ///< random points, of which the best are starts
    std::uint32_t starts = 8;                ///< local searches
    std::uint32_t evaluations = 400;         ///< most simulations of a local search in each of its stages
    std::uint64_t seed = 1;                  ///< of the random points; the result does not depend on the number of threads
    unsigned threads = 0;                    ///< 0: one for each core
    /// Called with the completed fraction, 0 to 1. If it returns false, the best values so far are returned, without intervals.
    std::function<bool(double)> progress = {};
};

/// A parameter that was fitted.
struct FittedValue {
    std::string name, unit;
    double start = 0, value = 0;            ///< before and after the fit, in `unit`
    std::optional<double> low, high;        ///< the 95 % interval; no value: the data do not determine the parameter
    bool is_at_bound = false;               ///< the best value is at an end of the bounds
};

/// The result of a fit.
struct AfferentFit {
    std::string afferent;
    std::vector<FittedValue> parameters;
    double start_score = 0, score = 0;        ///< before and after the fit: 0 is equal, 1 is as far as silence, or at the ends of ranges
    std::optional<double> test_score;         ///< of the held-out data
    std::vector<std::string> settings;        ///< the fitted values for Simulation::settings, "sa1.k_A=1.5e-06"
    bool is_interrupted = false;
    std::vector<std::string> warnings;
    std::string document;                     ///< the JSON document of `corpuscle fit afferent --json`
    std::string settings_file;                ///< the file that `-o` writes: a sweep file with the fitted values
};

/// Fits an afferent to recorded spikes. Throws InputError.
CORPUSCLE_API AfferentFit fit_afferent(std::span<const FitRecording>, const FitOptions&);
/// Fits an afferent to a table of published numbers. Throws InputError with file and row.
CORPUSCLE_API AfferentFit fit_targets(const std::string& path, const FitOptions&);

}  // namespace corpuscle
