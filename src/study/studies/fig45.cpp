// Fig. 45: the layout of the trapezoidal arrays, drawn by one rule.

#include "study/studies.hpp"
#include "study/thesis/layout.hpp"

namespace corpuscle::studies::fig45 {

Result<Outcome> work(const StudyOptions&) {
    return tell_layout(trapezoids, "fig. 45",
                       "F's two channels stand closer than units do: by the same rule its rectangle is longer than printed.");
}

const Study study{"fig45", "Layout of the trapezoidal arrays",
                  "Channels in rows and columns, and the rectangles that are counted. Thesis B.2, fig. 45", work};

}  // namespace corpuscle::studies::fig45
