#pragma once
// Runs a study that is written as a data file in reproduction/studies.

#include "reproduction/claims/study.hpp"
#include "reproduction/data/study_file.hpp"
#include "reproduction/data/study_value.hpp"

namespace corpuscle {

/// Computes the values that a data file takes from C++; its expressions use them by name.
using ComputeStudyValues = Result<StudyValues> (*)(const StudyOptions&);

/// The study of the embedded file studies/NAME.toml; its name has '-' for '_'. An error in the file is the study's result. Its
/// texts live as long as the study or a copy of it.
Study study_from_file(const std::string& name, ComputeStudyValues compute_values = nullptr);

/// Runs the runs and trials of a data file, and computes its claims and plots. `values`: those that come from C++.
Result<StudyResult> run_study_file(const StudyFile&, const StudyOptions&, StudyValues values = {});

}  // namespace corpuscle
