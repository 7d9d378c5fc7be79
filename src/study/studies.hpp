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

}  // namespace corpuscle
