#pragma once
// Writes output files, and reports which were written.

#include <optional>
#include <string>
#include <vector>

#include "io/output_check.hpp"
#include "io/output_file.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// Writes a complete file and renames it to its final name.
Result<void> write_and_commit(OutputFile&, const std::string& text);
Result<void> write_file(const std::string& path, const std::string& text);

/// The file names of those paths that are directly in this directory.
std::vector<std::string> file_names_in(const std::string& directory, const std::vector<std::string>& paths);

/// The path of the report page of this run, if one was requested.
std::optional<std::string> report_page_path(const RespondArguments&);

/// Checks that each output may be written: the files of a directory, a page, a checkpoint. An empty directory or checkpoint means none.
Result<void> check_outputs(const std::string& directory, std::vector<std::string> names, const std::optional<std::string>& page,
                           const std::string& checkpoint, OutputCheck&);

/// "Written: a, b", and the files of an earlier run that were removed; or that nothing was written.
std::string written_files_text(const std::vector<std::string>& paths, const std::vector<std::string>& removed);

}  // namespace corpuscle
