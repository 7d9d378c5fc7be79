#pragma once
// A study's data file: the runs, trials, claims and plots of a study as TOML. doc/studies.md describes the format.

#include <map>
#include <string>
#include <vector>

#include "core/text/config_file.hpp"
#include "reproduction/claims/claim_kind.hpp"

namespace corpuscle {

/// A table of the file, such as one [[claim]], with the {variables} of its `each` replaced.
struct StudyItem {
    std::string kind;  ///< "run", "trial", "claim", "plot", "note", or "series" inside a plot
    SourceLocation location;
    std::size_t scope = 0;                                  ///< index in StudyFile::scopes
    std::map<std::string, LocatedText> texts;               ///< values that are a text, a number, true or false
    std::map<std::string, std::vector<LocatedText>> lists;  ///< values that are a list of such
    std::vector<StudyItem> series = {};                     ///< of a plot

    bool has(const std::string& key) const { return texts.contains(key); }
    bool is_true(const std::string& key) const { return has(key) && texts.at(key).text == "true"; }
    /// The text of a key; "" if it is missing.
    std::string text(const std::string& key) const { return has(key) ? texts.at(key).text : ""; }
    std::vector<std::string> list(const std::string& key) const;
};

/// The definition of a name in [values] or [texts]: an expression, a text or, with `each`, the pairs of a curve.
struct StudyDefinition {
    LocatedText expression;  ///< or the text; not used for a curve
    bool is_text = false;
    std::vector<std::pair<LocatedText, LocatedText>> pairs;  ///< expressions of x and y
};

/// The names that are visible to an expression: those of [values] of its group, then those of the groups around it.
struct StudyScope {
    static constexpr std::size_t no_scope = static_cast<std::size_t>(-1);
    std::size_t outer = no_scope;
    std::map<std::string, StudyDefinition> definitions;
};

struct StudyFile {
    LocatedText title, question;
    ClaimKind kind{};              ///< of the claims that state no other
    std::vector<StudyItem> items;  ///< in the order of the file; a group's items once for each of its variables' values
    std::vector<StudyScope> scopes;
};

/// Reads the name of a kind of claims.
Result<ClaimKind> read_claim_kind(const LocatedText&);

/// Reads the text of a data file; `file` is its name for messages. An unknown key or a wrong type is an error.
Result<StudyFile> read_study_file(std::string_view text, const std::string& file);

}  // namespace corpuscle
