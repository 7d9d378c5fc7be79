#pragma once
// What a run has written, told.

#include <optional>
#include <string>
#include <vector>

#include "io/output.hpp"
#include "io/output_check.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// All of a file at once, and in its place.
Result<void> put_whole(OutputFile&, const std::string& text);
Result<void> write_whole(const std::string& path, const std::string& text);

/// Of some paths, the names of those that stand in this very directory.
std::vector<std::string> names_in(const std::string& directory, const std::vector<std::string>& paths);

/// Where the page of this run goes; none: no page is asked for.
std::optional<std::string> page_of(const RespondWords&);

/// Names in a directory ("": none), a page there or elsewhere, a checkpoint ("": none): whether each may be written.
Result<void> check_outputs(const std::string& directory, std::vector<std::string> names, const std::optional<std::string>& page,
                           const std::string& checkpoint, OutputCheck&);

/// "Written: a, b" and what of an earlier run is gone; or that nothing was.
std::string told_of(const std::vector<std::string>& paths, const std::vector<std::string>& removed);

}  // namespace corpuscle
