// Fig. 45: the layout of the trapezoidal arrays, computed with one rule.

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/array_layout.hpp"

namespace corpuscle::studies::fig45 {

Result<StudyResult> compute(const StudyOptions&) {
    return report_layout(
        trapezoids, "fig. 45",
        "F's two channels are closer together than those of the other arrays; by the same rule its rectangle is longer than published.");
}

const Study study{"fig45", "Layout of the trapezoidal arrays",
                  "Channels in rows and columns, and the rectangles that count as area. Thesis B.2, fig. 45", ClaimKind::identity, compute};

}  // namespace corpuscle::studies::fig45
