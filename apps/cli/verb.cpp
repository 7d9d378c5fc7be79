#include "cli/verb.hpp"

#include "cli/arguments/option_rows.hpp"

namespace corpuscle {

void add_common_options(CLI::App& part, CommonArguments& common) {
    add_options(part, "",
                {{"--json", &common.json, "", "print one JSON document on standard output, and nothing else"},
                 {"--quiet,-q", &common.quiet, "", "do not print tables, progress and notes; warnings are still printed"}});
}

void add_overwrite_option(CLI::App& part, CommonArguments& common) {
    add_options(part, "",
                {{"--overwrite", &common.overwrite, "",
                  "also replace files that were not written by an earlier run; input files are never replaced"}});
}

}  // namespace corpuscle
