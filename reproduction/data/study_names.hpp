#pragma once
// The names of a data file and their values, which are computed when they are first used.

#include <set>

#include "reproduction/data/study_expression.hpp"
#include "reproduction/data/study_file.hpp"

namespace corpuscle {

class StudyNames {
    const StudyFile& file_;
    StudyValues globals_;                // values from C++, runs and trials
    std::vector<StudyValues> computed_;  // for each scope, the values of its definitions that have been used
    std::set<std::pair<std::size_t, std::string>> in_progress_;

public:
    /// `globals` are visible in all scopes. The file must live as long as this object.
    StudyNames(const StudyFile& file, StudyValues globals) : file_(file), globals_(std::move(globals)), computed_(file.scopes.size()) {}

    bool has_global(const std::string& name) const { return globals_.contains(name); }
    void add_global(const std::string& name, StudyValue value) { globals_[name] = std::move(value); }

    /// The value of an expression, of an expression that must be a number, and of a text with {expressions}.
    Result<StudyValue> value(const LocatedText& expression, std::size_t scope);
    Result<double> number(const LocatedText& expression, std::size_t scope);
    Result<std::string> text(const LocatedText&, std::size_t scope);

private:
    StudyLookup visible_in(std::size_t scope);
    Result<StudyValue> find(const std::string& name, std::size_t scope);
    std::vector<std::string_view> known_names(std::size_t scope) const;
    Result<StudyValue> defined_value(const std::string& name, const StudyDefinition&, std::size_t scope);
    Result<StudyValue> compute(const StudyDefinition&, std::size_t scope);
    Result<StudyValue> curve_of(const StudyDefinition&, std::size_t scope);
};

}  // namespace corpuscle
