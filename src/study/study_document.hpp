#pragma once
// What studies made, for programs and for people.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "study/study.hpp"

namespace corpuscle {

/// Everything that a study made, as `--json` gives it.
nlohmann::ordered_json document_of(const Study&, const Outcome&);

/// All of them as one Markdown text: first every number that was printed, made again; then study by study.
std::string markdown_of(std::span<const Study* const>, std::span<const Outcome>);

}  // namespace corpuscle
