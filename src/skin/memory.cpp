#include "skin/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>

namespace corpuscle {
namespace {

// As measured of grids and of the hand, from 20 thousand to 3 million units.
constexpr double bytes_a_site = 1600, bytes_a_unit = 1600, bytes_a_weight = 60;

double most_bytes() {
    constexpr double share = 0.8;  // of the machine's, for others need some
    double most = share * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    struct ::rlimit limit = {};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) most = std::min(most, static_cast<double>(limit.rlim_cur));
    return most;
}

}  // namespace

Result<void> check_memory(std::string_view name, double sites, double units, double weights) {
    const double needed = sites * bytes_a_site + units * bytes_a_unit + weights * bytes_a_weight, most = most_bytes();
    if (needed <= most) return {};
    return bad_input(
        fmt::format("{}: {:.0f} sites and {:.0f} afferents need about {:.3g} GB of memory, and there is room for {:.3g} GB; take "
                    "fewer sites",
                    name, sites, units, needed * 1e-9, most * 1e-9));
}

}  // namespace corpuscle
