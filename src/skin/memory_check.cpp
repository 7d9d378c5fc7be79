#include "skin/memory_check.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>

namespace corpuscle {
namespace {

// Measured on grids and on the hand, with 20 thousand to 3 million afferents.
constexpr double bytes_per_site = 1600, bytes_per_afferent = 1600, bytes_per_weight = 60;

/// The memory that a skin may use on this machine in this process.
double available_bytes() {
    constexpr double fraction = 0.8;  // of the machine's memory; other programs need some
    double max_bytes = fraction * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    struct ::rlimit limit = {};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        max_bytes = std::min(max_bytes, static_cast<double>(limit.rlim_cur));
    return max_bytes;
}

}  // namespace

Result<void> check_available_memory(std::string_view name, double sites, double afferents, double weights) {
    const double needed = sites * bytes_per_site + afferents * bytes_per_afferent + weights * bytes_per_weight,
                 max_bytes = available_bytes();
    if (needed <= max_bytes) return {};
    return bad_input(
        fmt::format("{}: {:.0f} sites and {:.0f} afferents need about {:.3g} GB of memory, but only {:.3g} GB are available; use "
                    "fewer sites",
                    name, sites, afferents, needed * 1e-9, max_bytes * 1e-9));
}

}  // namespace corpuscle
