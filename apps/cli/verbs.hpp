#pragma once
// What each verb is asked for, as typed; main.cpp fills these in, a file a verb does the work and gives the exit status.

#include <optional>
#include <string>
#include <vector>

namespace corpuscle {

struct Common {
    bool json = false, quiet = false;
    std::string command;  ///< as it was typed, for the report
};

struct RespondWords {
    std::vector<std::string> forces, afferents = {"sa1", "fa1"}, settings, channels;
    std::optional<std::string> rate, dataset, time, time_unit, unit, scale, resample, noise;
    std::string method = "exact";
    bool sampled = false, absolute = false, traces = false, vectors = false, report = false;
    std::string out, report_file;
    std::uint64_t seed = 0;
};

struct ListWords {
    std::vector<std::string> what;
};

int respond(const RespondWords&, const Common&);
int list(const ListWords&, const Common&);

}  // namespace corpuscle
