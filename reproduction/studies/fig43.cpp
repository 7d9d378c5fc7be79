// Fig. 43: the layout of the rectangular arrays, computed with one rule.

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/array_layout.hpp"

namespace corpuscle::studies::fig43 {

Result<StudyResult> compute(const StudyOptions&) {
    return report_layout(rectangles, "fig. 43", "A has a single channel; by the same rule its rectangle is larger than published.");
}

const Study study{"fig43", "Layout of the rectangular arrays",
                  "Channels in rows and columns, and the rectangles that count as area. Thesis B.1, fig. 43", ClaimKind::identity, compute};

}  // namespace corpuscle::studies::fig43
