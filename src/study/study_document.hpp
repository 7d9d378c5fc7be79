#pragma once
// What studies made, for programs and for people.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "study/study.hpp"

namespace corpuscle {

/// Everything that a study made, as `--json` gives it.
nlohmann::ordered_json document_of(const Study&, const Outcome&);

/// How many claims came out in each way, in words.
std::string tally_of(std::span<const Outcome>);
/// Whether a claim is told before all studies, too: a printed number, or one that is off.
bool belongs_on_top(const Claim&);

/// All of them as one Markdown text: first what belongs on top, then study by study.
std::string markdown_of(std::span<const Study* const>, std::span<const Outcome>);

}  // namespace corpuscle
