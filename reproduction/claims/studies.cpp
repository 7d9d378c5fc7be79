#include "reproduction/claims/studies.hpp"

#include <deque>

#include "reproduction/data/study_from_file.hpp"

namespace corpuscle {

std::span<const Study* const> all_studies() {
    static std::deque<Study> from_files;  // a deque, because the list has the addresses of its elements
    [[maybe_unused]] const auto add_file = [](const char* name, ComputeStudyValues compute_values = nullptr) {
        return &from_files.emplace_back(study_from_file(name, compute_values));
    };
#define STUDY(name) &studies::name::study,
#define STUDY_FILE(name) add_file(#name),
#define STUDY_FILE_WITH_VALUES(name) add_file(#name, studies::name::compute_values),
    static const Study* const list[] = {
#include "reproduction/claims/studies.def"
    };
#undef STUDY
#undef STUDY_FILE
#undef STUDY_FILE_WITH_VALUES
    return list;
}

}  // namespace corpuscle
