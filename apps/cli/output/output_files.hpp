#pragma once
// Writes output files, and reports which were written.

#include <optional>
#include <string>
#include <vector>

#include "io/output/output_check.hpp"
#include "io/output/output_file.hpp"

namespace corpuscle {

struct RespondArguments;

/// Writes the complete content of a file and renames the file to its final name.
Result<void> write_and_commit(OutputFile&, const std::string& text);
Result<void> write_file(const std::string& path, const std::string& text);

/// The file names of the paths that are directly in this directory, without the other paths.
std::vector<std::string> file_names_in(const std::string& directory, const std::vector<std::string>& paths);

/// The path of the report page; no value if --report was not given.
std::optional<std::string> report_page_path(const RespondArguments&);

/// Checks that each output may be written: the files `names` in a directory, a report page, a checkpoint. "" means that there is no
/// directory or no checkpoint.
Result<void> check_outputs(const std::string& directory, std::vector<std::string> names, const std::optional<std::string>& page,
                           const std::string& checkpoint, OutputCheck&);

/// A message that lists the written files, "Written: a, b", and the removed files of an earlier run; or that says that nothing was written.
std::string written_files_text(const std::vector<std::string>& paths, const std::vector<std::string>& removed);

}  // namespace corpuscle
