#pragma once
// The studies that studies.def names. Each has a file in studies/ and in it a namespace of its own, corpuscle::studies::NAME.

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

/// Of recordings that others made, which lie beside the project and may be absent: no part of "all", asked for by name.
namespace studies::eskin_press {
extern const Study study;
}
inline constexpr const Study* recorded_studies[] = {&studies::eskin_press::study};

}  // namespace corpuscle
