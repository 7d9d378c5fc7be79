#pragma once
// The files that an earlier run wrote into a directory, as listed in its summary.json ("files"). A summary.json may come from an unknown
// source, so it is trusted only for file names that this program writes.

#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

/// True for a file name that 'respond' writes into a directory, or that an earlier version wrote: "spikes.csv", "probes-2.csv",
/// "vectors-sa1.csv", any page ("*.html").
bool is_output_name(std::string_view name);

/// The names of "summary.json", if this program wrote it, and of the files that it lists, if they are regular files in that directory. HTML
/// pages are included only if this program wrote them.
std::vector<std::string> earlier_outputs(const std::string& directory);

/// Removes the earlier outputs that this run has neither written nor read. `written`: the names of the files that this run has written into
/// the directory. Returns the names of the removed files.
std::vector<std::string> remove_stale_outputs(const std::string& directory, const std::vector<std::string>& written);

/// True if a file that begins with this text is an HTML page of this program.
bool is_own_page(std::string_view beginning);

}  // namespace corpuscle
