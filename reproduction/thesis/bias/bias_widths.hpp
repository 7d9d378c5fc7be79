#pragma once
// The bias generator with wider arrays: do any widths give all published ranges of figs. 53 to 55?

#include "reproduction/claims/study.hpp"

namespace corpuscle {

/// Adds V_BN and I_Q over current, supply and temperature for the published widths, and for arrays 2, 3.4 and 4 times as wide, and the
/// claim that none of them gives what tables 17 and 18 and figs. 53 to 55 print.
Result<void> report_bias_widths(StudyResult&);

}  // namespace corpuscle
