#pragma once
// The studies listed in studies.def. The study NAME is defined in a file of studies/, in the namespace corpuscle::studies::NAME.

#include "reproduction/claims/study.hpp"

#define STUDY(name)                      \
    namespace corpuscle::studies::name { \
    extern const Study study;            \
    }
#include "reproduction/claims/studies.def"
#undef STUDY

namespace corpuscle {

#define STUDY(name) &studies::name::study,
inline constexpr const Study* all_studies[] = {
#include "reproduction/claims/studies.def"
};
#undef STUDY

/// Studies of published recordings. The recordings are not part of the project and may be absent, so `corpuscle study all` leaves
/// these studies out; they run only if they are named.
namespace studies::eskin_press {
extern const Study study;
}
inline constexpr const Study* recorded_studies[] = {&studies::eskin_press::study};

}  // namespace corpuscle
