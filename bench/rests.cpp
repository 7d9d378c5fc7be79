// Which method finds the operating points of chips with mismatch, and how long does it take?
//
//     bench-rests NETLIST [CHIPS] [SEED]      default: 1000 chips, seed 1
//
// Method: the netlist is read once. Each chip has its own sample of mismatch and process, with the standard deviations of the section of
// the process file that the netlist selects. It is solved first like .op, then like the start of a transient, with the nodes of .ic held.
// Output: the number of chips that each method solved ("none": chips that did not converge), Newton steps (mean, median, maximum), and
// microseconds of processor time per chip.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>

#include "circuit/analysis/transient_setup.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/variant/netlist_variants.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::circuit;

/// Processor time, s; other load on the machine affects it less than wall time.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The chips that one method solved.
struct MethodStatistics {
    std::vector<int> steps;  // Newton steps of each chip
    double seconds = 0;      // processor time of all chips
};

void print_methods(const char* label, std::map<std::string, MethodStatistics>& methods) {
    std::printf("%s\n", label);
    for (auto& [name, statistics] : methods) {
        auto& s = statistics.steps;
        std::sort(s.begin(), s.end());
        double sum = 0;
        for (const int n : s) sum += n;
        const double count = static_cast<double>(s.size());
        std::printf("  %-18s %6zu chips  steps mean %.1f median %d max %d  %.0f us each\n", name.c_str(), s.size(), sum / count,
                    s[s.size() / 2], s.back(), 1e6 * statistics.seconds / count);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return std::fputs("bench-rests NETLIST [CHIPS] [SEED]\n", stderr), 2;
    const double chips = argc > 2 ? std::atof(argv[2]) : 1000;
    const auto netlist = Netlist::read(argv[1]);
    if (!netlist) return std::fprintf(stderr, "%s\n", netlist.error().text().c_str()), 1;
    auto circuit = netlist->elaborate();
    if (!circuit) return std::fprintf(stderr, "%s\n", circuit.error().text().c_str()), 1;
    auto bench = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
    if (!bench) return std::fprintf(stderr, "%s\n", bench.error().text().c_str()), 1;
    const ChipSpec spec{chips, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1};
    for (const bool with_ic : {false, true}) {
        std::map<std::string, MethodStatistics> methods;  // by name
        for (std::uint64_t k = 0; static_cast<double>(k) < chips; ++k) {
            (*bench)->apply_variation(spec.sample(k));
            const double start = now();
            const auto found = with_ic ? (*bench)->initial_operating_point() : (*bench)->operating_point();
            auto& statistics = methods[found ? std::string(found->method) : "none"];
            statistics.seconds += now() - start;
            statistics.steps.push_back((*bench)->newton.iterations);
        }
        print_methods(with_ic ? "with .ic held" : "as .op", methods);
    }
}
