#pragma once
// The results of studies, for programs and for readers.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "study/study.hpp"

namespace corpuscle {

/// The complete result of a study, as `--json` prints it.
nlohmann::ordered_json document_of(const Study&, const StudyResult&);

/// The number of claims with each verdict, in words.
std::string verdict_counts(std::span<const StudyResult>);
/// True for a claim that is listed at the top as well: it has a published number, or it deviates.
bool is_headline(const Claim&);

/// All results as one Markdown text: the top claims first, then study by study.
std::string markdown_of(std::span<const Study* const>, std::span<const StudyResult>);

}  // namespace corpuscle
