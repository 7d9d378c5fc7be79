#pragma once
// The results of studies as JSON, for programs, and as Markdown, for readers.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "reproduction/claims/study.hpp"

namespace corpuscle {

/// The complete result of a study, as `--json` prints it.
nlohmann::ordered_json document_of(const Study&, const StudyResult&);

/// The kinds of claims with their counts, as `--json` prints them.
nlohmann::ordered_json document_of_kinds(std::span<const StudyResult>);
/// True for a claim that is also listed in the table at the top: it has a published number that is not derived, or its deviation needs an
/// explanation.
bool is_headline(const Claim&);

/// All results as one Markdown text: a table of the headline claims of all studies, then study by study. Both lists have the same order.
std::string markdown_of(std::span<const Study* const>, std::span<const StudyResult>);

}  // namespace corpuscle
