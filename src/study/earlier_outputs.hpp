#pragma once
// The files that an earlier run wrote into a directory, as its summary.json there lists them ("files"). A summary.json may come from
// an unknown source, so only names that this program writes are trusted.

#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

/// True for a name that 'respond' writes into a directory: "spikes.csv", "probes-2.csv", "vectors-sa1.csv", any page ("*.html").
bool is_output_name(std::string_view name);

/// "summary.json", if it is one of ours, and the files that it lists, if they are regular files in that directory. Pages only if this
/// program wrote them.
std::vector<std::string> earlier_outputs(const std::string& directory);

/// Removes those that this run neither wrote nor reads; returns the names of the removed files.
std::vector<std::string> remove_stale_outputs(const std::string& directory, const std::vector<std::string>& written);

/// True if a file with this beginning is a page of this program.
bool is_own_page(std::string_view beginning);

}  // namespace corpuscle
