#include "cli/verb_options.hpp"

namespace corpuscle {

std::vector<OptionGroup> all_options(const Verb& verb, CommonArguments& common) {
    auto out = verb.options;
    OptionGroup shared;
    if (verb.reports)
        shared.rows = {{"--json", &common.json, "", "print one JSON document on standard output, and nothing else"},
                       {"--quiet,-q", &common.quiet, "", "do not print tables, progress and notes; warnings are still printed"}};
    if (verb.writes_files)
        shared.rows.push_back({"--overwrite", &common.overwrite, "",
                               "also replace files that were not written by an earlier run; input files are never replaced"});
    out.push_back(std::move(shared));
    return out;
}

}  // namespace corpuscle
