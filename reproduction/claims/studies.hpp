#pragma once
// The studies listed in studies.def. A study is a data file, studies/NAME.toml, or a C++ file, studies/NAME.cpp, or both. The C++ file uses
// the namespace corpuscle::studies::NAME.

#include "reproduction/claims/study.hpp"
#include "reproduction/data/study_value.hpp"

#define STUDY(name)                      \
    namespace corpuscle::studies::name { \
    extern const Study study;            \
    }
#define STUDY_FILE(name)
#define STUDY_FILE_WITH_VALUES(name)                         \
    namespace corpuscle::studies::name {                     \
    Result<StudyValues> compute_values(const StudyOptions&); \
    }
#include "reproduction/claims/studies.def"
#undef STUDY
#undef STUDY_FILE
#undef STUDY_FILE_WITH_VALUES

namespace corpuscle {

/// All studies, in the order of studies.def.
std::span<const Study* const> all_studies();

/// Studies of published recordings. The recordings are not part of the project and may be absent, so `corpuscle study all` leaves
/// these studies out; they run only if they are named.
namespace studies::eskin_press {
extern const Study study;
}
namespace studies::texture {
extern const Study study;
}
inline constexpr const Study* recorded_studies[] = {&studies::eskin_press::study, &studies::texture::study};

/// Studies of the transistors of a foundry's kit, which the user must have. Like recorded_studies, they run only if they are named.
namespace studies::foundry {
extern const Study study;
}
inline constexpr const Study* kit_studies[] = {&studies::foundry::study};

}  // namespace corpuscle
