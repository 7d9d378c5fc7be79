#pragma once
// The library's face: name an afferent, hand it force, get spikes. Errors are exceptions here, and only here.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace corpuscle {

/// Thrown by the functions of this header; what() is the sentence, with file, line and column if there are some.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Force over time, evenly sampled.
struct Touch {
    double rate = 10e3;         ///< Hz
    std::vector<double> force;  ///< N, one value a sample
};

/// A stimulus by name, or a sum ("press+noise"), with settings such as "press.F_max=2N". Throws Refused.
Touch stimulus(const std::string& name, const std::vector<std::string>& settings = {}, double rate = 10e3, std::uint64_t seed = 0);

/// What an afferent answered.
struct Response {
    std::vector<double> spikes;         ///< s, in order; sample 0 is at 0 s
    std::vector<double> rates() const;  ///< Hz, 1 / (t[k+1] - t[k]) at spike k (thesis 3.3); one fewer than spikes
};

/// All of one touch through one afferent ("sa1", "sa1b+izhikevich"), with settings such as "sa1.f_B=25Hz". Throws Refused.
Response respond(const std::string& afferent, const Touch&, const std::vector<std::string>& settings = {});

}  // namespace corpuscle
