#pragma once
// The studies that studies.def names. Each has a file in studies/ and a namespace of its own in it, corpuscle::studies::NAME.

#include "study/study.hpp"

#define STUDY(name)                      \
    namespace corpuscle::studies::name { \
    extern const Study study;            \
    }
#include "study/studies.def"
#undef STUDY

namespace corpuscle {

#define STUDY(name) &studies::name::study,
inline constexpr const Study* all_studies[] = {
#include "study/studies.def"
};
#undef STUDY

/// Studies of published recordings, which are kept beside the project and may be absent. Not part of "all"; they run if named.
namespace studies::eskin_press {
extern const Study study;
}
inline constexpr const Study* recorded_studies[] = {&studies::eskin_press::study};

}  // namespace corpuscle
