#pragma once
// Shards as text, and the names of their results files.

#include <string>

#include "sweep/parallel/run_sweep.hpp"

namespace corpuscle {

/// Parses "K/N", where K counts from 1; Shard::index counts from 0. "" is the complete sweep.
Result<Shard> parse_shard(const std::string& text);

/// The results file `requested`. "": in the current directory, "mc.sqlite" for some/where/mc.toml, "mc-1of4.sqlite" for shard 1/4.
std::string results_path(const std::string& sweep_file, const std::string& requested, const Shard&);

}  // namespace corpuscle
