#include "sweep/parallel/shard_text.hpp"

#include <fmt/format.h>
#include <cstdio>
#include <filesystem>

namespace corpuscle {

Result<Shard> parse_shard(const std::string& text) {
    if (text.empty()) return Shard{};
    long long k = 0, n = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lld/%lld%c", &k, &n, &rest) != 2 || n < 1 || k < 1 || k > n)
        return bad_usage(fmt::format("--shard {}: write K/N, part K of N, such as 1/4", text));
    return Shard{k - 1, n};
}

std::string results_path(const std::string& sweep_file, const std::string& requested, const Shard& shard) {
    if (!requested.empty()) return requested;
    const auto stem = std::filesystem::path(sweep_file).stem().string();
    return shard.shard_count == 1 ? stem + ".sqlite" : fmt::format("{}-{}of{}.sqlite", stem, shard.index + 1, shard.shard_count);
}

}  // namespace corpuscle
