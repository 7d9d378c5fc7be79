// Arbitrary bytes as a layout of taxels on a fingertip. Expected: a map in which the weights of each taxel are positive and sum to 1, or to
// what dead taxels add and take; or an error that names an existing line.

#include <algorithm>

#include "recording.hpp"
#include "skin/plan/skin_plan.hpp"
#include "skin/taxel/taxel_map.hpp"

using namespace corpuscle;

namespace {

void check_map(const TaxelLayout& layout, const TaxelMap& map, std::size_t sites) {
    fuzz::require(map.begin.size() == map.sites.size() + 1 && map.taxel.size() == map.begin.back());
    for (const auto site : map.sites) fuzz::require(site < sites);
    std::vector<double> sums(layout.taxels.size());
    for (std::size_t e = 0; e < map.taxel.size(); ++e) {
        fuzz::require(map.taxel[e] < sums.size() && map.weight[e] > 0);
        sums[map.taxel[e]] += map.weight[e];
    }
    double total = 0;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        fuzz::require(std::abs(sums[k] - map.total[k]) < 1e-9 * (1 + map.total[k]));
        if (layout.taxels[k].use != TaxelUse::measured) fuzz::require(map.total[k] == 0);
        total += map.total[k];
    }
    const auto used = std::count_if(layout.taxels.begin(), layout.taxels.end(), [](const Taxel& t) { return t.use != TaxelUse::excluded; });
    fuzz::require(std::abs(total - static_cast<double>(used)) < 1e-9 * (1 + total));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto sites = load_skin_plan("fingertip")->sites;
    static const std::string path = "/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + "-taxels.csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, f);
        std::fclose(f);
    }
    const auto lines = 1 + std::count(data, data + size, '\n');
    const auto layout = read_taxel_layout(path);
    if (!layout) return fuzz::check(layout.error(), lines), 0;
    if (layout->taxels.size() > 50) return 0;  // many taxels test nothing more than few, but are slow
    const auto map = map_taxels(*layout, sites);
    map ? check_map(*layout, *map, sites.size()) : fuzz::check(map.error(), lines);
    return 0;
}
