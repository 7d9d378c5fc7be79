#pragma once
// The results of studies, for programs and for readers.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "study/study.hpp"

namespace corpuscle {

/// The complete result of a study, as `--json` prints it.
nlohmann::ordered_json document_of(const Study&, const Outcome&);

/// The number of claims with each verdict, in words.
std::string tally_of(std::span<const Outcome>);
/// True for a claim that is listed at the top as well: it has a published number, or it deviates.
bool belongs_on_top(const Claim&);

/// All results as one Markdown text: the top claims first, then study by study.
std::string markdown_of(std::span<const Study* const>, std::span<const Outcome>);

}  // namespace corpuscle
