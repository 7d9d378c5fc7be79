#pragma once
// What an earlier run has written into a directory, by its summary.json there ("files"). Such a file may come with anybody's data: it is
// believed of names that this program writes, and of nothing else.

#include <string>
#include <string_view>
#include <vector>

namespace corpuscle {

/// A name that 'respond' writes into a directory: "spikes.csv", "traces-2.csv", "vectors-sa1.csv", any page ("*.html").
bool is_output_name(std::string_view name);

/// "summary.json", if it is one of ours, and what it lists, if these are regular files there; pages only if they are ours.
std::vector<std::string> earlier_outputs(const std::string& directory);

/// Removes of these what this run has not written and does not read; gives the names of what was removed.
std::vector<std::string> remove_stale(const std::string& directory, const std::vector<std::string>& written);

/// Whether a file that begins so is one of our pages.
bool is_own_page(std::string_view beginning);

}  // namespace corpuscle
