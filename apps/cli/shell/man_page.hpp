#pragma once
// Manual pages from the texts of --help-all.

#include "cli/help.hpp"

namespace corpuscle {

/// A page of section 1: its file name without the directory ("corpuscle-respond.1") and its text.
struct ManPage {
    std::string name, text;
};

/// The page of a program, unless it has one verb only, and the pages of its verbs and of the verbs behind them. Verbs that start another
/// program have theirs from that program.
std::vector<ManPage> man_pages(const CLI::App&, const std::vector<Verb>&);

}  // namespace corpuscle
